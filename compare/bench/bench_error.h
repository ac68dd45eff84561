// How wrong a claim is, in numbers.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/classify.h"
#include "scenes/frame.h"
#include "scenes/image.h"

namespace shadowproof {

/// Of a claim that was compared with the truth's classes.
BenchError error_of(const Frame& frame, const Comparison& comparison,
                    const Image<Visibility>& truth);

} // namespace shadowproof
