// A report whose every figure is known by hand: 4 by 3 pixels, of which three differ.
#pragma once

#include "compare/report/report.h"
#include "compare/report/report_data.h"
#include "compare/stencil/stencil_report.h"

namespace shadowproof {

/// What a report shows of the handmade cells' counters: nothing beyond their pictures.
class HandmadeEvidence final : public EvidenceReport {
public:
    std::string header() const override { return "{}"; }
    Blocks blocks(const Frame& /*frame*/, const GroundTruth& /*truth*/,
                  Memo& /*memo*/) const override {
        return {};
    }
};

/// Truth:      claim:      cause:
///   . L L L     . L L L     - - - -
///   . L S S     . L L S     - - N -       N near_plane, E edge, U as asked for
///   . L S S     . S S L     - E - U
inline SceneResult handmade_scene(const std::string& name, Cause corner_cause, Verdict verdict) {
    const auto L = Visibility::lit;
    const auto S = Visibility::shadowed;
    const auto B = Visibility::background;
    SceneResult scene;
    scene.name = name;
    scene.file = name + ".gltf";
    scene.argument = name;
    scene.width = 4;
    scene.height = 3;
    scene.triangles = 1234;
    scene.light.name = "lamp";
    scene.left_out = {"tangents: no normal map"};
    scene.digest = "0123456789abcdef";
    scene.truth.visibility = Image<Visibility>(4, 3);
    scene.truth.visibility.pixels = {B, L, L, L, B, L, S, S, B, L, S, S};
    scene.truth.statistics.rays = 20;
    scene.truth.statistics.lit = 5;
    scene.truth.statistics.shadowed = 4;
    scene.truth.statistics.background = 3;

    Cell& cell = scene.cells.emplace_back();
    cell.technique = "zpass";
    cell.summary = "counts faces in front";
    cell.verdict = verdict;
    cell.milliseconds = 3.125;
    cell.frame.claim = Image<Visibility>(4, 3);
    cell.family = cell.frame.family = "stencil";
    cell.evidence = std::make_shared<HandmadeEvidence>();
    cell.frame.counted.emplace().volumes = Image<std::uint8_t>(4, 3);
    cell.frame.counted->volumes.pixels = {0, 1, 2, 2, 0, 1, 0, 255, 0, 0, 0, 0};
    cell.frame.claim.pixels = {B, L, L, L, B, L, L, S, B, S, S, L};
    Comparison& comparison = cell.comparison;
    comparison.cause = Image<std::uint8_t>(4, 3, no_difference);
    const auto mark = [&](int x, int y, Cause cause) {
        comparison.cause.at(x, y) = static_cast<std::uint8_t>(cause);
        ++comparison.causes[static_cast<std::size_t>(cause)];
        ++comparison.differing;
    };
    mark(2, 1, Cause::near_plane);
    mark(1, 2, Cause::edge);
    mark(3, 2, corner_cause);
    cell.cause_map = packed_cause_map(comparison);
    comparison.first = FirstDifference{2, 1, Cause::near_plane};
    comparison.evidence_name = "counter";
    if (verdict == Verdict::unexplained)
        comparison.evidence = {
            .equal = 9, .in_band = 1, .unexplained = 2, .first_x = 3, .first_y = 0};
    else
        comparison.evidence = {.equal = 11, .in_band = 1};
    VolumeCheck volumes;
    volumes.checked = 12;
    comparison.summary = summary_of(cell.frame, comparison.evidence, volumes);
    if (verdict == Verdict::fails_as_predicted) cell.excused = {Cause::near_plane};
    return scene;
}

inline Report handmade_report() {
    Report report;
    report.version = "1.2.3";
    report.gl = {"4.5 (Core)", "llvmpipe", 8, 24, 8};
    report.embree = "3.13.5";
    report.arguments = {"--size", "4x3"};
    report.scenes.push_back(
        handmade_scene("near_plane", Cause::near_plane, Verdict::fails_as_predicted));
    report.scenes.push_back(handmade_scene("broken", Cause::unexplained, Verdict::unexplained));
    return report;
}

} // namespace shadowproof
