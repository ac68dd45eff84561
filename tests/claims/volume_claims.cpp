#include "tests/claims/volume_claims.h"

#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace shadowproof::claims {

namespace {

using Traced = std::unique_ptr<tests::TracedScene>;

std::vector<Traced> traced(std::initializer_list<const char*> names) {
    std::vector<Traced> all;
    for (const char* name : names)
        all.push_back(std::make_unique<tests::TracedScene>(load_scene(name, {})));
    return all;
}

Frame draw(const tests::TracedScene& traced, Gpu& gpu, std::string_view technique) {
    return render(*find_technique(technique), traced.scene, traced.plan, gpu);
}

std::uint64_t wrong_by(const tests::TracedScene& traced, Gpu& gpu, std::string_view technique,
                       Cause cause) {
    return tests::pixels_of(tests::compared(traced, technique, gpu), cause);
}

/// Fragments of the volumes' faces: all that pass through rasterization, and those that the stencil
/// counts, in front of what is seen or behind it.
struct Fill {
    std::uint64_t tested = 0;
    std::uint64_t in_front = 0;
    std::uint64_t behind() const { return tested - in_front; }
};

Fill fill_of(const Frame& frame) {
    const auto& volumes = frame.counted->volumes.pixels;
    return {frame.counted->volume_fragments,
            std::accumulate(volumes.begin(), volumes.end(), std::uint64_t{0})};
}

Section fill_rate(Gpu& gpu) {
    std::string text =
        "Kilgard: the reverse requires \"always truncating the shadow volumes and capping them\",\n"
        "which z-pass does not. Fragments of the volumes' faces that are tested, and of these the\n"
        "ones that change the stencil, those in front of what is seen for z-pass and those behind\n"
        "it for z-fail; and fragments of the sides alone:\n\n"
        "| scene | `zpass` tests | counts | `zfail_reversed` tests | counts | sides alone |\n"
        "|---|---|---|---|---|---|\n";
    for (const Traced& scene : traced({"ordinary", "overlapping", "idle_casters", "near_plane",
                                       "eye_inside", "light_on_face", "sun", "walking_figure"})) {
        const Fill pass = fill_of(draw(*scene, gpu, "zpass"));
        const Fill fail = fill_of(draw(*scene, gpu, "zfail_reversed"));
        // Without light caps, and without dark ones.
        const Fill all = fill_of(draw(*scene, gpu, "zfail_no_light_cap"));
        const Fill no_dark = fill_of(draw(*scene, gpu, "zfail_no_dark_cap"));
        const std::uint64_t sides = all.tested + no_dark.tested - fail.tested;
        text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", scene->scene.name, pass.tested,
                            pass.in_front, fail.tested, fail.behind(), sides);
    }
    text +=
        "\nZ-fail tests no more, but where volumes are seen to infinity and need dark caps\n"
        "(`light_on_face`): `zfail_reversed` leaves them out elsewhere. Light caps both draw:\n"
        "`zpass` needs those whose own surface is culled, being seen from behind. What differs is\n"
        "what is counted. Most faces lie in front of what is seen, so that z-pass changes the\n"
        "stencil more often than z-fail, but where the volumes lie behind (`walking_figure`).\n";
    return {"Z-fail costs more fill rate than z-pass", text, ""};
}

Section far_planes(Gpu& gpu) {
    constexpr std::array multiples{1.0, 2.0, 8.0, 64.0, 1e3, 1e5};
    std::string text =
        "Kilgard: the reverse \"shifts the problem\" to the far plane, and setting it far off\n"
        "\"does compromise the available depth buffer precision\". Wrong pixels of `zfail` by\n"
        "`far_plane` and by `precision`, with the camera's far plane so many times as far:\n\n"
        "| scene | 1 | 2 | 8 | 64 | 1000 | 100000 | `zfail_clamp`, 1 |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const char* name : {"far_plane", "far_cut", "long_shadow"}) {
        const Scene given = load_scene(name, {});
        text += fmt::format("| {} |", given.name);
        for (const double multiple : multiples) {
            Scene scene = given;
            scene.camera.far *= multiple;
            const tests::TracedScene there(std::move(scene));
            const Comparison found = tests::compared(there, "zfail", gpu);
            text += fmt::format(" {} + {} |", tests::pixels_of(found, Cause::far_plane),
                                tests::pixels_of(found, Cause::precision));
        }
        const tests::TracedScene there(given);
        const Comparison clamped = tests::compared(there, "zfail_clamp", gpu);
        text += fmt::format(" {} + {} |\n", tests::pixels_of(clamped, Cause::far_plane),
                            tests::pixels_of(clamped, Cause::precision));
    }
    text +=
        "\nThe problem shifts: volumes run to infinity, so that on `far_plane` no far plane is "
        "far\n"
        "enough, and only clamping depths, or a projection without far plane, is right. That it\n"
        "costs precision does not show. Depths are dense where the near plane is near: of N and "
        "F,\n"
        "moving F to infinity takes the share N / F of what tells depths apart, and no more.\n";
    return {"A far plane far enough costs precision", text, ""};
}

Section caps(Gpu& gpu) {
    std::string text =
        "Everitt & Kilgard: z-fail needs both caps. Wrong pixels by `cap` without the light caps,\n"
        "without the dark caps, and with both:\n\n"
        "| scene | no light cap | no dark cap | both |\n|---|---|---|---|\n";
    for (const Traced& scene : traced({"ordinary", "near_plane", "eye_inside", "seen_shadow",
                                       "long_shadow", "light_on_face"}))
        text += fmt::format("| {} | {} | {} | {} |\n", scene->scene.name,
                            wrong_by(*scene, gpu, "zfail_no_light_cap", Cause::cap),
                            wrong_by(*scene, gpu, "zfail_no_dark_cap", Cause::cap),
                            wrong_by(*scene, gpu, "zfail_reversed", Cause::cap));
    text +=
        "\nLight caps are, everywhere: behind what is seen lies first of all the cap that "
        "coincides\n"
        "with it. Dark caps are where a volume is seen to infinity: under a light on a caster,\n"
        "which darkens half of the world.\n";
    return {"Both caps are needed", text, ""};
}

