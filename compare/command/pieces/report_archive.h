// How cells and scenes of a report go from process to process: without pictures and ledgers, which
// are on disk already.
#pragma once

#include "compare/command/pieces/archive.h"
#include "compare/report/report.h"

// Each structure is unpacked into all its members, so that a new member does not compile until it
// is sent, too. Members named in capitals are not sent: pictures, and large data that is not needed
// any more.

namespace glm {

template <class Archive>
void serialize(Archive& archive, dvec3& v) {
    archive(v.x, v.y, v.z);
}

} // namespace glm

namespace shadowproof {

template <class Archive>
void serialize(Archive& archive, DriverInfo& info) {
    auto& [version, renderer, subpixel_bits, depth_bits, stencil_bits] = info;
    archive(version, renderer, subpixel_bits, depth_bits, stencil_bits);
}

template <class Archive>
void serialize(Archive& archive, Light& light) {
    auto& [name, choice, kind, position, direction, inner_cone, outer_cone, color, intensity] =
        light;
    archive(name, choice, kind, position, direction, inner_cone, outer_cone, color, intensity);
}

template <class Archive>
void serialize(Archive& archive, Camera& camera) {
    auto& [eye, right, up, forward, tan_half_height, near, far, width, height] = camera;
    archive(eye, right, up, forward, tan_half_height, near, far, width, height);
}

template <class Archive>
void serialize(Archive& archive, Mesh& mesh) {
    auto& [name, first_triangle, triangle_count, material, casts, receives] = mesh;
    archive(name, first_triangle, triangle_count, material, casts, receives);
}

template <class Archive>
void serialize(Archive& archive, TraceStatistics& statistics) {
    auto& [milliseconds, build_milliseconds, rays, exact_decisions, lit, shadowed, background,
           degenerate] = statistics;
    archive(milliseconds, build_milliseconds, rays, exact_decisions, lit, shadowed, background,
            degenerate);
}

template <class Archive>
void serialize(Archive& archive, GroundTruth& truth) {
    auto& [VISIBILITY, TRIANGLE, DEPTH, EXACTNESS, IN_CONE, statistics] = truth;
    archive(statistics);
}

template <class Archive>
void serialize(Archive& archive, FirstDifference& first) {
    auto& [x, y, cause] = first;
    archive(x, y, cause);
}

template <class Archive>
void serialize(Archive& archive, EvidenceCheck& check) {
    auto& [equal, in_band, unexplained, first_x, first_y] = check;
    archive(equal, in_band, unexplained, first_x, first_y);
}

template <class Archive>
void serialize(Archive& archive, ColorModel& model) {
    auto& [arithmetic, axes, normalisation, bump_form, reflects] = model;
    archive(arithmetic, axes, normalisation, bump_form, reflects);
}

template <class Archive>
void serialize(Archive& archive, BoundWidth& bound_width) {
    auto& [median, percentile999, widest] = bound_width;
    archive(median, percentile999, widest);
}

template <class Archive>
void serialize(Archive& archive, ColorCheck& check) {
    auto& [model, ERROR, VERDICT, judged, largest, largest_x, largest_y, rmse, percentile999,
           beyond, unpredicted, moved, interpolated, bound_width, beyond_by, first_unpredicted_x,
           first_unpredicted_y] = check;
    archive(model, judged, largest, largest_x, largest_y, rmse, percentile999, beyond, unpredicted,
            moved, interpolated, bound_width, beyond_by, first_unpredicted_x, first_unpredicted_y);
}

template <class Archive>
void serialize(Archive& archive, EvidenceSummary& summary) {
    auto& [unexplained, results, words, pictures] = summary;
    archive(unexplained, results, words, pictures);
}

template <class Archive>
void serialize(Archive& archive, Comparison& comparison) {
    auto& [CAUSE, ALSO, several, EVIDENCE_MISS, causes, differing, first, evidence_name, evidence,
           summary, colors] = comparison;
    archive(several, causes, differing, first, evidence_name, evidence, summary, colors);
}

template <class Archive>
void serialize(Archive& archive, PixelChange& change) {
    auto& [x, y, cause, was] = change;
    archive(x, y, cause, was);
}

template <class Archive>
void serialize(Archive& archive, Since& since) {
    auto& [appeared, gone, changed, causes, first_new, first_gone, first_changed] = since;
    archive(appeared, gone, changed, causes, first_new, first_gone, first_changed);
}

template <class Archive>
void serialize(Archive& archive, Cell& cell) {
    auto& [technique, family, summary, command, error, verdict, milliseconds, left_out, excused,
           since, first_failing, comparison, cause_map, FRAME, EVIDENCE] = cell;
    archive(technique, family, summary, command, error, verdict, milliseconds, left_out, excused,
            since, first_failing, comparison, cause_map);
}

template <class Archive>
void serialize(Archive& archive, SceneResult& scene) {
    auto& [name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
           meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit, COLOR,
           cells] = scene;
    archive(name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
            meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit, cells);
}

} // namespace shadowproof
