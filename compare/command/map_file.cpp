#include "compare/command/map_file.h"

#include "compare/command/options.h"
#include "compare/command/picture_bytes.h"
#include "compare/output/write_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace shadowproof {

namespace {

using OIIO::TypeDesc;

OIIO::ImageSpec spec_of(const Image<glm::dvec4>& map, TypeDesc type) {
    OIIO::ImageSpec spec(map.width, map.height, 4, type);
    spec.attribute("oiio:UnassociatedAlpha", 1); // alpha is not coverage
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "    :  :     :  :  "); // unknown: as in truth_exr.cpp
    return spec;
}

/// Integers are passed as such: rounding is done here.
template <class T, class Convert>
void write_as(const Image<glm::dvec4>& map, const char* format, TypeDesc type,
              const std::string& file, const Convert& convert) {
    std::vector<T> values;
    values.reserve(4 * map.pixels.size());
    for (const glm::dvec4& texel : map.pixels)
        for (int k = 0; k < 4; ++k) values.push_back(convert(texel[k]));
    write_file(file, picture_bytes(format, spec_of(map, type), type, values.data(), file));
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
    if (extension_of(file) == ".exr")
        return write_as<float>(map, "openexr", TypeDesc::FLOAT, file,
                               [](double value) { return static_cast<float>(value); });
    if (bits == 16)
        return write_as<std::uint16_t>(map, "png", TypeDesc::UINT16, file, rounded<std::uint16_t>);
    write_as<std::uint8_t>(map, "png", TypeDesc::UINT8, file, rounded<std::uint8_t>);
}

} // namespace shadowproof
