#include "tests/claims/map_claims.h"

#include "compare/families.h"
#include "compare/maps/light_view.h"
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

namespace shadowproof::claims {

namespace {

using Traced = std::unique_ptr<tests::TracedScene>;

Traced traced(const std::string& name, double time = 0) {
    SceneRequest request;
    request.time = time;
    return std::make_unique<tests::TracedScene>(load_scene(name, request));
}

Frame draw(const tests::TracedScene& traced, Gpu& gpu, std::string_view technique,
           const MapSettings& settings = {}) {
    Plan plan = traced.plan;
    plan.asked.map = settings;
    return render(*find_technique(technique), traced.scene, plan, gpu);
}

/// Pixels that are wrong beyond an edge.
std::uint64_t wrong(const Comparison& comparison) {
    return comparison.differing - tests::pixels_of(comparison, Cause::edge);
}

/// What all sections of cube maps are measured on.
std::vector<Traced> stages() {
    std::vector<Traced> all;
    for (const char* name : {"ordinary", "near_plane", "thin_caster", "cube_edge"})
        all.push_back(traced(name));
    return all;
}

Section aliasing(const std::vector<Traced>& scenes, Gpu& gpu) {
    constexpr std::array sizes{64, 256, 1024, 4096};
    std::string text =
        "VGP353: shadow volumes are made in the space of the objects, \"no aliasing artifacts\";\n"
        "Kilgard: maps are ill-advised where \"shadows must be crisp and free of sampling\n"
        "artifacts\". Pixels that are wrong, edges aside, of `zfail_reversed`, and of\n"
        "`cube_map_six_pass` with so many texels a side and a bias of 0.05; in brackets those by\n"
        "`resolution`:\n\n"
        "| scene | volumes | 64 | 256 | 1024 | 4096 |\n|---|---|---|---|---|---|\n";
    for (const Traced& scene : scenes) {
        text += fmt::format("| {} | {} |", scene->scene.name,
                            wrong(tests::compared(*scene, "zfail_reversed", gpu)));
        for (const int size : sizes) {
            const Comparison map = tests::compared(
                *scene, draw(*scene, gpu, "cube_map_six_pass", {.size = size, .bias = 0.05}));
            text += fmt::format(" {} ({}) |", wrong(map), tests::pixels_of(map, Cause::resolution));
        }
        text += "\n";
    }
    text +=
        "\nIt holds. More texels leave fewer pixels wrong, and no map that was tried is free of "
        "them.\nThe one pixel of the volumes is wrong by `precision`.\n";
    return {"Shadow volumes do not alias, shadow maps do", text, ""};
}

Section bias(const std::vector<Traced>& scenes, Gpu& gpu) {
    std::string text =
        "CS448: \"too little bias, everything begins to shadow\"; \"too much bias, shadow starts "
        "too\n"
        "far back\". VGP353 of volumes: \"no shadow acne either\". Pixels that shadow themselves\n"
        "(`acne`) and into which light leaks (`leak`), of `cube_map_six_pass`:\n\n"
        "| scene | volumes, either | bias 0: acne | leak | 0.15: acne | leak | 0.5: acne | leak |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const Traced& scene : scenes) {
        const Comparison volumes = tests::compared(*scene, "zfail_reversed", gpu);
        text += fmt::format("| {} | {} |", scene->scene.name,
                            tests::pixels_of(volumes, Cause::acne) +
                                tests::pixels_of(volumes, Cause::leak));
        for (const double bias : {0.0, 0.15, 0.5}) {
            const Comparison map =
                tests::compared(*scene, draw(*scene, gpu, "cube_map_six_pass", {.bias = bias}));
            text += fmt::format(" {} | {} |", tests::pixels_of(map, Cause::acne),
                                tests::pixels_of(map, Cause::leak));
        }
        text += "\n";
    }
    text += "\nIt holds. The constant of the geometry-shader paper, 0.15, leaves no acne on these\n"
            "scenes, which are some metres wide, and lets light leak where casters are close to\n"
            "what they shadow.\n";
    return {"Too little bias shadows everything, too much detaches shadows", text, ""};
}

Section dynamic_scenes(Gpu& gpu) {
    constexpr std::array biases{0.02, 0.05, 0.15, 0.3};
    std::string text =
        "CS448: precision and bias lead to \"hand tuning per scene; difficult for dynamic "
        "scenes\".\n"
        "Wrong pixels of `cube_map_six_pass` as time passes, by bias, the least of each row in "
        "bold:\n\n"
        "| scene | time | volumes | 0.02 | 0.05 | 0.15 | 0.3 |\n|---|---|---|---|---|---|---|\n";
    for (const char* name : {"walking_figure", "moving_light"})
        for (const double time : {0.0, 0.25, 0.5, 0.75}) {
            const Traced scene = traced(name, time);
            std::vector<std::uint64_t> of_bias;
            for (const double bias : biases)
                of_bias.push_back(wrong(tests::compared(
                    *scene, draw(*scene, gpu, "cube_map_six_pass", {.bias = bias}))));
            text += fmt::format("| {} | {} | {} |", scene->scene.name, time,
                                wrong(tests::compared(*scene, "zfail_reversed", gpu)));
            const std::uint64_t least = *std::ranges::min_element(of_bias);
            for (const std::uint64_t pixels : of_bias)
                text += pixels == least ? fmt::format(" **{}** |", pixels)
                                        : fmt::format(" {} |", pixels);
            text += "\n";
        }
    text +=
        "\nThe bias has to be tuned, but it holds while these scenes move: the same one is best "
        "throughout.\n";
    return {"The bias is tuned by hand, which motion makes difficult", text, ""};
}

Section one_pass_of_six(const std::vector<Traced>& scenes, Gpu& gpu) {
    std::string text =
        "Omni-directional shadows with geometry shaders: a single pass, which sends each triangle "
        "to\n"
        "all six faces, replaces the six passes. Of `cube_map_geometry_shader` against\n"
        "`cube_map_six_pass`:\n\n| scene | texels | texels that differ | pixels that differ |\n"
        "|---|---|---|---|\n";
    std::string timing = "Time of drawing the map, on this rasterizer:\n\n"
                         "| scene | triangles | six passes | one pass | ratio |\n"
                         "|---|---|---|---|---|\n";
    for (const Traced& scene : scenes) {
        const Frame six = draw(*scene, gpu, "cube_map_six_pass");
        const Frame one = draw(*scene, gpu, "cube_map_geometry_shader");
        std::size_t texels = 0;
        std::size_t differing = 0;
        for (std::size_t face = 0; face < six.mapped->faces.size(); ++face) {
            const std::vector<float>& of_six = six.mapped->faces[face].pixels;
            const std::vector<float>& of_one = one.mapped->faces[face].pixels;
            texels += of_six.size();
            for (std::size_t i = 0; i < of_six.size(); ++i) differing += of_six[i] != of_one[i];
        }
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < six.claim.pixels.size(); ++i)
            pixels += six.claim.pixels[i] != one.claim.pixels[i];
        text +=
            fmt::format("| {} | {} | {} | {} |\n", scene->scene.name, texels, differing, pixels);
        const double of_six = six.mapped->map_milliseconds;
        const double of_one = one.mapped->map_milliseconds;
        timing += fmt::format("| {} | {} | {:.1f} ms | {:.1f} ms | {:.2f} |\n", scene->scene.name,
                              scene->scene.triangles.size(), of_six, of_one, of_six / of_one);
    }
    text += "\nThe maps are the same, to the last bit.\n";
    timing +=
        "\nHere both do the same work on the same processor, and neither is clearly quicker.\n";
    return {"One pass draws the six faces of a cube", text, timing};
}

