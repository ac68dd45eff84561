#include "scenes/load/picture.h"

#include "scenes/error.h"
#include "scenes/load/file_bytes.h"
#include "scenes/load/picture_head.h"
#include "scenes/load/png_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

using OIIO::TypeDesc;
using Bytes = std::span<const unsigned char>;

const char* const remedy = "export the picture again";

/// Rows from the top, 8-bit ones over 255 by a division in double rounded once. False where the
/// decoder gives up.
bool read_rows(OIIO::ImageInput& input, Picture& picture) {
    const OIIO::ImageSpec spec = input.spec();
    const auto row =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
    picture.values.resize(row * static_cast<std::size_t>(spec.height));
    if (spec.format != TypeDesc::UINT8)
        return input.read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, picture.values.data());
    std::vector<std::uint8_t> stored(row);
    for (int y = 0; y < spec.height; ++y) {
        if (!input.read_scanline(spec.y + y, 0, TypeDesc::UINT8, stored.data())) return false;
        std::transform(stored.begin(), stored.end(),
                       picture.values.begin() + static_cast<std::ptrdiff_t>(row) * y,
                       [](std::uint8_t value) { return static_cast<float>(value / 255.0); });
    }
    return true;
}

/// Decodes with the OpenImageIO reader called `name`.
Picture decode_by(const char* name, Bytes bytes, const std::string& where, const PictureHead& head,
                  const PictureRoom& room) {
    require_room(head.width, head.height, head.channels, head.decoder_bytes, where, room);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // else alpha is multiplied into the colours
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    config.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
    // Each further decoding thread takes memory.
    OIIO::attribute("exr_threads", -1);
    const auto input = OIIO::ImageInput::open(name, &config);
    if (!input) throw Error(where, "is damaged (" + OIIO::geterror() + ")", remedy);
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.depth != 1 || spec.deep || static_cast<std::uint64_t>(spec.width) != head.width ||
        static_cast<std::uint64_t>(spec.height) != head.height ||
        static_cast<std::uint64_t>(spec.nchannels) > head.channels)
        throw Error(where, "is not the picture that its head tells of", remedy);
    Picture picture{
        spec.width, spec.height, spec.nchannels, spec.format == TypeDesc::UINT8 ? 8 : 32, {}};
    if (!read_rows(*input, picture))
        throw Error(where, "is damaged (" + input->geterror() + ")", remedy);
    if (!std::all_of(picture.values.begin(), picture.values.end(),
                     [](float value) { return std::isfinite(value); }))
        throw Error(where, "holds a value that is not finite", "replace it by a number");
    return picture;
}

} // namespace

Picture decode_picture(Bytes bytes, const std::string& where, const PictureRoom& room) {
    const auto format = format_of(bytes);
    if (format == PictureFormat::png) return decode_png(bytes, where, room);
    if (format == PictureFormat::jpeg)
        return decode_by("memory.jpg", bytes, where, jpeg_head(bytes, where), room);
    throw Error(where, "is neither a PNG nor a JPEG picture", remedy);
}

Picture read_picture(const std::filesystem::path& file, const PictureRoom& room) {
    const std::string name = file.string();
    const FileBytes bytes = read_bytes(file, Place(name), room.memory);
    const auto format = format_of(bytes);
    if (!format)
        throw Error(name, "is neither a PNG nor a JPEG nor an OpenEXR picture", "convert it");
    if (format == PictureFormat::openexr)
        return decode_by("memory.exr", bytes, name, openexr_head(bytes, name), room);
    return decode_picture(bytes, name, room);
}

} // namespace shadowproof
