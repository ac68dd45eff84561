// How results of stress go from process to process.
#pragma once

#include "compare/command/bench/bench_archive.h"
#include "compare/stress/stress_run.h"

namespace shadowproof {

SHADOWPROOF_SEND_ALL(Disagreement, x, y, truth, witness, truth_triangle, witness_triangle)
SHADOWPROOF_SEND_ALL(Agreement, asked, undecided, disagreements, first)
SHADOWPROOF_SEND_ALL(RelationCheck, tried, left_out, compared, ties, changed, first)
SHADOWPROOF_SEND_ALL(StressCell, technique, family, milliseconds, judging, error, strain, verdict,
                     refused, loss, command, pictures)
SHADOWPROOF_SEND_ALL(StressPoint, value, own, searched, refused, loss, triangles,
                     trace_milliseconds, rays, exact_decisions, degenerate, witness, relations,
                     cells)
SHADOWPROOF_SEND_ALL(Breaking, technique, up, holds, fails, derived_holds, derived, cause, refused)
SHADOWPROOF_SEND_ALL(StressAlong, parameter, words, points, breaking, wrong_before)
SHADOWPROOF_SEND_ALL(StressScene, name, file, digest, light, width, height, triangles, error,
                     parameters, left_out)
SHADOWPROOF_SEND_ALL(StressRun, version, gl, embree, arguments, scenes)

} // namespace shadowproof
