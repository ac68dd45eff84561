// The family of traced shadows: its rays are checked at every pixel, and what differs is named.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

/// "traced". Its frames have Frame::rays.
Family traced_family();

} // namespace shadowproof
