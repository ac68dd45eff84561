#include "scenes/load/picture/picture.h"

#include "scenes/error.h"
#include "scenes/load/common/file_bytes.h"
#include "scenes/load/picture/openimageio.h"
#include "scenes/load/picture/picture_head.h"
#include "scenes/load/picture/png_picture.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

using Bytes = std::span<const unsigned char>;

/// Decodes with the OpenImageIO reader of files called `name`.
Picture decode_by(const char* name, Bytes bytes, const std::string& where, const PictureHead& head,
                  const PictureRoom& room) {
    require_room(head.width, head.height, head.channels, head.decoder_bytes, where, room);
    Picture picture;
    const std::string wrong = openimageio().decode(name, bytes, head, picture);
    if (!wrong.empty()) throw Error(where, wrong, picture_remedy);
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
    throw Error(where, "is neither a PNG nor a JPEG picture", picture_remedy);
}

Picture read_picture(const std::filesystem::path& file, const PictureRoom& room) {
    const std::string name = file.string();
    const FileBytes bytes = read_bytes(file, Place(name), room.memory);
    const auto format = format_of(bytes);
    if (!format)
        throw Error(name, "is neither a PNG nor a JPEG nor an OpenEXR nor a Radiance picture",
                    "convert it");
    if (format == PictureFormat::radiance)
        return decode_by("memory.hdr", bytes, name, radiance_head(bytes, name), room);
    if (format == PictureFormat::openexr)
        return decode_by("memory.exr", bytes, name, openexr_head(bytes, name), room);
    return decode_picture(bytes, name, room);
}

} // namespace shadowproof
