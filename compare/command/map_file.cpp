#include "compare/command/map_file.h"

#include "compare/command/options.h"
#include "compare/output/write_file.h"
#include "scenes/load/picture/encode_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace shadowproof {

namespace {

/// Integers are passed as such: rounding is done here.
template <class T, class Convert>
void write_as(const Image<glm::dvec4>& map, PictureLayout::Format format, PictureLayout::Type type,
              const std::string& file, const Convert& convert) {
    std::vector<T> values;
    values.reserve(4 * map.pixels.size());
    for (const glm::dvec4& texel : map.pixels)
        for (int k = 0; k < 4; ++k) values.push_back(convert(texel[k]));
    const PictureLayout layout{
        format, map.width, map.height, {{"R", type}, {"G", type}, {"B", type}, {"A", type}}};
    write_file(file, encode_picture(layout, values.data(), file));
}

template <class T>
T rounded(double value) {
    constexpr double most = std::numeric_limits<T>::max();
    return static_cast<T>(std::lround(std::clamp(value, 0.0, 1.0) * most));
}

} // namespace

bool is_map_file(const std::string& file) {
    const std::string extension = extension_of(file);
    return extension == ".png" || extension == ".exr";
}

void write_map(const Image<glm::dvec4>& map, int bits, const std::string& file) {
    using Format = PictureLayout::Format;
    using Type = PictureLayout::Type;
    if (extension_of(file) == ".exr")
        return write_as<float>(map, Format::openexr, Type::f32, file,
                               [](double value) { return static_cast<float>(value); });
    if (bits == 16)
        return write_as<std::uint16_t>(map, Format::png, Type::u16, file, rounded<std::uint16_t>);
    write_as<std::uint8_t>(map, Format::png, Type::u8, file, rounded<std::uint8_t>);
}

} // namespace shadowproof
