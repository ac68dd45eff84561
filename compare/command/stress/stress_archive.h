// How results of stress go from process to process.
#pragma once

#include "compare/command/bench/bench_archive.h"
#include "compare/stress/stress_run.h"

// Each structure is unpacked into all its members, so that a new member does not compile until it
// is sent, too.

namespace shadowproof {

template <class Archive>
void serialize(Archive& archive, Disagreement& disagreement) {
    auto& [x, y, truth, witness, truth_triangle, witness_triangle] = disagreement;
    archive(x, y, truth, witness, truth_triangle, witness_triangle);
}

template <class Archive>
void serialize(Archive& archive, Agreement& agreement) {
    auto& [asked, undecided, disagreements, first] = agreement;
    archive(asked, undecided, disagreements, first);
}

template <class Archive>
void serialize(Archive& archive, RelationCheck& check) {
    auto& [tried, left_out, compared, ties, changed, first] = check;
    archive(tried, left_out, compared, ties, changed, first);
}

template <class Archive>
void serialize(Archive& archive, StressCell& cell) {
    auto& [technique, family, milliseconds, judging, error, strain, verdict, refused, loss, command,
           pictures] = cell;
    archive(technique, family, milliseconds, judging, error, strain, verdict, refused, loss,
            command, pictures);
}

template <class Archive>
void serialize(Archive& archive, StressPoint& point) {
    auto& [value, own, searched, refused, loss, triangles, trace_milliseconds, rays,
           exact_decisions, degenerate, witness, relations, cells] = point;
    archive(value, own, searched, refused, loss, triangles, trace_milliseconds, rays,
            exact_decisions, degenerate, witness, relations, cells);
}

template <class Archive>
void serialize(Archive& archive, Breaking& breaking) {
    auto& [technique, up, holds, fails, derived_holds, derived, cause, refused] = breaking;
    archive(technique, up, holds, fails, derived_holds, derived, cause, refused);
}

template <class Archive>
void serialize(Archive& archive, StressAlong& along) {
    auto& [parameter, words, points, breaking, wrong_before] = along;
    archive(parameter, words, points, breaking, wrong_before);
}

template <class Archive>
void serialize(Archive& archive, StressScene& scene) {
    auto& [name, file, digest, light, width, height, triangles, error, parameters, left_out] =
        scene;
    archive(name, file, digest, light, width, height, triangles, error, parameters, left_out);
}

template <class Archive>
void serialize(Archive& archive, StressRun& run) {
    auto& [version, gl, embree, arguments, scenes] = run;
    archive(version, gl, embree, arguments, scenes);
}

} // namespace shadowproof
