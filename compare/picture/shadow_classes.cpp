#include "compare/picture/shadow_classes.h"

#include "compare/picture/mesh_light.h"
#include "compare/picture/predict.h"
#include "compare/picture/surface_colors.h"
#include "scenes/camera.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace shadowproof {

namespace {

/// The bits that a picture was made with: 8, where each value of a file of 16 is one of 8.
int bits_of(const Picture& picture) {
    if (picture.bits != 16) return picture.bits;
    // Of 65535 steps each 257th is one of bytes, and others are at least a 257th of those away:
    // half of that is far more than floats round by.
    constexpr float steps = 255;
    constexpr float half_way = 0.5F / 257;
    const bool is_of_bytes =
        std::all_of(picture.values.begin(), picture.values.end(), [](float value) {
            return std::abs(value * steps - std::round(value * steps)) < half_way;
        });
    return is_of_bytes ? 8 : 16;
}

/// What one step of the file's integers in all three channels changes a colour by; 0 of floats.
double step_of(const Picture& picture, const std::optional<Picture>& twin) {
    const int bits = twin ? std::min(bits_of(picture), bits_of(*twin)) : bits_of(picture);
    return bits < 32 ? std::sqrt(3.0) / (std::exp2(bits) - 1) : 0;
}

/// The same of floats, of a brightness: Radiance files have eight bits, which is fewer than others.
double float_step(double brightness) {
    return brightness / 256;
}

/// Pixels from an outline of the truth that soft shadows, and outlines that are a little elsewhere,
/// do not reach.
constexpr int certain_from = 3;

/// A pixel that sees a surface.
struct Seen {
    std::uint32_t mesh = 0;
    Observed observed;
};

std::optional<Seen> seen_at(const TracedScene& traced, int x, int y) {
    const Scene& scene = traced.scene();
    const std::uint32_t triangle = traced.truth().triangle.at(x, y);
    if (triangle == no_triangle) return std::nullopt;
    Seen seen;
    seen.mesh = mesh_of(scene, triangle);
    const glm::dvec3 point = seen_point(traced, x, y);
    const Light& light = chosen_light(scene);
    seen.observed.sine = static_cast<float>(sine_to_light(scene, triangle, point));
    if (light.kind != Light::Kind::directional)
        seen.observed.distance = static_cast<float>(glm::distance(point, light.position));
    seen.observed.faces_light = sides_of(traced.tracer(), triangle).faces_light();
    return seen;
}

using SeenPixels = Image<std::optional<Seen>>;

/// Says of each pixel what it certainly is: where all pixels that near have its class, but those of
/// its mesh that face away from the light.
void find_certain(const Image<Visibility>& truth, SeenPixels& pixels) {
    const auto is_certain = [&](int x, int y) {
        const Seen& own = *pixels.at(x, y);
        for (int v = std::max(y - certain_from, 0);
             v <= std::min(y + certain_from, truth.height - 1); ++v)
            for (int u = std::max(x - certain_from, 0);
                 u <= std::min(x + certain_from, truth.width - 1); ++u) {
                const std::optional<Seen>& other = pixels.at(u, v);
                const bool is_averted =
                    other && other->mesh == own.mesh && !other->observed.faces_light;
                if (truth.at(u, v) != truth.at(x, y) && !is_averted) return false;
            }
        return true;
    };
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            if (pixels.at(x, y) && pixels.at(x, y)->observed.faces_light && is_certain(x, y))
                pixels.at(x, y)->observed.certainly = truth.at(x, y);
}

/// Of each mesh the twin's typical brightness.
std::map<std::uint32_t, double> typical_brightness(const SeenPixels& pixels, const Picture& twin) {
    std::map<std::uint32_t, std::vector<double>> all;
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i)
        if (pixels.pixels[i]) all[pixels.pixels[i]->mesh].push_back(glm::length(color_at(twin, i)));
    std::map<std::uint32_t, double> typical;
    for (auto& [mesh, values] : all) {
        const auto middle = values.begin() + std::ssize(values) / 2;
        std::nth_element(values.begin(), middle, values.end());
        typical[mesh] = *middle;
    }
    return typical;
}

/// What is added to the twin's brightness where the picture's light is measured by it. By sRGB, a
/// value and 0.055 are a power of light, and so is what a surface of any colour makes of light; it
/// is in all three channels. Floats are taken for linear.
double srgb_offset(const Picture& picture) {
    constexpr double of_channel = 0.055;
    return picture.bits < 32 ? of_channel * std::sqrt(3.0) : 0;
}

/// Colours of all pixels. Where a surface shows without the light, what light adds is measured by
/// that, so that surfaces of all colours are alike.
void observe(const Picture& picture, const std::optional<Picture>& twin, SeenPixels& pixels) {
    constexpr double few = 8; // steps
    const double step = step_of(picture, twin);
    const double offset = srgb_offset(picture);
    std::map<std::uint32_t, double> dark;
    if (twin) dark = typical_brightness(pixels, *twin);
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
        if (!pixels.pixels[i]) continue;
        Observed& observed = pixels.pixels[i]->observed;
        observed.value = color_at(picture, i);
        const double own_step =
            picture.bits < 32 ? step : std::max(step, float_step(glm::length(observed.value)));
        observed.step = static_cast<float>(own_step);
        if (!twin) continue;
        observed.value -= color_at(*twin, i);
        const double typical = dark.at(pixels.pixels[i]->mesh);
        if (typical <= few * step) continue;
        // Parts of a texture may be black: as dark as the file tells beside the rest.
        const double own =
            std::max({glm::length(color_at(*twin, i)) + offset, step, float_step(typical)});
        observed.value /= own;
        observed.step = static_cast<float>(own_step / own);
        observed.is_ratio = true;
    }
}

