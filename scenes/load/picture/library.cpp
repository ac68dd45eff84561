// The library that openimageio() loads. It must not need any other part of the house.
#include "scenes/load/picture/openimageio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace shadowproof {

namespace {

using OIIO::TypeDesc;

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

std::string decode(const char* name, std::span<const unsigned char> bytes, const PictureHead& head,
                   Picture& picture) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // else alpha is multiplied into the colours
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    config.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
    // Each further decoding thread takes memory.
    OIIO::attribute("exr_threads", -1);
    const auto input = OIIO::ImageInput::open(name, &config);
    if (!input) return "is damaged (" + OIIO::geterror() + ")";
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.depth != 1 || spec.deep || static_cast<std::uint64_t>(spec.width) != head.width ||
        static_cast<std::uint64_t>(spec.height) != head.height ||
        static_cast<std::uint64_t>(spec.nchannels) > head.channels)
        return "is not the picture that its head tells of";
    picture = {
        spec.width, spec.height, spec.nchannels, spec.format == TypeDesc::UINT8 ? 8 : 32, {}};
    if (!read_rows(*input, picture)) return "is damaged (" + input->geterror() + ")";
    return {};
}

TypeDesc type_of(PictureLayout::Type type) {
    switch (type) {
    case PictureLayout::Type::u8:
        return TypeDesc::UINT8;
    case PictureLayout::Type::u16:
        return TypeDesc::UINT16;
    case PictureLayout::Type::u32:
        return TypeDesc::UINT32;
    case PictureLayout::Type::f32:
        break;
    }
    return TypeDesc::FLOAT;
}

OIIO::ImageSpec spec_of(const PictureLayout& layout) {
    OIIO::ImageSpec spec(layout.width, layout.height, static_cast<int>(layout.channels.size()),
                         type_of(layout.channels.front().type));
    spec.channelnames.clear();
    for (const PictureLayout::Channel& channel : layout.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(type_of(channel.type));
    }
    // Needed only where they differ, and PNG files do not take them.
    if (std::ranges::all_of(spec.channelformats,
                            [&](TypeDesc type) { return type == spec.format; }))
        spec.channelformats.clear();
    spec.attribute("oiio:UnassociatedAlpha", 1); // alpha is not coverage
    spec.attribute("compression", "zip");
    // Otherwise the writer inserts the time of day, and no two files are the same. Blank is how
    // Exif 2.3 (4.6.4) writes an unknown time.
    spec.attribute("DateTime", "    :  :     :  :  ");
    return spec;
}

std::string encode(const PictureLayout& layout, const void* pixels,
                   std::vector<unsigned char>& bytes) {
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool is_exr = layout.format == PictureLayout::Format::openexr;
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(is_exr ? "openexr" : "png");
    // An unknown type means: each channel in its own.
    if (output && output->supports("ioproxy") && output->set_ioproxy(&memory) &&
        output->open("memory", spec_of(layout)) && output->write_image(TypeDesc::UNKNOWN, pixels) &&
        output->close())
        return {};
    return "cannot be written (" + (output ? output->geterror() : OIIO::geterror()) + ")";
}

} // namespace

} // namespace shadowproof

/// See openimageio_entry.
extern "C" __attribute__((visibility("default"))) const shadowproof::OpenImageIo*
shadowproof_openimageio_1() {
    static const shadowproof::OpenImageIo functions{shadowproof::decode, shadowproof::encode};
    return &functions;
}
