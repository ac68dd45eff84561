#include "tests/claims/filter_claims.h"

#include "compare/color/color_check.h"
#include "raster/render.h"
#include "reference/shade/pixel_means.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "scenes/surface/relief.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowproof::claims {

namespace {

/// Means of what n x n texels show under a light and an eye, three ways.
struct Filtered {
    double averaged_reflections = 0; ///< the truth: mean of all highlights
    double averaged_normals = 0;     ///< highlight of the mean normal, normalised
    double dimmed = 0;               ///< the same times the mean's length (Kilgard's dimFactor)
};

Filtered filtered(const Image<glm::dvec4>& normals, int left, int top, int n,
                  const glm::dvec3& half) {
    const auto highlight = [&](const glm::dvec3& normal) {
        return std::pow(std::max(0.0, glm::dot(half, normal)), 8);
    };
    Filtered sums;
    glm::dvec3 mean(0);
    for (int y = top; y < top + n; ++y)
        for (int x = left; x < left + n; ++x) {
            const glm::dvec3 normal = 2.0 * glm::dvec3(normals.at(x, y)) - 1.0;
            mean += normal;
            sums.averaged_reflections += highlight(normal);
        }
    const double texels = n * n;
    sums.averaged_reflections /= texels;
    sums.averaged_normals = highlight(glm::normalize(mean));
    sums.dimmed = glm::length(mean) / texels * sums.averaged_normals;
    return sums;
}

Section averaging_normals() {
    const Scene scene = load_scene("height_field", {});
    const auto with_heights =
        std::find_if(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.bump == Bump::height_field; });
    const Image<glm::dvec4> normals =
        normal_map_of(slopes_of(scene.textures[with_heights->bump_map], with_heights->bump_scale));
    std::string text =
        "CS448: averaging normals is not averaging reflections, \"still an unsolved problem\"; "
        "Kilgard\n"
        "dims mipmapped normals by their mean's length. Highlights `(H.N')^8` of the relief of\n"
        "`height_field`, over blocks of texels and 64 half-angle vectors up to 60 degrees from "
        "the\n"
        "surface's normal; root mean square differences from the mean of all texels' "
        "highlights:\n\n"
        "| block | highlight of the mean normal | the same, dimmed | mean highlight |\n"
        "|---|---|---|---|\n";
    for (int n = 2; n <= 64; n *= 2) {
        double of_mean = 0;
        double of_dimmed = 0;
        double all = 0;
        double count = 0;
        for (int direction = 0; direction < 64; ++direction) {
            const double turn = 2 * 3.14159265358979324 * (direction % 16) / 16;
            const double lean = 3.14159265358979324 / 3 * (direction / 16 + 0.5) / 4;
            const glm::dvec3 half(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn),
                                  std::cos(lean));
            for (int top = 0; top + n <= normals.height; top += n)
                for (int left = 0; left + n <= normals.width; left += n) {
                    const Filtered block = filtered(normals, left, top, n, half);
                    of_mean += std::pow(block.averaged_normals - block.averaged_reflections, 2);
                    of_dimmed += std::pow(block.dimmed - block.averaged_reflections, 2);
                    all += block.averaged_reflections;
                    ++count;
                }
        }
        text += fmt::format("| {0} x {0} | {1:.4f} | {2:.4f} | {3:.4f} |\n", n,
                            std::sqrt(of_mean / count), std::sqrt(of_dimmed / count), all / count);
    }
    text +=
        "\nIt holds: the larger the block, the further the mean normal's highlight is from what\n"
        "is seen. Dimming mends the brightness, not the shape: the highlight stays as narrow as\n"
        "a smooth surface's.\n";
    return {"Averaging normals is not averaging reflections", text, ""};
}

/// A technique with its lookups.
struct Filter {
    const char* technique;
    int anisotropy = 1;
};

constexpr std::array filters_compared{
    Filter{"bump_tangent_space"}, Filter{"bump_mipmapped"}, Filter{"bump_mipmapped_dimmed"},
    Filter{"bump_toksvig"},       Filter{"bump_lean"},      Filter{"bump_mipmapped", 16},
    Filter{"bump_toksvig", 16},   Filter{"bump_lean", 16}};

/// A row for each bin that has at least a hundred pixels.
std::string table_of(const std::vector<MeanCheck>& checks, std::vector<ErrorBin> MeanCheck::*bins) {
    std::string rows;
    for (std::size_t i = 0; i < (checks[0].*bins).size(); ++i) {
        const ErrorBin& first = (checks[0].*bins)[i];
        if (first.pixels < 100) continue;
        rows += fmt::format("| {:.4g} to {:.4g} | {} |", first.from, first.to, first.pixels);
        for (const MeanCheck& check : checks)
            rows += fmt::format(" {:.1f} |", (check.*bins)[i].rmse);
        rows += '\n';
    }
    return rows;
}

constexpr const char* ending =
    "\nMipmaps remove the noise of bumps that lie between rays, and with one lookup blur what\n"
    "is slanted: the level is that of the longer side. Of a mean normal's highlight nothing is\n"
    "left of the bumps below the pixel; Toksvig's is closest to what they show wherever several\n"
    "lie in a pixel. LEAN's is a Gaussian, which is not the cosine's power even where texels\n"
    "are large, and gains as slopes vary. Dimming changes the diffuse light alone. The largest\n"
    "numbers of texels are those of the boards' narrow sides.\n";

Section what_filters_leave(Gpu& gpu) {
    const Scene scene = load_scene("distant_bumps", {});
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans means = shade_pixels(tracer, truth);
    std::vector<MeanCheck> checks;
    std::string heads = "pixels |";
    std::string under = "---|---|";
    for (const Filter& filter : filters_compared) {
        Plan plan = make_plan(scene);
        plan.asked.lighting.anisotropy = filter.anisotropy;
        const Frame frame = render(*find_technique(filter.technique), scene, plan, gpu);
        checks.push_back(*check_colors(tracer, truth, frame, {}, &means).means);
        heads += fmt::format(" `{}`{} |", filter.technique,
                             filter.anisotropy > 1 ? fmt::format(", {} lookups", filter.anisotropy)
                                                   : "");
        under += "---|";
    }
    std::string whole = fmt::format("| all | {} |", checks[0].alike);
    for (const MeanCheck& check : checks) whole += fmt::format(" {:.1f} |", check.alike_rmse);
    const std::string text = fmt::format(
        "CS448 leaves the filtering of bumps open; Kilgard dims (2001), Toksvig (2005) and Olano\n"
        "and Baker (2010) widen highlights. On `distant_bumps`, how far colours are from the mean\n"
        "of up to {} rays a pixel, root mean square in 1/255 over the pixels all of whose rays\n"
        "meet one mesh, all lit or all shadowed; those means are off by {:.2f} themselves. By how\n"
        "many texels lie along the pixel's longer side, up to ranges of a hundred pixels:\n\n"
        "| texels | {}\n|{}\n{}{}\n"
        "\nBy the angle between eye ray and surface normal, in degrees:\n\n"
        "| angle | {}\n|{}\n{}",
        checks[0].most_rays, checks[0].noise, heads, under, table_of(checks, &MeanCheck::by_texels),
        whole, heads, under, table_of(checks, &MeanCheck::by_angle));
    return {"What filters leave of bumps and their light", text + ending, ""};
}

} // namespace

std::vector<Section> filter_claims() {
    Gpu gpu(GlPlatform::osmesa);
    return {averaging_normals(), what_filters_leave(gpu)};
}

} // namespace shadowproof::claims
