#include "tests/claims/bump_claims.h"

#include "compare/color/color_check.h"
#include "raster/render.h"
#include "reference/shade/shading.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "scenes/surface/normalisation_cube.h"
#include "scenes/surface/plane_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

namespace shadowproof::claims {

namespace {

/// A bump-lit scene without an environment, traced.
struct Lit {
    Scene scene;
    Plan plan;
    Tracer tracer;
    GroundTruth truth;

    explicit Lit(Scene given)
        : scene(std::move(given)), plan(make_plan(scene)), tracer(scene), truth(trace(tracer)) {}
    Lit(const Lit&) = delete;
    Lit& operator=(const Lit&) = delete;
};

std::vector<std::unique_ptr<Lit>> lit_scenes() {
    std::vector<std::unique_ptr<Lit>> lit;
    for (const BundledScene& bundled : bundled_scenes()) {
        Scene scene = load_scene(std::string(bundled.name), {});
        // What they leave out, and what most of them take for something else (see `stretched`).
        if (is_bump_lit(scene) && !scene.environment && !has_heights_in_space(scene))
            lit.push_back(std::make_unique<Lit>(std::move(scene)));
    }
    return lit;
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

Frame draw(const Lit& lit, Gpu& gpu, const char* technique, const LightingSettings& settings = {}) {
    Plan plan = lit.plan;
    plan.asked.lighting = settings;
    return render(*find_technique(technique), lit.scene, plan, gpu);
}

/// How far two frames' colours are apart, over the pixels that both light alike.
struct Apart {
    std::uint64_t compared = 0;
    std::uint64_t differing = 0; ///< by half a step of 1/255 or more
    double largest = 0;          ///< in steps
    std::uint64_t grazing = 0; ///< of those that differ by more than `rounding` steps, so many are
                               ///< grazed by the light, L.N within (0, 1/8)
    std::uint64_t beyond = 0;  ///< that differ by more than `rounding` steps
    static constexpr double rounding = 6;
};

Apart apart(const Lit& lit, const Frame& one, const Frame& other) {
    const Image<Shading> terms = shade_terms(lit.tracer, lit.truth);
    Apart apart;
    for (std::size_t i = 0; i < one.color.pixels.size(); ++i) {
        if (one.triangle.pixels[i] == no_triangle ||
            one.triangle.pixels[i] != lit.truth.triangle.pixels[i] ||
            one.claim.pixels[i] != other.claim.pixels[i])
            continue;
        ++apart.compared;
        const glm::dvec3 off = glm::abs(glm::dvec3(one.color.pixels[i] - other.color.pixels[i]));
        const double steps = 255 * std::max({off.x, off.y, off.z});
        apart.largest = std::max(apart.largest, steps);
        if (steps >= 0.5) ++apart.differing;
        if (steps <= Apart::rounding) continue;
        ++apart.beyond;
        const double shadow = terms.pixels[i].self_shadow_light;
        if (shadow > 0 && shadow < 1) ++apart.grazing;
    }
    return apart;
}

Section one_pass_matches_three(const std::vector<std::unique_ptr<Lit>>& scenes, Gpu& gpu) {
    std::string text =
        "Kilgard: four combiner stages do in one pass what three passes do, and the result "
        "\"exactly\n"
        "matches\" theirs. Pixels of `bump_one_pass` against `bump_three_pass`:\n\n"
        "| scene | compared | differ | most | by more than 6/255 | of those, light grazes |\n"
        "|---|---|---|---|---|---|\n";
    std::string timing =
        "On GeForce hardware one pass is claimed to light 3 times the pixels a second (400 "
        "million\n"
        "against 133). Time of a frame in three passes over that in one, shadows included, on "
        "this\n"
        "rasterizer:\n\n| scene | three passes | one pass | ratio |\n|---|---|---|---|\n";
    for (const std::unique_ptr<Lit>& lit : scenes) {
        const Frame three = draw(*lit, gpu, "bump_three_pass");
        const Frame one = draw(*lit, gpu, "bump_one_pass");
        const Apart apart = claims::apart(*lit, three, one);
        text += fmt::format("| {} | {} | {} | {:.0f}/255 | {} | {} |\n", lit->scene.name,
                            apart.compared, apart.differing, apart.largest, apart.beyond,
                            apart.grazing);
        timing += fmt::format("| {} | {:.1f} ms | {:.1f} ms | {:.2f} |\n", lit->scene.name,
                              three.milliseconds, one.milliseconds,
                              three.milliseconds / one.milliseconds);
    }
    text +=
        "\nIt does not match. Both round after every stage, vectors from textures too; but the "
        "three\n"
        "passes add the ambient light before the decal, in bytes, and the four stages behind it; "
        "and\n"
        "these multiply the highlight by the self-shadowing of the light besides the half-angle\n"
        "vector's, which dims it where the light grazes the surface (the last column; see the "
        "next\n"
        "claim). Where colours run over, the three passes clamp before the decal, the combiners\n"
        "after it. Nor do two stages and the final one hold the rule's eighth power, its\n"
        "self-shadowing and a colour of the highlight: they are one product short, which the\n"
        "emulation grants them (raster/glsl/lighting/two_stages.glsl).\n";
    timing += "\nHere the arithmetic is emulated by a shader, so this says what passes cost, not\n"
              "what combiners would.\n";
    return {"One pass matches three, and is three times as quick", text, timing};
}

/// Root mean square difference of a frame's colours from others, in steps of 1/255, both clamped to
/// what bytes show, where surface and visibility are the truth's.
double rms_from(const Lit& lit, const Image<glm::dvec3>& right, const Frame& frame) {
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < right.pixels.size(); ++i) {
        if (lit.truth.triangle.pixels[i] == no_triangle ||
            frame.triangle.pixels[i] != lit.truth.triangle.pixels[i] ||
            frame.claim.pixels[i] != lit.truth.visibility.pixels[i])
            continue;
        const glm::dvec3 claimed = glm::clamp(glm::dvec3(frame.color.pixels[i]), 0.0, 1.0);
        const glm::dvec3 off = 255.0 * (claimed - glm::clamp(right.pixels[i], 0.0, 1.0));
        sum += glm::dot(off, off);
        count += 3;
    }
    return std::sqrt(sum / count);
}

Image<glm::dvec3> shaded(const Lit& lit, HighlightShadow shadow) {
    Scene scene = lit.scene;
    scene.highlight.shadow = shadow;
    return shade(Tracer(scene), lit.truth);
}

Section whose_self_shadowing(const std::vector<std::unique_ptr<Lit>>& scenes, Gpu& gpu) {
    std::string readings =
        "Kilgard prints a rule, The Required Per-Pixel Math, in which the light's self-shadowing,\n"
        "`min(8 max(0, L.z), 1)`, dims both terms. The passes that he shows for it do otherwise: "
        "of\n"
        "the three, the one that makes the highlight binds H alone, and so has H's; the single "
        "one\n"
        "multiplies both. The printed rule is the truth here. Pixels whose true colour another\n"
        "reading changes by more than 1/255, and by how much at most:\n\n"
        "| scene | H's | | both | | none | |\n|---|---|---|---|---|---|---|\n";
    std::string techniques =
        "\nThe techniques from the truth under each reading, root mean square in 1/255:\n\n"
        "| scene | three passes: L's | H's | both | one pass: L's | H's | both |\n"
        "|---|---|---|---|---|---|---|\n";
    using enum HighlightShadow;
    for (const std::unique_ptr<Lit>& lit : scenes) {
        const Image<glm::dvec3> rule = shaded(*lit, light);
        readings += fmt::format("| {} |", lit->scene.name);
        for (const HighlightShadow other : {half_angle, both, none}) {
            const Image<glm::dvec3> read = shaded(*lit, other);
            std::uint64_t changed = 0;
            double most = 0;
            for (std::size_t i = 0; i < read.pixels.size(); ++i) {
                const double off = 255 * largest(glm::abs(glm::clamp(read.pixels[i], 0.0, 1.0) -
                                                          glm::clamp(rule.pixels[i], 0.0, 1.0)));
                changed += off > 1 ? 1 : 0;
                most = std::max(most, off);
            }
            readings += fmt::format(" {} | {:.0f}/255 |", changed, most);
        }
        readings += '\n';
        techniques += fmt::format("| {} |", lit->scene.name);
        for (const char* name : {"bump_three_pass", "bump_one_pass"}) {
            const Frame frame = draw(*lit, gpu, name);
            for (const HighlightShadow reading : {light, half_angle, both})
                techniques +=
                    fmt::format(" {:.2f} |", rms_from(*lit, shaded(*lit, reading), frame));
        }
        techniques += '\n';
    }
    const char* const found =
        "\nThe documents disagree with themselves. Rule and single pass are nearly one: where the\n"
        "half-angle vector grazes a surface, the light does, too, but for few pixels. The three\n"
        "passes leave highlights as bright as they are where the light hardly arrives, near the\n"
        "terminator. `extras.shadowproof.highlight` makes each reading the truth.\n";
    return {"Whose self-shadowing dims the highlight", readings + techniques + found, ""};
}

Section spaces_agree(const std::vector<std::unique_ptr<Lit>>& scenes, Gpu& gpu) {
    std::string text =
        "CS448: the fast algorithm in tangent space gives what the basic one gives in eye space. "
        "In\n"
        "floats, with exact normalisation:\n\n"
        "| scene | compared | apart at most | eye space from the truth | tangent space |\n"
        "|---|---|---|---|---|\n";
    for (const std::unique_ptr<Lit>& lit : scenes) {
        const Frame eye = draw(*lit, gpu, "bump_eye_space");
        const Frame tangent = draw(*lit, gpu, "bump_tangent_space");
        const Apart apart = claims::apart(*lit, eye, tangent);
        text += fmt::format("| {} | {} | {:.2f}/255 | {:.2f}/255 | {:.2f}/255 |\n", lit->scene.name,
                            apart.compared, apart.largest,
                            check_colors(lit->tracer, lit->truth, eye).largest,
                            check_colors(lit->tracer, lit->truth, tangent).largest);
    }
    text +=
        "\nThey do, as long as vectors are carried into tangent space at each pixel. The lecture\n"
        "carries them there at the vertices (see the next claim), and its `N' = N + h_u (N x P_u) "
        "+ h_v (P_v x N)`\n"
        "has the two derivatives the other way round: with a height field, the normal leans\n"
        "along `N x P_v` for a slope in u.\n";
    return {"Eye space and tangent space agree", text, ""};
}

/// What each step of a technique of 2001 costs by itself, and all of them together.
Section shares_of_the_error(const std::vector<std::unique_ptr<Lit>>& scenes, Gpu& gpu) {
    using enum VectorOrigin;
    std::string text =
        "CS448 and Kilgard carry L and H into tangent space at the vertices, interpolate them,\n"
        "and normalise them by a cube map; Kilgard's tangents are each polygon's own, and his\n"
        "arithmetic has 9 bits. Root mean square distances from the truth in 1/255: first those\n"
        "of `bump_tangent_space`, in floats at each pixel, as it is and with one of these steps\n"
        "and no other; then those of the four combiner stages, held against the truth with the\n"
        "highlight dimmed as they do it, with exact vectors at each pixel and with all steps:\n\n"
        "| scene | as it is | at vertices | and normalised there | polygons' tangents | cube map "
        "| 9 bits | all |\n|---|---|---|---|---|---|---|---|\n";
    for (const std::unique_ptr<Lit>& lit : scenes) {
        const Image<glm::dvec3> rule = shaded(*lit, lit->scene.highlight.shadow);
        const Image<glm::dvec3> both = shaded(*lit, HighlightShadow::both);
        text += fmt::format("| {} |", lit->scene.name);
        for (const LightingSettings& settings :
             {LightingSettings{}, LightingSettings{.vectors = at_vertices},
              LightingSettings{.vectors = unit_at_vertices},
              LightingSettings{.tangents = TangentSource::polygons},
              LightingSettings{.normalisation = Normalisation::cube_map}})
            text += fmt::format(
                " {:.2f} |", rms_from(*lit, rule, draw(*lit, gpu, "bump_tangent_space", settings)));
        const Frame bytes =
            draw(*lit, gpu, "bump_one_pass_per_pixel", {.normalisation = Normalisation::exact});
        const Frame all = draw(*lit, gpu, "bump_one_pass", {.tangents = TangentSource::polygons});
        text += fmt::format(" {:.2f} | {:.2f} |\n", rms_from(*lit, both, bytes),
                            rms_from(*lit, both, all));
    }
    text +=
        "\nOn finely tessellated models the bytes cost most, most of all where filtering leaves\n"
        "normals short of their length. On coarse ones it is the vertices: `coarse_curve` lacks\n"
        "the \"reasonable tessellation around curvature\" that the slides assume. L is linear "
        "over\n"
        "a flat triangle while it keeps its length, so that normalising it at the vertices, as\n"
        "the lecture does, makes it worse there.\n";
    return {"How much is interpolation, the cube map, the bytes", text, ""};
}

/// Heights in units of space, on texels that are no squares.
Section stretched(Gpu& gpu) {
    std::string text =
        "CS448, \"Distortions\": the length of the parametric derivatives controls the relative\n"
        "height of bumps across the surface. With heights in units of space, how far techniques\n"
        "are from the truth, root mean square and at most, in 1/255:\n\n"
        "| scene | `bump_eye_space` | | `bump_tangent_space` | | `bump_one_pass` | |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const char* name : {"stretched_relief", "skewed_relief"}) {
        const Lit lit(load_scene(name, {}));
        text += fmt::format("| {} |", name);
        for (const char* technique : {"bump_eye_space", "bump_tangent_space", "bump_one_pass"}) {
            const ColorCheck colors =
                check_colors(lit.tracer, lit.truth, draw(lit, gpu, technique));
            text += fmt::format(" {:.2f} | {:.2f} |", colors.rmse, colors.largest);
        }
        text += '\n';
    }
    text +=
        "\nIt does. Blinn's formula with the derivatives' true length, in eye space, is the "
        "truth;\n"
        "tangent space, whose frame is of unit vectors, knows no lengths, and a normal map has\n"
        "none: both take all texels for squares of one size.\n";
    return {"Stretched mappings change how steep bumps are", text, ""};
}

Section cube_map_error() {
    std::string text = "A cube map normalises vectors (Voorhies and Foran 1994; "
                       "Kilgard), with 8 bits a\n"
                       "component and bilinear filtering within a face. How far what is looked up "
                       "is from the unit\n"
                       "vector, over 6 x 509 x 509 directions:\n\n"
                       "| texels a side | at most | rms | bound |\n|---|---|---|---|\n";
    for (int size = 4; size <= 512; size *= 2) {
        const NormalisationCube cube = make_normalisation_cube(size);
        double largest = 0;
        double squares = 0;
        constexpr int side = 509;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    glm::dvec3 direction(0);
                    direction[face / 2] = face % 2 == 0 ? 1 : -1;
                    direction[(face / 2 + 1) % 3] = (2 * x + 1.0) / side - 1;
                    direction[(face / 2 + 2) % 3] = (2 * y + 1.0) / side - 1;
                    const double off =
                        glm::length(looked_up(cube, direction) - glm::normalize(direction));
                    largest = std::max(largest, off);
                    squares += off * off;
                }
        // FileBytes: sqrt 3 times 1/255. Between texels h apart the chord of a curve whose second
        // derivatives are at most 1 lies within h^2 / 8 of it an axis; past the last texel's
        // centre, h / 2 from the edge, the texel stays, and the vector turns by at most 1 / sqrt 2
        // of that (at the middle of an edge) an axis.
        const double h = 2.0 / size;
        const double bound =
            std::sqrt(3.0) / 255 + h * h / 4 + h / 2 * std::sqrt(0.5) * std::sqrt(2.0);
        text += fmt::format("| {} | {:.5f} | {:.5f} | {:.5f} |\n", size, largest,
                            std::sqrt(squares / (6.0 * side * side)), bound);
    }
    text += "\nUp to 32 texels a side the mean is the filter's, beyond that the 8 bits': a larger "
            "cube\n"
            "gains little. The worst vectors lie along the faces' edges, where no filter reaches\n"
            "over. One step of Newton and Raphson from a guess by the float's bits leaves 0.00175\n"
            "(Lomont 2003), everywhere.\n";
    return {"A cube map normalises vectors", text, ""};
}

