// Pictures as other renderers would make them, and what is read of them.
#pragma once

#include "compare/picture/predict.h"
#include "compare/picture/reading/shading_normals.h"
#include "compare/picture/reading/shadow_classes.h"
#include "compare/picture/surface_colors.h"
#include "scenes/error.h"
#include "scenes/spot_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace shadowproof::tests {

/// What a renderer knows of a point that the light faces.
struct Point {
    double sine = 0;        ///< of the angle at which the light falls
    double distance = 1;    ///< from the light, over the nearest point's; 1 where it is directional
    double smooth_sine = 0; ///< the same by normals that are smooth across triangles, at least 0
    double on_half = 0;     ///< cosine of that normal and the way half between light and eye
    double into_cone = 1;   ///< from a spot's outer cone (0) to its inner one (1), by the cosine
    double albedo = 1;      ///< of a texture with dark and light texels, each as large as a pixel
    std::uint32_t mesh = 0; ///< known of all surfaces
};

inline double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// How a renderer makes a value of it.
struct Style {
    const char* name;
    std::function<double(const Point&)> light;
    double ambient = 0.1;
    std::function<double(double)> encode = srgb;
    bool textured = false;
    bool needs_twins = false; ///< both of them
    bool of_spots = false;    ///< else as "diffuse"
    /// What some meshes are darker by, and shine by themselves, as others do not.
    double paint = 1;
    double glow = 0;
    std::uint32_t painted = 1; ///< which third of the meshes
};

inline const std::vector<Style>& styles() {
    static const auto lambert = [](const Point& p) { return 0.5 * p.sine; };
    static const std::vector<Style> all{
        {"diffuse", lambert},
        {"linear", lambert, 0.1, [](double linear) { return linear; }},
        {"filmic", lambert, 0.1,
         [](double x) { return srgb(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)); }},
        {"black_shadows", lambert, 0},
        {"textured", lambert, 0.1, srgb, true},
        {"flat", [](const Point&) { return 0.5; }},
        {"wrapped", [](const Point& p) { return 0.5 * std::pow(0.5 + 0.5 * p.sine, 2); }},
        {"toon", [](const Point& p) { return p.sine > 0.5 ? 0.6 : 0.3; }},
        {"falling_off", [](const Point& p) { return 0.8 * p.sine / (p.distance * p.distance); }},
        {"over_exposed", [](const Point& p) { return 3 * p.sine; }},
        {"smooth", [](const Point& p) { return 0.5 * p.smooth_sine; }},
        {"shiny",
         [](const Point& p) {
             return p.smooth_sine > 0 ? 0.3 * p.smooth_sine + 0.6 * std::pow(p.on_half, 32) : 0;
         }},
        // Where it shows no light, nobody knows without both twins that it should not.
        {"metal",
         [](const Point& p) { return p.smooth_sine > 0 ? 0.8 * std::pow(p.on_half, 12) : 0; }, 0.1,
         srgb, false, true},
        {"painted", lambert, 0.1, srgb, false, false, false, 0.7},
        {"faintly_painted", lambert, 0.1, srgb, false, false, false, 0.95},
        {"glowing", lambert, 0.1, srgb, false, false, false, 1, 0.2},
        {"faintly_glowing", lambert, 0.1, srgb, false, false, false, 1, 0.02},
        {"spot_squared", [](const Point& p) { return 0.5 * p.sine * std::pow(p.into_cone, 2); },
         0.1, srgb, false, false, true},
        {"spot_smooth",
         [](const Point& p) {
             return 0.5 * p.sine * std::pow(p.into_cone, 2) * (3 - 2 * p.into_cone);
         },
         0.1, srgb, false, false, true},
        {"spot_steep", [](const Point& p) { return 0.5 * p.sine * std::pow(p.into_cone, 6); }, 0.1,
         srgb, false, false, true},
        // As bumps that nobody knows make it.
        {"rough", [](const Point& p) { return 0.5 * p.sine * (0.3 + 0.7 * p.albedo); }},
    };
    return all;
}

