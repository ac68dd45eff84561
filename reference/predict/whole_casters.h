// Shadows as they are where alpha masks are ignored in casting them, and only there.
#pragma once

#include "reference/trace/trace.h"

namespace shadowproof {

/// The visibility of what is truly seen, under casters whose masks leave nothing out.
Image<Visibility> under_whole_casters(const Tracer& tracer);

} // namespace shadowproof