std::map<std::uint32_t, MeshLight> light_by_mesh(const SeenPixels& pixels, bool are_differences) {
    std::map<std::uint32_t, std::vector<const Observed*>> by_mesh;
    for (const std::optional<Seen>& seen : pixels.pixels)
        if (seen) by_mesh[seen->mesh].push_back(&seen->observed);
    std::map<std::uint32_t, MeshLight> meshes;
    for (const auto& [mesh, observed] : by_mesh)
        meshes[mesh] = fitted_light(observed, are_differences);
    // A mesh that the picture shows all in shadow would be as bright as others are, if light is
    // measured by what surfaces are without it.
    const auto lacks_light = [&](std::uint32_t mesh) {
        return by_mesh.at(mesh).front()->is_ratio && meshes.at(mesh).light.empty();
    };
    if (std::none_of(by_mesh.begin(), by_mesh.end(),
                     [&](const auto& each) { return lacks_light(each.first); }))
        return meshes;
    std::vector<const Observed*> all;
    for (const auto& [mesh, observed] : by_mesh)
        if (observed.front()->is_ratio && !lacks_light(mesh))
            all.insert(all.end(), observed.begin(), observed.end());
    const MeshLight common = fitted_light(all, true);
    for (auto& [mesh, light] : meshes)
        if (lacks_light(mesh)) light = common;
    return meshes;
}

/// Where between shadow (0) and light (1) a pixel lies; nothing where they cannot be told apart.
std::optional<double> lit_share(const Observed& observed, const MeshLight& light) {
    const auto there = light.light_at(observed);
    if (!there) return std::nullopt;
    return light.above_shadow(observed.value) / *there;
}

bool is_one_color(const Picture& picture) {
    const glm::dvec3 first = color_at(picture, 0);
    for (std::size_t i = 1;
         i < static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
         ++i)
        if (color_at(picture, i) != first) return false;
    return true;
}

/// Whether some neighbour of the pixel has another class.
bool borders(const Image<Visibility>& truth, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.width - 1); ++u)
            if (truth.at(u, v) != truth.at(x, y)) return true;
    return false;
}

/// Whether most pixels next to an outline of the truth lie between light and shadow: in the middle
/// half of the way, where no rounding puts them.
bool is_antialiased(const TracedScene& traced, const PicturedShadows& shadows) {
    std::uint64_t all = 0;
    std::uint64_t between = 0;
    const Image<Visibility>& truth = traced.truth().visibility;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            if (shadows.decided.at(x, y) == 0 || !borders(truth, x, y)) continue;
            const float share = shadows.lit_share.at(x, y);
            ++all;
            between += share > 0.25F && share < 0.75F ? 1U : 0U;
        }
    // A straight outline passes two rows of pixels, and half of those it covers by less than a
    // quarter or more than three.
    return all > 0 && between * 8 > all;
}

} // namespace

std::string advice_on_undecidable(bool with_twin) {
    if (with_twin)
        return "the light adds too little to the unlit picture; see that it is of the same view, "
               "without the light alone";
    return "give a second picture of the same view without the light (--unlit), or one that is "
           "black where shadowed (--mask)";
}

Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const std::optional<Picture>& twin) {
    const bool is_mask = !files.mask.empty();
    if (is_one_color(picture))
        throw Error(is_mask ? files.mask : files.picture, "is of one colour, and shows no scene",
                    "render it again");
    const Image<Visibility>& truth = traced.truth().visibility;
    SeenPixels pixels(truth.width, truth.height);
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) pixels.at(x, y) = seen_at(traced, x, y);
    find_certain(truth, pixels);
    std::map<std::uint32_t, MeshLight> meshes;
    if (!is_mask) {
        observe(picture, twin, pixels);
        meshes = light_by_mesh(pixels, twin.has_value());
    }

    Frame frame;
    frame.family = "picture";
    frame.claim = truth;
    PicturedShadows& shadows = frame.pictured.emplace();
    shadows.name = std::filesystem::path(files.picture).stem().string();
    shadows.lit_share = Image<float>(truth.width, truth.height);
    shadows.decided = Image<std::uint8_t>(truth.width, truth.height);
    std::uint64_t decided = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const std::optional<Seen>& seen = pixels.at(x, y);
            if (!seen || !seen->observed.faces_light) continue;
            std::optional<double> share;
            if (is_mask)
                share = color_at(picture, truth.index(x, y)).g;
            else
                share = lit_share(seen->observed, meshes.at(seen->mesh));
            if (!share) {
                ++shadows.undecidable;
                continue;
            }
            ++decided;
            shadows.decided.at(x, y) = 1;
            shadows.lit_share.at(x, y) = static_cast<float>(*share);
            frame.claim.at(x, y) = *share >= 0.5 ? Visibility::lit : Visibility::shadowed;
        }
    if (decided == 0)
        throw Error(files.picture, "does not tell light from shadow at any pixel",
                    advice_on_undecidable(twin.has_value()));
    shadows.antialiased = is_antialiased(traced, shadows);
    return frame;
}

} // namespace shadowproof