/// Pixels that some volumes shadow, but whose number, kept in so many bits, reads zero.
std::uint64_t lost_in(const Image<std::int32_t>& counts, int bits) {
    const std::uint32_t kept = (1U << static_cast<unsigned>(bits)) - 1;
    return static_cast<std::uint64_t>(
        std::count_if(counts.pixels.begin(), counts.pixels.end(), [&](std::int32_t count) {
            return count != 0 && (static_cast<std::uint32_t>(count) & kept) == 0;
        }));
}

Section counters(Gpu& gpu) {
    std::string text =
        "Kilgard: increments and decrements need stencil bits, and hardware before\n"
        "EXT_stencil_wrap saturates. Pixels in shadow; those that some volumes shadow, of which "
        "so\n"
        "many bits lose the number, as it is a multiple of what they hold; and wrong pixels of\n"
        "`zfail_saturate`, whose 8 bits stop at zero, by `counter`:\n\n"
        "| scene | in shadow | 8 bits | 4 | 2 | 1 | saturating |\n|---|---|---|---|---|---|---|\n";
    for (const Traced& scene :
         traced({"ordinary", "overlapping", "nested", "idle_casters", "walking_figure"})) {
        const Frame frame = draw(*scene, gpu, "zfail_reversed");
        const Prediction prediction = tests::prediction_of(*scene, frame);
        text += fmt::format("| {} | {} |", scene->scene.name,
                            std::count(scene->truth.visibility.pixels.begin(),
                                       scene->truth.visibility.pixels.end(), Visibility::shadowed));
        for (const int bits : {8, 4, 2, 1})
            text += fmt::format(" {} |", lost_in(prediction.counts(), bits));
        text += fmt::format(" {} |\n", wrong_by(*scene, gpu, "zfail_saturate", Cause::counter));
    }
    text +=
        "\nEight bits lose none but on `nested`, made for it with 300 volumes, and four bits none\n"
        "on the others. One bit does where volumes hardly overlap, as inverting it does. But\n"
        "counting that saturates fails on every scene: z-fail meets faces in any order, and what "
        "a\n"
        "face takes off before another has put it on is lost.\n";
    return {"Counts wrap, and must", text, ""};
}

/// The scene with its light moved towards the nearest corner of a caster: to so much of the way.
Scene with_light_near(Scene scene, double share) {
    Light& light = scene.lights[scene.light];
    glm::dvec3 nearest(0);
    double least = std::numeric_limits<double>::infinity();
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts || mesh.triangle_count < 4) continue; // a floor casts nothing that is seen
        for (std::uint32_t i = 0; i < 3 * mesh.triangle_count; ++i) {
            const glm::dvec3 place =
                corner(scene, mesh.first_triangle + i / 3, static_cast<int>(i % 3));
            if (glm::distance(place, light.position) >= least) continue;
            least = glm::distance(place, light.position);
            nearest = place;
        }
    }
    light.position = nearest + share * (light.position - nearest);
    return scene;
}

Section collapsing_volumes(Gpu& gpu) {
    constexpr std::array shares{1.0, 0.5, 0.25, 0.125, 1.0 / 16, 1.0 / 64};
    std::string text =
        "Kilgard: \"capped shadow volumes eventually collapse into an increasingly marginal "
        "volume\n"
        "when the light gets extremely close\" to an occluder. Pixels in shadow, and of these the\n"
        "wrong ones of `zfail_truncated` by `extrusion`, with the light at so much of its way "
        "from\n"
        "the nearest corner of a caster; `zfail_reversed`, whose volumes are infinite, last:\n\n"
        "| scene | 1 | 1/2 | 1/4 | 1/8 | 1/16 | 1/64 | infinite, 1/64 |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const char* name : {"ordinary", "overlapping", "long_shadow"}) {
        text += fmt::format("| {} |", name);
        std::string infinite;
        for (const double share : shares) {
            const tests::TracedScene there(with_light_near(load_scene(name, {}), share));
            const auto in_shadow =
                std::count(there.truth.visibility.pixels.begin(),
                           there.truth.visibility.pixels.end(), Visibility::shadowed);
            text +=
                fmt::format(" {} of {} |",
                            wrong_by(there, gpu, "zfail_truncated", Cause::extrusion), in_shadow);
            if (share == shares.back())
                infinite =
                    fmt::format(" {} |", wrong_by(there, gpu, "zfail_reversed", Cause::extrusion));
        }
        text += infinite + "\n";
    }
    text +=
        "\nThey do: extruded by half the diagonal of the scene's box, volumes end before they "
        "reach\n"
        "the floor where the light's rays graze it. Very near a caster that is a part of all that\n"
        "it darkens; under the low light of `long_shadow` volumes are too short from the start.\n";
    return {"Truncated volumes collapse under a near light", text, ""};
}

} // namespace

std::vector<Section> volume_claims() {
    Gpu gpu(GlPlatform::osmesa);
    gpu.time_frames(3);
    return {fill_rate(gpu), far_planes(gpu), caps(gpu), counters(gpu), collapsing_volumes(gpu)};
}

} // namespace shadowproof::claims
