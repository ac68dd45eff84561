#include "scenes/picture.h"

#include "scenes/error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace shadowproof {

namespace {

using OIIO::TypeDesc;

const char* const remedy = "export the picture again";

/// By the first bytes; nothing where they are those of neither.
std::optional<std::string> name_for(std::span<const unsigned char> bytes) {
    constexpr std::array<unsigned char, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::array<unsigned char, 3> jpeg{0xff, 0xd8, 0xff};
    const auto begins_with = [&](const auto& magic) {
        return bytes.size() > magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (begins_with(png)) return "memory.png";
    if (begins_with(jpeg)) return "memory.jpg";
    return std::nullopt;
}

/// Values of an integer type over its largest, by a division in double rounded once.
template <class T>
std::optional<std::vector<float>> read_integers(OIIO::ImageInput& input, TypeDesc type,
                                                std::size_t count) {
    std::vector<T> stored(count);
    const int channels = input.spec().nchannels;
    if (!input.read_image(0, 0, 0, channels, type, stored.data())) return std::nullopt;
    std::vector<float> values(count);
    std::transform(stored.begin(), stored.end(), values.begin(), [](T value) {
        return static_cast<float>(value / static_cast<double>(std::numeric_limits<T>::max()));
    });
    return values;
}

std::optional<std::vector<float>> read_values(OIIO::ImageInput& input, std::size_t count) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.format == TypeDesc::UINT8)
        return read_integers<std::uint8_t>(input, TypeDesc::UINT8, count);
    if (spec.format == TypeDesc::UINT16)
        return read_integers<std::uint16_t>(input, TypeDesc::UINT16, count);
    std::vector<float> values(count);
    if (!input.read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, values.data()))
        return std::nullopt;
    return values;
}

Picture read_from(OIIO::ImageInput& input, const std::string& where, std::uint64_t most_pixels) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth != 1 || spec.deep)
        throw Error(where, "is no flat picture", "name one");
    const auto pixels = static_cast<std::uint64_t>(spec.width) * // below 2^62
                        static_cast<std::uint64_t>(spec.height);
    if (pixels * std::max(static_cast<std::uint64_t>(spec.nchannels) / 4, std::uint64_t{1}) >
        most_pixels)
        throw Error(where,
                    fmt::format("is a picture of {}x{} pixels, more than {} altogether", spec.width,
                                spec.height, most_pixels),
                    "scale it down");
    Picture picture{spec.width, spec.height, spec.nchannels, 32, {}};
    if (spec.format == TypeDesc::UINT8) picture.bits = 8;
    if (spec.format == TypeDesc::UINT16) picture.bits = 16;
    auto values = read_values(input, pixels * static_cast<std::uint64_t>(spec.nchannels));
    if (!values) throw Error(where, "is damaged (" + input.geterror() + ")", remedy);
    picture.values = std::move(*values);
    if (!std::all_of(picture.values.begin(), picture.values.end(),
                     [](float value) { return std::isfinite(value); }))
        throw Error(where, "holds a value that is not finite", "replace it by a number");
    return picture;
}

/// As stored: else alpha is multiplied into the colours.
OIIO::ImageSpec as_stored() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

} // namespace

Picture decode_picture(std::span<const unsigned char> bytes, const std::string& where,
                       std::uint64_t most_pixels) {
    const std::optional<std::string> name = name_for(bytes);
    if (!name) throw Error(where, "is neither a PNG nor a JPEG picture", remedy);
    OIIO::ImageSpec config = as_stored();
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    config.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(*name, &config);
    if (!input) throw Error(where, "is damaged (" + OIIO::geterror() + ")", remedy);
    return read_from(*input, where, most_pixels);
}

Picture read_picture(const std::filesystem::path& file, std::uint64_t most_pixels) {
    const OIIO::ImageSpec config = as_stored();
    const auto input = OIIO::ImageInput::open(file.string(), &config);
    if (!input)
        throw Error(file.string(), "cannot be read as a picture (" + OIIO::geterror() + ")",
                    "name a picture that exists, such as a PNG");
    return read_from(*input, file.string(), most_pixels);
}

} // namespace shadowproof
