#include "compare/picture/reading/shadow_classes.h"

#include "compare/picture/predict.h"
#include "compare/picture/reading/borrowed_light.h"
#include "compare/picture/reading/light_fit.h"
#include "compare/picture/reading/noise.h"
#include "compare/picture/reading/seen_pixels.h"
#include "compare/picture/surface_colors.h"
#include "scenes/error.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace shadowproof {

namespace {

/// How finely a renderer places vertices, at least (OpenGL 4.5, table 23.54: SUBPIXEL_BITS; Vulkan
/// the same), and browsers without a GPU no finer. Nobody says how finely this one does.
constexpr int least_subpixel_bits = 4;

using LightOf = std::function<ShownLight(const Seen& seen, std::size_t pixel)>;

using LightOfMeshes = std::map<std::uint32_t, std::vector<MeshLight>>;

using PixelsOfMeshes = std::map<std::uint32_t, std::vector<const Observed*>>;

PixelsOfMeshes pixels_by_mesh(const SeenPixels& pixels) {
    PixelsOfMeshes by_mesh;
    for (const std::optional<Seen>& seen : pixels.pixels)
        if (seen) by_mesh[seen->mesh].push_back(&seen->observed);
    return by_mesh;
}

/// Of a picture of its own: a mesh that shows light alone may be lit as another one is.
LightOfMeshes light_of_colors(const SeenPixels& pixels, const Scene& scene, bool blended) {
    LightOfMeshes meshes;
    std::vector<KnownLight> known;
    std::map<std::uint32_t, MeshSamples> unknown;
    for (const auto& [mesh, observed] : pixels_by_mesh(pixels)) {
        const bool textured = scene.meshes[mesh].textured;
        std::vector<MeshLight> fits =
            fitted_light(observed, textured ? Shown::textured : Shown::plain, blended);
        if (!textured && fits.front().shadow && !fits.front().light.empty())
            known.push_back(known_light(fits.front(), observed));
        else if (!textured)
            unknown[mesh] = mesh_samples(observed);
        meshes[mesh] = std::move(fits);
    }
    for (const auto& [mesh, shown] : unknown)
        if (std::vector<MeshLight> fits = borrowed_light(shown, known); !fits.empty())
            meshes[mesh] = std::move(fits);
    return meshes;
}

/// Of differences of two pictures. A mesh that shows no light would be as bright as others are, if
/// light is measured by what surfaces are without it.
LightOfMeshes light_of_differences(const SeenPixels& pixels) {
    const PixelsOfMeshes by_mesh = pixels_by_mesh(pixels);
    LightOfMeshes meshes;
    for (const auto& [mesh, observed] : by_mesh)
        meshes[mesh] = fitted_light(observed, Shown::differences);
    const auto lacks_light = [&](std::uint32_t mesh) {
        return by_mesh.at(mesh).front()->is_ratio && meshes.at(mesh).front().light.empty();
    };
    if (std::none_of(by_mesh.begin(), by_mesh.end(),
                     [&](const auto& each) { return lacks_light(each.first); }))
        return meshes;
    std::vector<const Observed*> all;
    for (const auto& [mesh, observed] : by_mesh)
        if (observed.front()->is_ratio && !lacks_light(mesh))
            all.insert(all.end(), observed.begin(), observed.end());
    const std::vector<MeshLight> common = fitted_light(all, Shown::differences);
    for (auto& [mesh, light] : meshes)
        if (lacks_light(mesh)) light = common;
    return meshes;
}

LightOf by_mask(const Picture& picture) {
    return [&picture](const Seen& /*seen*/, std::size_t pixel) -> ShownLight {
        return {color_at(picture, pixel).g, true};
    };
}

/// Of the picture alone, or by how it differs from one without the light.
LightOf by_light(const Scene& scene, const Picture& picture, const Twins& twins, SeenPixels& pixels,
                 bool blended) {
    const Picture* const twin = twins.unlit ? &*twins.unlit : nullptr;
    observe(picture, twin, step_of(picture, twins), Visibility::shadowed, pixels);
    const LightOfMeshes meshes =
        twin != nullptr ? light_of_differences(pixels) : light_of_colors(pixels, scene, blended);
    return [meshes](const Seen& seen, std::size_t /*pixel*/) {
        return shown_light(meshes.at(seen.mesh), seen.observed);
    };
}

/// Shadows cover few angles: elsewhere light may be as far from typical as at any of these.
void doubt(MeshLight& fit) {
    double least = 1;
    const auto for_all = [&](const auto& change) {
        std::for_each(fit.light.begin(), fit.light.end(), change);
        for (LightByAngle& light : fit.in_highlight)
            std::for_each(light.begin(), light.end(), change);
    };
    for_all([&](const LightAt& at) {
        if (at.typical > 0) least = std::min(least, at.least / at.typical);
    });
    for_all([&](LightAt& at) { at.least = least * at.typical; });
}

/// By what is missing in the picture, which shadows take away as a light adds it.
LightOf by_shadows(const Picture& picture, const Twins& twins, SeenPixels& pixels) {
    observe(*twins.unshadowed, &picture, step_of(picture, twins), Visibility::lit, pixels);
    for (std::optional<Seen>& seen : pixels.pixels)
        if (seen && seen->observed.certainly)
            seen->observed.certainly = seen->observed.certainly == Visibility::lit
                                           ? Visibility::shadowed
                                           : Visibility::lit;
    LightOfMeshes meshes = light_of_differences(pixels);
    for (auto& [mesh, fits] : meshes)
        for (MeshLight& fit : fits) doubt(fit);
    return [meshes](const Seen& seen, std::size_t /*pixel*/) -> ShownLight {
        const ShownLight taken = shown_light(meshes.at(seen.mesh), seen.observed);
        return {1 - taken.share, taken.told};
    };
}

/// What light adds at a pixel is how the twins differ there.
LightOf by_both(const Picture& picture, const Twins& twins, const SeenPixels& pixels) {
    const double noise = least_beyond_noise(picture, twins, pixels);
    return [&picture, &twins, step = step_of(picture, twins),
            noise](const Seen& /*seen*/, std::size_t pixel) -> ShownLight {
        const glm::dvec3 dark = color_at(*twins.unlit, pixel);
        const glm::dvec3 bright = color_at(*twins.unshadowed, pixel);
        const glm::dvec3 light = bright - dark;
        const double own_step =
            picture.bits < 32 ? step : std::max(step, float_step(glm::length(bright)));
        if (!(glm::length(light) > std::max(fewest_steps * own_step, noise))) return {};
        return {glm::dot(color_at(picture, pixel) - dark, light) / glm::dot(light, light), true};
    };
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

/// The same, where the light falls on both.
bool borders_shadow(const TracedScene& traced, const SeenPixels& pixels, int x, int y) {
    const GroundTruth& all = traced.truth();
    const Image<Visibility>& truth = all.visibility;
    if (!in_cone(all, truth.index(x, y))) return false;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.width - 1); ++u)
            if (truth.at(u, v) != truth.at(x, y) && pixels.at(u, v) &&
                pixels.at(u, v)->observed.faces_light && in_cone(all, truth.index(u, v)))
                return true;
    return false;
}

