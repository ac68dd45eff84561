// Encodes pictures as the bytes of a file, by OpenImageIO; write_file writes them, as all files.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace shadowproof {

/// `format`: OpenImageIO's name, "openexr" or "png". `pixels`: all, without gaps, each of `type`;
/// OIIO::TypeDesc::UNKNOWN: each channel in its own. Throws Error naming `file`.
std::string picture_bytes(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                          const void* pixels, const std::string& file);

} // namespace shadowproof
