// How results of bench go from process to process.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/command/pieces/report_archive.h"

// Each structure is unpacked into all its members, so that a new member does not compile until it
// is sent, too.

namespace shadowproof {

template <class Archive>
void serialize(Archive& archive, BenchColor& color) {
    auto& [rmse, largest, percentile999] = color;
    archive(rmse, largest, percentile999);
}

template <class Archive>
void serialize(Archive& archive, BenchError& error) {
    auto& [pixels, differing, falsely_lit, falsely_shadowed, causes, color] = error;
    archive(pixels, differing, falsely_lit, falsely_shadowed, causes, color);
}

template <class Archive>
void serialize(Archive& archive, BenchStage& stage) {
    auto& [name, samples] = stage;
    archive(name, samples);
}

template <class Archive>
void serialize(Archive& archive, BenchPoint& point) {
    auto& [scene, technique, family, settings, own, samples, stages, error, command, pictures] =
        point;
    archive(scene, technique, family, settings, own, samples, stages, error, command, pictures);
}

template <class Archive>
void serialize(Archive& archive, BenchScene& scene) {
    auto& [name, file, digest, light, width, height, triangles, finished] = scene;
    archive(name, file, digest, light, width, height, triangles, finished);
}

template <class Archive>
void serialize(Archive& archive, BenchLeftOut& out) {
    auto& [scene, technique, settings, why, loss] = out;
    archive(scene, technique, settings, why, loss);
}

template <class Archive>
void serialize(Archive& archive, BenchMachine& machine) {
    auto& [processor, cores, system] = machine;
    archive(processor, cores, system);
}

template <class Archive>
void serialize(Archive& archive, GrowthPoint& point) {
    auto& [size, samples] = point;
    archive(size, samples);
}

template <class Archive>
void serialize(Archive& archive, Growth& growth) {
    auto& [axis, scene, technique, command, points] = growth;
    archive(axis, scene, technique, command, points);
}

template <class Archive>
void serialize(Archive& archive, BenchRun& run) {
    auto& [version, gl, embree, machine, arguments, scenes, points, left_out, growth, finished] =
        run;
    archive(version, gl, embree, machine, arguments, scenes, points, left_out, growth, finished);
}

} // namespace shadowproof