/// Pixels next to outlines, and those of them that lie between light and shadow: in the middle half
/// of the way, where no rounding puts them.
struct AtOutlines {
    std::uint64_t all = 0;
    std::uint64_t between = 0;

    void add(float share) {
        ++all;
        between += share > 0.25F && share < 0.75F ? 1U : 0U;
    }
    /// A straight outline passes two rows of pixels, and half of those it covers by less than a
    /// quarter or more than three.
    bool are_mixed() const { return all > 0 && between * 8 > all; }
};

/// By all outlines of the truth, or by those of shadows alone: twins that are antialiased as well
/// show nothing of others.
bool is_antialiased(const TracedScene& traced, const SeenPixels& pixels,
                    const PicturedShadows& shadows) {
    AtOutlines any;
    AtOutlines of_shadows;
    const Image<Visibility>& truth = traced.truth().visibility;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const float share = shadows.lit_share.at(x, y);
            if ((shadows.decided.at(x, y) == 0 && share == 0) || !borders(truth, x, y)) continue;
            any.add(share);
            if (borders_shadow(traced, pixels, x, y)) of_shadows.add(share);
        }
    return any.are_mixed() || of_shadows.are_mixed();
}

/// `blended`: outlines in the picture show what lies on both sides.
LightOf light_read_from(const Scene& scene, const PictureFiles& files, const Picture& picture,
                        const Twins& twins, SeenPixels& pixels, bool blended) {
    if (!files.mask.empty()) return by_mask(picture);
    if (twins.unlit && twins.unshadowed) return by_both(picture, twins, pixels);
    if (twins.unshadowed) return by_shadows(picture, twins, pixels);
    return by_light(scene, picture, twins, pixels, blended);
}

} // namespace