Section plane_coefficients() {
    std::mt19937 random(2001);
    const auto integer = [&] { return static_cast<double>(random() % 128) - 64; };
    const auto triangle = [&] {
        std::array<glm::dvec3, 3> corners{};
        for (glm::dvec3& corner : corners) corner = {integer(), integer(), integer()};
        return corners;
    };
    constexpr int triangles = 10000;
    int tried = 0;
    int exact = 0;
    double turned = 0;
    for (int i = 0; i < triangles; ++i) {
        const std::array<glm::dvec3, 3> from = triangle();
        const std::array<glm::dvec3, 3> to = triangle();
        std::array<glm::dvec2, 3> at{};
        for (glm::dvec2& place : at) place = {integer(), integer()};
        const PlaneEquations first = plane_equations(from, at);
        const PlaneEquations last = plane_equations(to, at);
        if (first.a == 0) continue;
        std::array<glm::dvec3, 3> between{};
        for (std::size_t k = 0; k < 3; ++k) between[k] = 0.5 * (from[k] + to[k]);
        const PlaneEquations there = plane_equations(between, at);
        const PlaneEquations mixed = mix(first, last, 0.5);
        ++tried;
        exact += there.a == mixed.a && there.b == mixed.b && there.c == mixed.c ? 1 : 0;
        const glm::dvec3 tangent = directions_of(there).along_s;
        const glm::dvec3 of_tangents = directions_of(first).along_s + directions_of(last).along_s;
        if (tangent == glm::dvec3(0) || of_tangents == glm::dvec3(0)) continue;
        const double cosine = glm::dot(tangent, glm::normalize(of_tangents));
        turned = std::max(turned, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    std::string text = fmt::format(
        "Kilgard: of key-framed skins, whose vertices are interpolated linearly, the planes\n"
        "`A x + B s + C t + D = 0` that tangents are made of may be interpolated as well, "
        "exactly.\n"
        "Of {} random triangles of small integers, half way between two key frames, {} have the\n"
        "same coefficients either way, to the last bit. The claim holds: texture coordinates "
        "stay,\n"
        "so A is constant and the others are linear in time. Interpolating the tangents "
        "themselves\n"
        "is another thing: it turns them by up to {:.0f} degrees. (The slides divide by A1 for "
        "A2.)\n",
        tried, exact, turned * 180 / 3.14159265358979324);
    return {"Plane coefficients of key frames may be interpolated", text, ""};
}

} // namespace

std::vector<Section> bump_claims() {
    const std::vector<std::unique_ptr<Lit>> scenes = lit_scenes();
    Gpu gpu(GlPlatform::osmesa);
    gpu.time_frames(3);
    return {one_pass_matches_three(scenes, gpu),
            whose_self_shadowing(scenes, gpu),
            spaces_agree(scenes, gpu),
            shares_of_the_error(scenes, gpu),
            stretched(gpu),
            cube_map_error(),
            plane_coefficients()};
}

} // namespace shadowproof::claims
