// How cells and scenes of a report go from process to process: without pictures and ledgers, which
// are on disk already.
#pragma once

#include "compare/command/pieces/archive.h"
#include "compare/report/report.h"

// Of some structures not all members are sent. They are unpacked all the same, so that a new member
// does not compile until it is decided on. Those named in capitals are not sent: pictures, and
// large data that is not needed any more.

namespace glm {

template <class Archive>
void serialize(Archive& archive, dvec3& v) {
    archive(v.x, v.y, v.z);
}

} // namespace glm

namespace shadowproof {

SHADOWPROOF_SEND_ALL(DriverInfo, version, renderer, subpixel_bits, depth_bits, stencil_bits)
SHADOWPROOF_SEND_ALL(Light, name, choice, kind, position, direction, inner_cone, outer_cone, color,
                     intensity, range)
SHADOWPROOF_SEND_ALL(Camera, projection, eye, right, up, forward, half_height, near, far, width,
                     height)
SHADOWPROOF_SEND_ALL(Mesh, name, first_triangle, triangle_count, material, casts, receives,
                     textured)
SHADOWPROOF_SEND_ALL(TraceStatistics, milliseconds, build_milliseconds, rays, exact_decisions,
                     undecided, lit, shadowed, background, degenerate)

template <class Archive>
void serialize(Archive& archive, GroundTruth& truth) {
    auto& [VISIBILITY, TRIANGLE, DEPTH, EXACTNESS, IN_CONE, statistics] = truth;
    archive(statistics);
}

SHADOWPROOF_SEND_ALL(FirstDifference, x, y, cause)
SHADOWPROOF_SEND_ALL(EvidenceCheck, equal, in_band, unexplained, first_x, first_y)
SHADOWPROOF_SEND_ALL(ByteErrors, overwriting, multiplying, adding, rounds_before_blending)
SHADOWPROOF_SEND_ALL(ColorModel, arithmetic, axes, normalisation, bump_form, vectors, tangents,
                     reflects, filter, anisotropy, cube_size, newton_steps, bytes)
SHADOWPROOF_SEND_ALL(BoundWidth, median, percentile999, widest)

SHADOWPROOF_SEND_ALL(LightAdded, name, differing)
SHADOWPROOF_SEND_ALL(ErrorBin, from, to, pixels, rmse)
SHADOWPROOF_SEND_ALL(MeanCheck, most_rays, noise, rmse, alike, alike_rmse, by_texels, by_angle)

template <class Archive>
void serialize(Archive& archive, ColorCheck& check) {
    auto& [model, ERROR, VERDICT, judged, largest, largest_x, largest_y, rmse, picture_rmse,
           percentile999, beyond, unpredicted, moved, interpolated, bound_width, beyond_by,
           first_unpredicted_x, first_unpredicted_y, lights_before, means] = check;
    archive(model, judged, largest, largest_x, largest_y, rmse, picture_rmse, percentile999, beyond,
            unpredicted, moved, interpolated, bound_width, beyond_by, first_unpredicted_x,
            first_unpredicted_y, lights_before, means);
}

SHADOWPROOF_SEND_ALL(EvidenceSummary, unexplained, results, words)
SHADOWPROOF_SEND_ALL(ShareFigures, partly_lit, wrongness)

template <class Archive>
void serialize(Archive& archive, Comparison& comparison) {
    auto& [CAUSE, ALSO, several, too_near, EVIDENCE_MISS, causes, differing, first, evidence_name,
           evidence, summary, colors, shares] = comparison;
    archive(several, too_near, causes, differing, first, evidence_name, evidence, summary, colors,
            shares);
}

SHADOWPROOF_SEND_ALL(PixelChange, x, y, cause, was)
SHADOWPROOF_SEND_ALL(Since, appeared, gone, changed, causes, first_new, first_gone, first_changed)

SHADOWPROOF_SEND_ALL(Acceptance, cause, reason)

template <class Archive>
void serialize(Archive& archive, Cell& cell) {
    auto& [technique, family, summary, command, error, verdict, milliseconds, spent_milliseconds,
           left_out, excused, since, accepted, first_failing, comparison, cause_map, FRAME,
           EVIDENCE, same_pictures] = cell;
    archive(technique, family, summary, command, error, verdict, milliseconds, spent_milliseconds,
            left_out, excused, since, accepted, first_failing, comparison, cause_map,
            same_pictures);
}

template <class Archive>
void serialize(Archive& archive, SceneResult& scene) {
    auto& [name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
           meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit, COLOR,
           MEAN_COLOR, spent_milliseconds, cells] = scene;
    archive(name, file, argument, width, height, triangles, digest, light, one_of_many, camera, far,
            meshes, provokes, left_out, notes, no_longer_provoked, error, truth, bump_lit,
            spent_milliseconds, cells);
}

} // namespace shadowproof
