// The size of a picture from its first bytes, before any decoder is called: decoders of JPEG and
// OpenEXR allocate, and of progressive JPEG decode, as soon as they open a file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace shadowproof {

enum class PictureFormat : std::uint8_t { png, jpeg, openexr, radiance };

/// The format by the first bytes.
std::optional<PictureFormat> format_of(std::span<const unsigned char> bytes);

/// What a decoder will make of a file.
struct PictureHead {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    std::uint64_t channels = 0;
    /// Bytes that the decoder takes besides the values that it returns, at most.
    std::uint64_t decoder_bytes = 0;
};

/// Of every Error of a picture.
inline const char* const picture_remedy = "export the picture again";

/// Throws Error naming `where`: no such header, or a kind that is not decoded.
/// JPEG (ITU T.81, B.2): progressive ones of up to 100 scans, as each scan covers the whole
/// picture. OpenEXR ("OpenEXR File Layout"): flat, one part, and tiles of up to 4096 per side.
PictureHead jpeg_head(std::span<const unsigned char> bytes, const std::string& where);
/// Radiance (.hdr, "Radiance File Formats"): rows from the top, columns from the left.
PictureHead radiance_head(std::span<const unsigned char> bytes, const std::string& where);
PictureHead openexr_head(std::span<const unsigned char> bytes, const std::string& where);

} // namespace shadowproof