/// Of the receivers' pixels that face the light, on which face of a cube around it they lie.
std::array<std::uint64_t, 6> pixels_by_face(const tests::TracedScene& traced) {
    std::array<std::uint64_t, 6> pixels{};
    const Camera& camera = traced.scene.camera;
    const glm::dvec3& light = chosen_light(traced.scene).position;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const std::uint32_t triangle = traced.truth.triangle.at(x, y);
            if (triangle == no_triangle || !sides_of(traced.tracer, triangle).faces_light())
                continue;
            const glm::dvec3 point =
                camera.eye + traced.truth.depth.at(x, y) * line_of_sight(camera, x + 0.5, y + 0.5);
            ++pixels[face_of(point - light)];
        }
    return pixels;
}

Section omnidirectional(const std::vector<Traced>& scenes) {
    std::string text =
        "Kilgard, and the geometry-shader paper: a map suits \"camera-like\" lights, spots; for "
        "one that\n"
        "shines everywhere, a cube needs six. Of what the picture shows and the light faces: on "
        "how\n"
        "many of the six faces it lies, and how much of it on the face that holds most, which is "
        "all "
        "that a\n"
        "single map of 90 degrees along an axis could serve:\n\n"
        "| scene | faces | on one face |\n|---|---|---|\n";
    for (const Traced& scene : scenes) {
        const std::array<std::uint64_t, 6> pixels = pixels_by_face(*scene);
        std::uint64_t all = 0;
        for (const std::uint64_t each : pixels) all += each;
        text += fmt::format("| {} | {} | {:.1f} % |\n", scene->scene.name,
                            6 - std::ranges::count(pixels, 0U),
                            100.0 * static_cast<double>(*std::ranges::max_element(pixels)) /
                                static_cast<double>(all));
    }
    text +=
        "\nIt holds where casters stand around the light; above them one map that looks down would "
        "do.\n";
    return {"A light that shines everywhere needs six maps", text, ""};
}

