// What colour is right: lighting by bump maps, pixel by pixel, in double precision at the point
// that the eye ray meets, times the exact visibility. For scenes that are bump-lit (is_bump_lit).
//
// The definition, step by step. All in double, with + - * / and square roots alone (and one cosine
// for each angle of a spot's cone), each rounded by itself; so any processor gives the same bits.
// Where a step divides by a length of zero, it says what holds instead.
//
//  1. Point. D is the direction of the line of sight, a the seen triangle's first corner less the
//     place where that starts (the eye; S where the camera is orthographic), e and f its edges from
//     there to the second and the third corner. The weights of these two are D . (f x a) and
//     D . (a x e), over D . (e x f), each clamped to [0, 1]; the first corner's is 1 less theirs.
//     Q, the point less the eye, is the first corner less the eye plus wb e + wc f, whatever the
//     camera: only D and the start differ. Normals, tangents and texture
//     coordinates are interpolated with the same weights, from the floats that Scene::surfaces
//     holds.
//  2. Frame. N is the interpolated normal, normalised (of length zero: the triangle's own). T is
//     the interpolated tangent less N (N . T), normalised (of length zero: any_tangent(N)).
//     B = w N x T, with the w that the triangle's three corners share.
//  3. Bump. Textures are sampled at level 0, bilinearly, by taps_at and sample (texture.h).
//     Normal map: m = 2 rgb - 1, of the sampled rgb; its x and y times the scale.
//     Height field: m = (-h_s, h_t, 1), the slopes sampled from those at the texels (relief.h).
//     Then m over its length (zero: 0, 0, 1), and N' = m.x T + m.y B + m.z N.
//     Height field in units of space: P_s and P_t are the ways over the triangle from one texel to
//     the next, along a row and down the rows; G = (h_s (P_t x N) + h_t (N x P_s)) / (N . (P_s x
//     P_t)) (texel_sides.h; 0 where that divides by 0), and N' = N - G over its length.
//     No bump map: N' = N.
//  4. Side. Where the eye sees the triangle's back, N and N' change sign (glTF 2.0, section 3.9.4:
//     the normals of back faces are reversed).
//  5. Directions, normalised: V = -D; L to the light, from (l - eye) - Q or, where it is
//     directional, l; H along L + V (zero: H = 0).
//  6. Light. Its colour; times the square of clamp((-L . axis - cos outer) / max(0.001, cos inner -
//     cos outer), 0, 1) for a spot, as KHR_lights_punctual recommends; and, where the scene asks
//     for the inverse square, times its intensity, over the squared distance if it has a place.
//  7. Terms. selfShadow(v) = clamp(8 v . N, 0, 1).
//     diffuse = selfShadow(L) max(0, L . N'), specular = selfShadow(L) max(0, H . N')^8, the power
//     by three squarings: the light's self-shadowing in both. A scene may say otherwise: that of H,
//     of both or of none in the highlight, and another power of two as the exponent.
//  8. Decal: the material's colour times the sampled decal's rgb (without one: the colour alone).
//     Gloss: the sampled decal's alpha where the material says so, else 1.
//  9. Colour = (visibility light diffuse + ambient) decal
//              + visibility light specular gloss specular colour
//              + reflection,
//     visibility 1 where the pixel is lit by trace.h, else 0. Background is black. The colour is
//     linear, and not clamped.
//     Where the lights before the chosen one are added up (lights_before.h), what each of them adds
//     by its own visibility, diffuse and specular, is summed first and added to that.
// 10. Reflection, where the scene has an environment: reflectance gloss environment(R), with
//     R = 2 (N' . V) N' - V in world axes, sampled by cube_map.h at level 0. It is there whether
//     or not the pixel is lit, and knows nothing of the scene's own surfaces. Else 0.
//
// Bump maps after Blinn 1978; tangent frames, self-shadowing terms, gloss and decal after Kilgard
// 2001. Reflection after CS448, lecture 11.
#pragma once

#include "reference/trace/lights_before.h"
#include "reference/trace/trace.h"

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace shadowproof {

/// One point's terms, by the names of the definition.
struct Shading {
    glm::dvec3 normal{0, 0, 0};  ///< N, towards the seen side
    glm::dvec3 tangent{0, 0, 0}; ///< T; 0 without a bump map
    glm::dvec3 bumped{0, 0, 0};  ///< N', likewise
    glm::dvec3 to_light{0, 0, 0};
    glm::dvec3 half{0, 0, 0}; ///< H
    double self_shadow_light = 0;
    double self_shadow_half = 0;
    double diffuse = 0;
    double specular = 0;
    double gloss = 1;
    glm::dvec3 decal{0, 0, 0};
    glm::dvec3 light{0, 0, 0}; ///< without visibility
    bool lit = false;
    glm::dvec3 point{0, 0, 0};            ///< Q, relative to the eye
    glm::dvec3 weights{0, 0, 0};          ///< of the triangle's corners
    double hand = 1;                      ///< w: B = w N x T, of the front
    double side = 1;                      ///< -1 where the eye sees the back
    glm::dvec3 diffuse_color{0, 0, 0};    ///< the colour's summands
    glm::dvec3 specular_color{0, 0, 0};   ///< "
    glm::dvec3 ambient_color{0, 0, 0};    ///< "
    glm::dvec3 reflection_color{0, 0, 0}; ///< "
    glm::dvec3 before_color{0, 0, 0};     ///< ": what the lights before it add, where that is asked

    /// What its light adds to ambient light and reflections.
    glm::dvec3 added_color() const { return diffuse_color + specular_color; }
    glm::dvec3 color() const {
        return diffuse_color + ambient_color + specular_color + reflection_color + before_color;
    }
};

/// Linear colours of all pixels; `truth` is the same tracer's. `before`: the lights whose light is
/// added, here and below. Same bits for any number of threads and any instruction set, likewise.
Image<glm::dvec3> shade(const Tracer& tracer, const GroundTruth& truth,
                        const TracedLights& before = {});

/// The same with all terms; background pixels hold zeros.
Image<Shading> shade_terms(const Tracer& tracer, const GroundTruth& truth,
                           const TracedLights& before = {});

/// What is seen along a line of sight, shaded; nothing where that is background.
std::optional<Shading> shade_ray(const Tracer& tracer, const glm::dvec3& line);

/// What is seen along a line of sight.
struct SeenPoint {
    glm::dvec3 line{0, 0, -1};
    std::uint32_t triangle = no_triangle;
    bool lit = false;
};

/// Shades points of triangles that are known to be seen there. For one thread.
class RayShader {
public:
    explicit RayShader(const Tracer& tracer);
    ~RayShader();
    RayShader(const RayShader&) = delete;
    RayShader& operator=(const RayShader&) = delete;

    /// As many shadings as points, each where the ray meets its triangle's plane; past its edges,
    /// at the nearest weights within.
    void shade(std::span<const SeenPoint> points, std::span<Shading> shadings);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Each pixel as the mean of n x n rays (1 to 32) through the middles of as many equal squares,
/// each with a visibility of its own: what filtering is judged by.
struct Supersampled {
    Image<glm::dvec3> color; ///< background counts as black
    Image<double> coverage;  ///< share of the rays that see a surface
};
Supersampled shade_supersampled(const Tracer& tracer, int n, const TracedLights& before = {});

} // namespace shadowproof
