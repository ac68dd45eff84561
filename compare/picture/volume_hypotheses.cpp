#include "compare/picture/hypotheses.h"

#include <fmt/format.h>

#include <functional>

namespace shadowproof {

namespace {

using Test = Counting::Test;

DepthModel without_far_plane(double near) {
    return {.projection = DepthModel::Projection::infinite, .near = near};
}

/// Z-fail as it is right, but for one thing.
Counting behind(const std::function<void(Counting&)>& change) {
    Counting counting{.test = Test::depth_fail, .flips = {.around_light = true}};
    change(counting);
    return counting;
}

/// Of the near planes that are tried: the camera's, or where an orthographic one has it at 0, one
/// next to that.
double middle_near(const Trial& trial) {
    const double near = trial.scene().camera.near;
    return near > 0 ? near : trial.traced().far() / 256;
}

void try_bits(Trial& trial, const VolumeCounts& counts) {
    const DepthModel model = without_far_plane(trial.scene().camera.near);
    const auto of_bits = [&](int bits) {
        return counts.predict(behind([&](Counting& c) { c.bits = bits; }), model,
                              trial.traced().far());
    };
    // What several explain alike is the one with most bits: stencil buffers have eight.
    int best = 0;
    std::int64_t best_score = 0;
    for (int bits = 8; bits > 0; --bits) {
        const std::int64_t score = trial.fit(of_bits(bits)).score();
        if (score <= best_score) continue;
        best = bits;
        best_score = score;
    }
    if (best > 0)
        trial.consider("stencil_bits", {{"bits", best}},
                       fmt::format("a counter of {} bit{} that wraps", best, best == 1 ? "" : "s"),
                       of_bits(best));
}

} // namespace

void try_counters(Trial& trial, const VolumeCounts& counts) {
    const DepthModel model = without_far_plane(trial.scene().camera.near);
    const double far = trial.traced().far();
    try_bits(trial, counts);
    trial.consider("missing_cap", {{"light_cap", 0}}, "z-fail without light caps",
                   counts.predict(behind([](Counting& c) { c.light_cap = false; }), model, far));
    trial.consider("missing_cap", {{"dark_cap", 0}}, "z-fail without dark caps",
                   counts.predict(behind([](Counting& c) { c.dark_cap = false; }), model, far));
}

void try_near_plane(Trial& trial, const VolumeCounts& counts) {
    const Counting in_front{.test = Test::depth_pass, .dark_cap = false};
    const double near = middle_near(trial);
    trial.search(
        {.hypothesis = "zpass",
         .parameter = "near",
         .predict =
             [&](double value) {
                 return counts.predict(in_front, without_far_plane(value), trial.traced().far());
             },
         .words =
             [](double value) {
                 return fmt::format("z-pass, which loses what lies before the near plane at {:.4g}",
                                    value);
             }},
        near / 16, near * 16);
}

void try_far_plane(Trial& trial, const VolumeCounts& counts) {
    const double near = trial.scene().camera.near;
    const Counting counting = behind([](Counting&) {});
    trial.search({.hypothesis = "zfail_far",
                  .parameter = "far",
                  .predict =
                      [&](double value) {
                          return counts.predict(counting, {.near = near, .far = value}, value);
                      },
                  .words =
                      [](double value) {
                          return fmt::format(
                              "z-fail, which loses what lies past the far plane at {:.4g}", value);
                      }},
                 4 * middle_near(trial), 4 * trial.traced().far());
}

void try_length(Trial& trial, const VolumeCounts& counts) {
    const double near = trial.scene().camera.near;
    const double far = trial.traced().far();
    trial.search({.hypothesis = "short_volumes",
                  .parameter = "length",
                  .predict =
                      [&](double value) {
                          return counts.predict(behind([&](Counting& c) { c.extrusion = value; }),
                                                without_far_plane(near), far);
                      },
                  .words =
                      [](double value) {
                          return fmt::format("shadow volumes that end {:.4g} behind their casters",
                                             value);
                      }},
                 middle_near(trial), 2 * far);
}

} // namespace shadowproof
