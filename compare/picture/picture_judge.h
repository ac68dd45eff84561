// The family of pictures: claims without surface or counter, read from what a renderer drew.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

/// "picture". Its frames have Frame::pictured.
Family picture_family();

} // namespace shadowproof