Section precision(Gpu& gpu) {
    const Traced spot = traced("spot");
    std::string text =
        "Kilgard: the dual-texture technique (Heidrich 1999) has \"limited depth precision\", "
        "hardware\n"
        "maps have \"high\". Wrong pixels of `spot`, with a bias of 0.05, and those by\n"
        "`precision`, where the light's far plane is just beyond the casters, and where it is at "
        "200:\n\n"
        "| technique | stored | wrong | by precision | wrong at 200 | by precision |\n"
        "|---|---|---|---|---|---|\n";
    const auto row = [&](const char* technique, const char* words, MapFormat format) {
        text += fmt::format("| `{}` | {} |", technique, words);
        for (const std::optional<double> far : {std::optional<double>(), std::optional(200.0)}) {
            const Comparison map = tests::compared(
                *spot, draw(*spot, gpu, technique, {.bias = 0.05, .format = format, .far = far}));
            text += fmt::format(" {} | {} |", wrong(map), tests::pixels_of(map, Cause::precision));
        }
        text += "\n";
    };
    row("spot_map_dual_texture", "8 bits, linear", MapFormat::d24); // which it does not heed
    row("spot_map", "16 bits, window depths", MapFormat::d16);
    row("spot_map", "24 bits, window depths", MapFormat::d24);
    row("spot_map", "32 bits, floats", MapFormat::d32f);
    text +=
        "\nIt holds where the map's range is long against the distances between casters and their\n"
        "shadows. Within a step of the ramp two depths count as equal, which is a bias of its own: "
        "it\n"
        "mends acne, and loses what is closer to its shadow. Window depths of 16 bits fail by a "
        "near plane close to the light, "
        "which is a\n"
        "1,024th of the far plane here.\n";
    return {"Two textures of bytes have limited precision", text, ""};
}

Section filtering(Gpu& gpu) {
    std::string text =
        "CS448, after Reeves, Salesin and Cook: compare first, then average. The geometry-shader "
        "paper\n"
        "filters the stored distances linearly instead, and clamps at the faces' edges. "
        "`cube_edge` "
        "has\n"
        "shadows across such edges. With blocks of 4 x 4 texels and a bias of 0.15: pixels that "
        "are\n"
        "partly lit; those that are wrong as a whole, edges aside; and of these those by "
        "`seam`:\n\n"
        "| texels a side | averaged | beyond a face | partly lit | wrong as a whole | by seam |\n"
        "|---|---|---|---|---|---|\n";
    const Traced scene = traced("cube_edge");
    for (const int size : {64, 256})
        for (const MapAverage average : all_map_averages)
            for (const MapEdges edges : all_map_edges) {
                const Frame frame = draw(
                    *scene, gpu, "cube_map_pcf",
                    {.size = size, .bias = 0.15, .filter = 4, .average = average, .edges = edges});
                const Comparison map = tests::compared(*scene, frame);
                const auto partly = static_cast<std::uint64_t>(
                    std::ranges::count(frame.claim.pixels, Visibility::partly_lit));
                text +=
                    fmt::format("| {} | {} | {} | {} | {} | {} |\n", size, name_of(average),
                                edges == MapEdges::clamped ? "its border" : "the next face", partly,
                                wrong(map) - partly, tests::pixels_of(map, Cause::seam));
            }
    text +=
        "\nIt holds: a mean of comparisons blurs the border of a shadow, where a mean of depths "
        "is the\n"
        "depth of no surface, and lights or darkens pixels as a whole. Repeating the border of a "
        "face\n"
        "adds a seam to that; of comparisons it changes shares alone.\n";
    return {"Comparisons are filtered, not depths", text, ""};
}

Section fill_rate(const std::vector<Traced>& scenes, Gpu& gpu) {
    std::string text =
        "CS448 and VGP353: \"drawing shadow volumes consumes lots of fill rate\", where maps need "
        "\"one\n"
        "additional drawing only\". Fragments of all volume faces of `zfail_reversed`, and texels "
        "that\n"
        "hold a caster in a cube of 6 x 512 x 512; the picture has 262,144 pixels:\n\n"
        "| scene | of volumes | of the map |\n|---|---|---|\n";
    std::string timing = "Time of a whole frame, on this rasterizer:\n\n"
                         "| scene | volumes | map |\n|---|---|---|\n";
    for (const Traced& scene : scenes) {
        const Frame volumes = draw(*scene, gpu, "zfail_reversed");
        const Frame map = draw(*scene, gpu, "cube_map_six_pass", {.size = 512});
        std::ptrdiff_t texels = 0;
        for (const Image<float>& face : map.mapped->faces)
            texels += std::ranges::count_if(face.pixels, [](float stored) { return stored < 1; });
        text += fmt::format("| {} | {} | {} |\n", scene->scene.name,
                            volumes.counted->volume_fragments, texels);
        timing += fmt::format("| {} | {:.1f} ms | {:.1f} ms |\n", scene->scene.name,
                              volumes.milliseconds, map.milliseconds);
    }
    text += "\nIt holds: faces of volumes cover the picture several times, casters a part of their "
            "map, "
            "once.\n";
    return {"Volumes consume fill rate", text, timing};
}

} // namespace

std::vector<Section> map_claims() {
    const std::vector<Traced> scenes = stages();
    Gpu gpu(GlPlatform::osmesa);
    gpu.time_frames(3);
    return {fill_rate(scenes, gpu),  aliasing(scenes, gpu),
            bias(scenes, gpu),       dynamic_scenes(gpu),
            precision(gpu),          filtering(gpu),
            omnidirectional(scenes), one_pass_of_six(scenes, gpu)};
}

} // namespace shadowproof::claims
