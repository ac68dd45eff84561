#include "compare/picture/shadow_classes.h"

#include "compare/picture/surface_colors.h"
#include "scenes/camera.h"
#include "scenes/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace shadowproof {

namespace {

/// The picture's value at a pixel, less the twin's where there is one.
class Values {
public:
    Values(const Picture& picture, const std::optional<Picture>& twin)
        : picture_(picture), twin_(twin) {}
    glm::dvec3 at(std::size_t pixel) const {
        const glm::dvec3 color = color_at(picture_, pixel);
        return twin_ ? color - color_at(*twin_, pixel) : color;
    }
    /// One step of the file's integers; 0 of floats.
    double step() const {
        const int bits = twin_ ? std::min(picture_.bits, twin_->bits) : picture_.bits;
        return bits < 32 ? 1 / (std::exp2(bits) - 1) : 0;
    }

private:
    const Picture& picture_;
    const std::optional<Picture>& twin_;
};

/// Of many colours the median, channel by channel, and the median distance from it.
struct Typical {
    glm::dvec3 color{0, 0, 0};
    double scatter = 0;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::optional<Typical> typical(const std::vector<glm::dvec3>& colors) {
    if (colors.empty()) return std::nullopt;
    Typical found;
    std::vector<double> values(colors.size());
    for (int k = 0; k < 3; ++k) {
        std::transform(colors.begin(), colors.end(), values.begin(),
                       [&](const glm::dvec3& color) { return color[k]; });
        found.color[k] = median(values);
    }
    std::transform(colors.begin(), colors.end(), values.begin(),
                   [&](const glm::dvec3& color) { return glm::distance(color, found.color); });
    found.scatter = median(values);
    return found;
}

/// The colours of one group of angles, and their sines.
struct AngleColors {
    std::vector<glm::dvec3> colors;
    std::vector<double> sines;
};

/// What light adds to shadow, at the sine of one angle.
struct LightAt {
    double sine = 0;
    glm::dvec3 added{0, 0, 0};
};

/// What is known of one mesh's colours.
struct MeshColors {
    std::vector<glm::dvec3> averted; ///< of surfaces that face away from the light
    std::array<AngleColors, angle_groups> facing;
    std::optional<Typical> shadow;
    std::vector<LightAt> light; ///< by growing sines
};

/// Where the surface at a pixel belongs.
struct Place {
    std::uint32_t mesh = 0;
    int group = 0;
    double sine = 0;
    bool faces_light = false;
};

/// Of each pixel that sees a surface.
std::optional<Place> place_of(const TracedScene& traced, int x, int y) {
    const Scene& scene = traced.scene();
    const std::uint32_t triangle = traced.truth().triangle.at(x, y);
    if (triangle == no_triangle) return std::nullopt;
    const glm::dvec3 direction = ray_direction(scene.camera, x + 0.5, y + 0.5);
    const glm::dvec3 point = scene.camera.eye + traced.truth().depth.at(x, y) * direction;
    Place place;
    place.mesh = mesh_of(scene, triangle);
    place.group = angle_group(scene, triangle, point);
    place.sine = sine_to_light(scene, triangle, point);
    place.faces_light = sides_of(traced.tracer(), triangle).faces_light();
    return place;
}

double brightness(const glm::dvec3& color) {
    return color.x + color.y + color.z;
}

/// The darker of two groups into which colours fall by their brightness (2-means); nothing where
/// they are one. Of colours that are spread evenly, the groups' means lie twice as far apart as the
/// colours of both lie from their medians; groups that are two lie twice as far again.
std::optional<Typical> darker_group(const std::vector<glm::dvec3>& colors) {
    if (colors.size() < 2) return std::nullopt;
    const auto [least, greatest] =
        std::minmax_element(colors.begin(), colors.end(), [](const auto& a, const auto& b) {
            return brightness(a) < brightness(b);
        });
    double between = 0.5 * (brightness(*least) + brightness(*greatest));
    std::vector<glm::dvec3> dark;
    std::vector<glm::dvec3> bright;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        dark.clear();
        bright.clear();
        for (const glm::dvec3& color : colors)
            (brightness(color) < between ? dark : bright).push_back(color);
        if (dark.empty() || bright.empty()) return std::nullopt;
        const auto mean = [](const std::vector<glm::dvec3>& group) {
            double sum = 0;
            for (const glm::dvec3& color : group) sum += brightness(color);
            return sum / static_cast<double>(group.size());
        };
        between = 0.5 * (mean(dark) + mean(bright));
    }
    const Typical low = *typical(dark);
    const Typical high = *typical(bright);
    if (glm::distance(low.color, high.color) <= 4 * (low.scatter + high.scatter))
        return std::nullopt;
    return low;
}

/// What tells light from shadow, at least: two steps of the file's integers, and four times what
/// shadows scatter.
double least_difference(const Typical& shadow, double step) {
    return 2 * step + 4 * shadow.scatter;
}

/// Light is what is brighter than shadow, angle by angle.
void find_light(MeshColors& mesh, double step) {
    const Typical& shadow = *mesh.shadow;
    for (const AngleColors& group : mesh.facing) {
        std::vector<glm::dvec3> bright;
        std::vector<double> sines;
        for (std::size_t i = 0; i < group.colors.size(); ++i) {
            const glm::dvec3& color = group.colors[i];
            if (brightness(color) <= brightness(shadow.color) ||
                glm::distance(color, shadow.color) <= least_difference(shadow, step))
                continue;
            bright.push_back(color);
            sines.push_back(group.sines[i]);
        }
        if (!bright.empty())
            mesh.light.push_back({median(sines), typical(bright)->color - shadow.color});
    }
}

/// What light adds at an angle: between those that are known it grows evenly, and from nothing
/// where it only grazes. A group's pixels may be many times as far from grazing as another of them.
std::optional<glm::dvec3> light_at(const std::vector<LightAt>& light, double sine) {
    if (light.empty() || std::isnan(sine)) return std::nullopt;
    LightAt below;
    for (const LightAt& above : light) {
        if (sine < above.sine)
            return glm::mix(below.added, above.added,
                            (sine - below.sine) / (above.sine - below.sine));
        below = above;
    }
    return below.added;
}

/// `with_twin`: the values are differences from a picture without light, and shadow is none.
std::map<std::uint32_t, MeshColors> colors_by_mesh(const Image<std::optional<Place>>& places,
                                                   const Values& values, bool with_twin) {
    std::map<std::uint32_t, MeshColors> meshes;
    for (std::size_t i = 0; i < places.pixels.size(); ++i) {
        const std::optional<Place>& place = places.pixels[i];
        if (!place) continue;
        MeshColors& mesh = meshes[place->mesh];
        if (place->faces_light) {
            AngleColors& group = mesh.facing[static_cast<std::size_t>(place->group)];
            group.colors.push_back(values.at(i));
            group.sines.push_back(place->sine);
        } else {
            mesh.averted.push_back(values.at(i));
        }
    }
    for (auto& [number, mesh] : meshes) {
        constexpr std::size_t enough = 16; // not a few pixels of an outline
        if (with_twin) {
            mesh.shadow = Typical{};
        } else if (mesh.averted.size() >= enough) {
            mesh.shadow = typical(mesh.averted);
        } else {
            std::vector<glm::dvec3> all;
            for (const AngleColors& group : mesh.facing)
                all.insert(all.end(), group.colors.begin(), group.colors.end());
            mesh.shadow = darker_group(all);
        }
        if (mesh.shadow) find_light(mesh, values.step());
    }
    return meshes;
}

/// Where between shadow (0) and light (1) a value lies; nothing where they cannot be told apart.
std::optional<double> share_of(const glm::dvec3& value, const MeshColors& mesh, double sine,
                               double step) {
    if (!mesh.shadow) return std::nullopt;
    const std::optional<glm::dvec3> way = light_at(mesh.light, sine);
    if (!way || glm::length(*way) <= least_difference(*mesh.shadow, step)) return std::nullopt;
    return glm::dot(value - mesh.shadow->color, *way) / glm::dot(*way, *way);
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

Frame read_shadows(const TracedScene& traced, const PictureFiles& files, const Picture& picture,
                   const std::optional<Picture>& twin) {
    const bool is_mask = !files.mask.empty();
    if (is_one_color(picture))
        throw Error(is_mask ? files.mask : files.picture, "is of one colour, and shows no scene",
                    "render it again");
    const Values values(picture, twin);
    const GroundTruth& truth = traced.truth();
    const int width = truth.visibility.width;
    const int height = truth.visibility.height;
    Image<std::optional<Place>> places(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) places.at(x, y) = place_of(traced, x, y);
    std::map<std::uint32_t, MeshColors> meshes;
    if (!is_mask) meshes = colors_by_mesh(places, values, twin.has_value());

    Frame frame;
    frame.family = "picture";
    frame.claim = truth.visibility;
    PicturedShadows& shadows = frame.pictured.emplace();
    shadows.name = std::filesystem::path(files.picture).stem().string();
    shadows.lit_share = Image<float>(width, height);
    shadows.decided = Image<std::uint8_t>(width, height);
    std::uint64_t decided = 0;
    for (std::size_t i = 0; i < places.pixels.size(); ++i) {
        const std::optional<Place>& place = places.pixels[i];
        if (!place || !place->faces_light) continue;
        std::optional<double> share;
        if (is_mask) {
            share = values.at(i).g;
        } else {
            const MeshColors& mesh = meshes.at(place->mesh);
            share = share_of(values.at(i), mesh, place->sine, values.step());
        }
        if (!share) {
            ++shadows.undecidable;
            continue;
        }
        ++decided;
        shadows.decided.pixels[i] = 1;
        shadows.lit_share.pixels[i] = static_cast<float>(*share);
        frame.claim.pixels[i] = *share >= 0.5 ? Visibility::lit : Visibility::shadowed;
    }
    if (decided == 0)
        throw Error(files.picture, "does not tell light from shadow at any pixel",
                    "give a second picture of the same view without the light (--unlit), or one "
                    "that is black where shadowed (--mask)");
    shadows.antialiased = is_antialiased(traced, shadows);
    return frame;
}

} // namespace shadowproof
