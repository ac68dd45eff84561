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

} // namespace

void try_counters(Trial& trial, const VolumeCounts& counts) {
    const DepthModel model = without_far_plane(trial.scene().camera.near);
    const double far = trial.traced().far();
    trial.consider("missing_cap", {{"light_cap", 0}}, "z-fail without light caps",
                   counts.predict(behind([](Counting& c) { c.light_cap = false; }), model, far));
    trial.consider("missing_cap", {{"dark_cap", 0}}, "z-fail without dark caps",
                   counts.predict(behind([](Counting& c) { c.dark_cap = false; }), model, far));
    for (const int bits : {1, 2, 3, 4})
        trial.consider("stencil_bits", {{"bits", bits}},
                       fmt::format("a counter of {} that wraps",
                                   bits == 1 ? "1 bit" : fmt::format("{} bits", bits)),
                       counts.predict(behind([&](Counting& c) { c.bits = bits; }), model, far));
}

void try_near_plane(Trial& trial, const VolumeCounts& counts) {
    const Counting in_front{.test = Test::depth_pass, .dark_cap = false};
    const double near = trial.scene().camera.near;
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
                 4 * near, 4 * trial.traced().far());
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
                 near, 2 * far);
}

} // namespace shadowproof