std::string advice_on_undecidable(const PictureFiles& files) {
    if (!files.unlit.empty() && !files.unshadowed.empty())
        return "the light adds too little to the unlit picture; see that both are of the same "
               "view, one without the light, the other with it but without shadows";
    if (!files.unlit.empty())
        return "the light adds too little to the unlit picture; see that it is of the same view, "
               "without the light alone, and give one with the light but without shadows as well "
               "(--unshadowed)";
    if (!files.unshadowed.empty())
        return "shadows take too little from the picture without them; give one without the light "
               "as well (--unlit)";
    return "give a second picture of the same view without the light (--unlit), or one that is "
           "black where shadowed (--mask)";
}

namespace {

Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const Twins& twins, bool blended) {
    const Image<Visibility>& truth = traced.truth().visibility;
    SeenPixels pixels = seen_pixels(traced);
    const LightOf light_of =
        light_read_from(traced.scene(), files, picture, twins, pixels, blended);

    Frame frame;
    frame.family = "picture";
    frame.claim = truth;
    frame.depth_model.subpixel_bits = least_subpixel_bits;
    PicturedShadows& shadows = frame.pictured.emplace();
    shadows.name = std::filesystem::path(files.picture).stem().string();
    shadows.lit_share = Image<float>(truth.width, truth.height);
    shadows.decided = Image<std::uint8_t>(truth.width, truth.height);
    std::uint64_t decided = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const std::optional<Seen>& seen = pixels.pixels[i];
        if (!seen || !seen->observed.faces_light) continue;
        // Outside a spot's cone no shadow shows, and pictures tell what they are without.
        const bool beyond_light = twins.unshadowed && !in_cone(traced.truth(), i);
        const ShownLight shown = beyond_light && !twins.unlit ? ShownLight{} : light_of(*seen, i);
        shadows.lit_share.pixels[i] = static_cast<float>(shown.share);
        if (!shown.told) {
            shadows.undecidable += beyond_light ? 0 : 1;
            continue;
        }
        ++decided;
        shadows.decided.pixels[i] = 1;
        frame.claim.pixels[i] = shown.share >= 0.5 ? Visibility::lit : Visibility::shadowed;
    }
    if (decided == 0)
        throw Error(files.picture, "does not tell light from shadow at any pixel",
                    advice_on_undecidable(files));
    shadows.antialiased = is_antialiased(traced, pixels, shadows);
    return frame;
}

} // namespace

Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const Twins& twins) {
    if (is_one_color(picture))
        throw Error(files.mask.empty() ? files.picture : files.mask,
                    "is of one colour, and shows no scene", "render it again");
    Frame frame = read_shadows(traced, files, picture, twins, false);
    const bool is_alone = files.mask.empty() && !twins.unlit && !twins.unshadowed;
    if (!is_alone || !frame.pictured->antialiased) return frame;
    frame = read_shadows(traced, files, picture, twins, true);
    frame.pictured->antialiased = true;
    return frame;
}

} // namespace shadowproof
