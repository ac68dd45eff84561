// How results of bench go from process to process.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/command/pieces/report_archive.h"

namespace shadowproof {

SHADOWPROOF_SEND_ALL(BenchColor, rmse, largest, percentile999)
SHADOWPROOF_SEND_ALL(BenchError, pixels, differing, falsely_lit, falsely_shadowed, causes, color)
SHADOWPROOF_SEND_ALL(BenchStage, name, samples)
SHADOWPROOF_SEND_ALL(BenchPoint, scene, technique, family, settings, own, samples, stages, error,
                     command, pictures)
SHADOWPROOF_SEND_ALL(BenchScene, name, file, digest, light, width, height, triangles, finished)
SHADOWPROOF_SEND_ALL(BenchLeftOut, scene, technique, settings, why, loss, axis)
SHADOWPROOF_SEND_ALL(BenchMachine, processor, cores, system)
SHADOWPROOF_SEND_ALL(GrowthPoint, size, samples)
SHADOWPROOF_SEND_ALL(Growth, axis, scene, technique, family, command, points)
SHADOWPROOF_SEND_ALL(BenchRun, version, gl, embree, machine, arguments, scenes, points, left_out,
                     growth, finished)

} // namespace shadowproof