/// Of each pixel that faces the light.
inline Image<Point> points_of(const shadowproof::TracedScene& traced) {
    const Scene& scene = traced.scene();
    const Image<std::uint32_t>& seen = traced.truth().triangle;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::vector<std::uint32_t> triangles(scene.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    const ShadingNormals normals(scene, triangles);
    Image<Point> points(seen.width, seen.height);
    double nearest = std::numeric_limits<double>::infinity();
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const std::uint32_t triangle = seen.at(x, y);
            if (triangle != no_triangle) points.at(x, y).mesh = mesh_of(scene, triangle);
            if (!faces_light(traced, seen.index(x, y))) continue;
            const glm::dvec3 point = seen_point(traced, x, y);
            const glm::dvec3 way = glm::dvec3(light) - light.w * point;
            Point& made = points.at(x, y);
            made.sine = sine_to_light(scene, triangle, point);
            const glm::dvec3 flat = normals.at(NormalsBy::faces, triangle, point);
            const glm::dvec3 normal =
                (glm::dot(flat, way) < 0 ? -1.0 : 1.0) *
                glm::normalize(normals.at(NormalsBy::vertices, triangle, point));
            const glm::dvec3 to_light = glm::normalize(way);
            made.smooth_sine = std::max(0.0, glm::dot(normal, to_light));
            made.on_half = std::max(
                0.0, glm::dot(normal,
                              glm::normalize(to_light + glm::normalize(scene.camera.eye - point))));
            if (chosen_light(scene).kind == Light::Kind::spot) {
                const SpotCone cone = spot_cone(chosen_light(scene));
                const double cosine = -glm::dot(to_light, chosen_light(scene).direction);
                made.into_cone = std::clamp((cosine - cone.cos_outer) * cone.scale, 0.0, 1.0);
            }
            made.distance = light.w > 0 ? glm::length(way) : 1;
            made.albedo = 0.05 + 0.95 * ((x * 7919 + y * 104729) % 97) / 97.0;
            nearest = std::min(nearest, made.distance);
        }
    for (Point& point : points.pixels) point.distance /= nearest;
    return points;
}

/// A picture of 8 bits with the light where `classes` says `lit`, and that share of it where it
/// says `partly_lit`.
inline Picture rendered(const Style& style, const Image<Visibility>& classes,
                        const Image<Point>& points, double leaks = 0) {
    Picture picture{classes.width, classes.height, 1, 8, {}};
    for (std::size_t i = 0; i < classes.pixels.size(); ++i) {
        const Point& point = points.pixels[i];
        double sum = classes.pixels[i] == Visibility::background ? 0 : style.ambient;
        if (classes.pixels[i] == Visibility::lit) sum += style.light(point);
        if (classes.pixels[i] == Visibility::partly_lit) sum += leaks * style.light(point);
        if (style.textured) sum *= point.albedo;
        if (point.mesh % 3 == style.painted) sum *= style.paint;
        if (point.mesh % 3 == 2) sum += style.glow;
        const double value = style.encode(std::min(sum, 1.0));
        picture.values.push_back(static_cast<float>(std::round(255 * value) / 255));
    }
    return picture;
}

inline Image<Visibility> with_light_off(const shadowproof::TracedScene& traced) {
    Image<Visibility> classes = traced.truth().visibility;
    for (Visibility& pixel : classes.pixels)
        if (pixel == Visibility::lit) pixel = Visibility::shadowed;
    return classes;
}

struct Read {
    std::size_t wrong = 0;             ///< decided otherwise than the picture was made
    std::size_t decided = 0;           ///< 0: the picture was refused
    std::vector<std::uint8_t> flags{}; ///< of each pixel: 1 where it is decided
};

inline Image<Visibility> with_shadows_off(const shadowproof::TracedScene& traced) {
    Image<Visibility> classes = traced.truth().visibility;
    for (std::size_t i = 0; i < classes.pixels.size(); ++i)
        if (may_be_lit(traced, i)) classes.pixels[i] = Visibility::lit;
    return classes;
}

/// The pictures that a renderer gives.
enum class Given : std::uint8_t { alone, unlit, unshadowed, both };
inline constexpr std::array all_given{Given::alone, Given::unlit, Given::unshadowed, Given::both};

inline const char* words_of(Given given) {
    constexpr std::array words{", alone", ", with its unlit twin", ", with its unshadowed twin",
                               ", with both twins"};
    return words[static_cast<std::size_t>(given)];
}

/// What is read of a picture that was made of `classes`.
inline Read read(const shadowproof::TracedScene& traced, const Picture& picture, const Twins& twins,
                 const Image<Visibility>& classes) {
    Frame frame;
    Read read;
    try {
        frame = read_shadows(traced, {"mine.png", "", "", ""}, picture, twins);
    } catch (const Error&) {
        return read;
    }
    read.flags = frame.pictured->decided.pixels;
    for (std::size_t i = 0; i < classes.pixels.size(); ++i) {
        if (read.flags[i] == 0) continue;
        ++read.decided;
        const bool is_lit = frame.claim.pixels[i] == Visibility::lit;
        read.wrong += is_lit != (classes.pixels[i] == Visibility::lit) ? 1U : 0U;
    }
    return read;
}

/// What is read of `classes`.
inline Read read(const shadowproof::TracedScene& traced, const Style& style,
                 const Image<Point>& points, const Image<Visibility>& classes, Given given,
                 double leaks = 0) {
    Twins twins;
    if (given == Given::unlit || given == Given::both)
        twins.unlit = rendered(style, with_light_off(traced), points);
    if (given == Given::unshadowed || given == Given::both)
        twins.unshadowed = rendered(style, with_shadows_off(traced), points);
    return read(traced, rendered(style, classes, points, leaks), twins, classes);
}

} // namespace shadowproof::tests
