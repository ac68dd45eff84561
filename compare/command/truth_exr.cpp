#include "compare/command/truth_exr.h"

#include "compare/output/write_file.h"
#include "scenes/load/picture/encode_picture.h"

#include <glm/geometric.hpp>
#include <initializer_list>
#include <string>

namespace shadowproof {

namespace {

/// One pixel as it lies in the buffer: the channels of layout_of, without gaps.
struct Pixel {
    float position[3];
    float normal[3];
    float depth;
    float visibility;
    float exactness;
    std::uint32_t triangle;
};
static_assert(sizeof(Pixel) == 40);

/// The same with lighting.
struct LitPixel {
    Pixel pixel;
    float color[3];
    float diffuse[3];
    float specular[3];
    float ambient[3];
    float reflection[3];
    float albedo[3];
    float bumped[3];
    float tangent[3];
};
static_assert(sizeof(LitPixel) == 40 + 96);

/// Where lights are added up.
struct SumPixel {
    LitPixel lit;
    float before[3];
};
static_assert(sizeof(SumPixel) == sizeof(LitPixel) + 12);

PictureLayout layout_of(const Scene& scene, bool lit) {
    PictureLayout layout{
        .width = scene.camera.width, .height = scene.camera.height, .channels = {}};
    const auto add = [&](std::initializer_list<std::string> names) {
        for (const std::string& name : names) layout.channels.push_back({name});
    };
    add({"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "depth.Z",
         "visibility." + chosen_light(scene).name, "exactness"});
    layout.channels.push_back({"primId", PictureLayout::Type::u32});
    if (!lit) return layout;
    for (const std::string group :
         {"", "diffuse.", "specular.", "ambient.", "reflection.", "Albedo."})
        add({group + "R", group + "G", group + "B"});
    add({"Ns.X", "Ns.Y", "Ns.Z", "T.X", "T.Y", "T.Z"});
    if (added_lights(scene) > 1) add({"before.R", "before.G", "before.B"});
    return layout;
}

/// Unit normal of the side that the eye sees.
glm::dvec3 seen_normal(const Scene& scene, std::uint32_t triangle, const glm::dvec3& direction) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 normal =
        glm::normalize(glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a));
    return glm::dot(normal, direction) > 0 ? -normal : normal;
}

Pixel pixel_of(const Scene& scene, const GroundTruth& truth, int x, int y) {
    Pixel pixel{};
    pixel.triangle = truth.triangle.at(x, y);
    pixel.depth = static_cast<float>(scene.unit * truth.depth.at(x, y));
    pixel.visibility = static_cast<float>(static_cast<double>(truth.visibility.at(x, y)) / 255.0);
    pixel.exactness = static_cast<float>(truth.exactness.at(x, y));
    if (pixel.triangle == no_triangle) return pixel;
    const glm::dvec3 line = line_of_sight(scene.camera, x + 0.5, y + 0.5);
    const glm::dvec3 position = scene.unit * point_on(scene.camera, line, truth.depth.at(x, y));
    const glm::dvec3 normal = seen_normal(scene, pixel.triangle, direction_of(scene.camera, line));
    for (int k = 0; k < 3; ++k) {
        pixel.position[k] = static_cast<float>(position[k]);
        pixel.normal[k] = static_cast<float>(normal[k]);
    }
    return pixel;
}

void put(float* to, const glm::dvec3& from) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

LitPixel lit_pixel(const Pixel& pixel, const Shading& shading) {
    LitPixel lit{};
    lit.pixel = pixel;
    put(lit.color, shading.color());
    put(lit.diffuse, shading.diffuse_color);
    put(lit.specular, shading.specular_color);
    put(lit.ambient, shading.ambient_color);
    put(lit.reflection, shading.reflection_color);
    put(lit.albedo, shading.decal);
    put(lit.bumped, shading.bumped);
    put(lit.tangent, shading.tangent);
    return lit;
}

SumPixel sum_pixel(const Pixel& pixel, const Shading& shading) {
    SumPixel sum{lit_pixel(pixel, shading), {}};
    put(sum.before, shading.before_color);
    return sum;
}

template <class T>
void write_pixels(const PictureLayout& layout, const Image<T>& picture,
                  const std::filesystem::path& file) {
    write_file(file, encode_picture(layout, picture.pixels.data(), file.string()));
}

} // namespace

void write_truth_exr(const Scene& scene, const GroundTruth& truth, const Image<Shading>& shadings,
                     const std::filesystem::path& file) {
    Image<Pixel> picture(truth.visibility.width, truth.visibility.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) picture.at(x, y) = pixel_of(scene, truth, x, y);
    const bool lit = !shadings.pixels.empty();
    if (!lit) return write_pixels(layout_of(scene, lit), picture, file);
    const auto write = [&](auto lit_picture, const auto& pixel) {
        for (std::size_t i = 0; i < picture.pixels.size(); ++i)
            lit_picture.pixels[i] = pixel(picture.pixels[i], shadings.pixels[i]);
        write_pixels(layout_of(scene, lit), lit_picture, file);
    };
    if (added_lights(scene) < 2)
        write(Image<LitPixel>(picture.width, picture.height), lit_pixel);
    else
        write(Image<SumPixel>(picture.width, picture.height), sum_pixel);
}

} // namespace shadowproof
