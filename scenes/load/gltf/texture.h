// Textures of a glTF file: images from a buffer view, a data URI or a file in the asset's folder,
// decoded only where a material uses them.
#pragma once

#include "scenes/load/gltf/file.h"
#include "scenes/load/picture/picture.h"
#include "scenes/load/picture/texels.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace shadowproof::gltf {

/// Fills a scene's textures on demand, each once.
class TextureReader {
public:
    /// `look`: the document's, checked by check_lighting.
    TextureReader(const Document& document, const nlohmann::json& look,
                  std::vector<TextureImage>& textures)
        : document_(document), look_(look), textures_(textures) {}

    /// Index of the texture of that number in the file; `reference` is what names it. Throws Error:
    /// no image, a missing or damaged one, an unknown wrap mode, more texels than limits.texels.
    std::uint32_t read(const Place& reference, std::size_t texture, Encoding encoding);

    /// The same, but decoded again and not added to the scene's textures.
    TextureImage decode(const Place& reference, std::size_t texture, Encoding encoding);

    /// Its alpha alone, and how it is sampled; `least` is not set.
    AlphaMask decode_alpha(const Place& reference, std::size_t texture);

    bool asks_for_nearest() const { return nearest_; } ///< some sampler's magFilter does

private:
    const Document& document_;
    const nlohmann::json& look_;
    std::vector<TextureImage>& textures_;
    std::map<std::pair<std::size_t, Encoding>, std::uint32_t> read_;
    std::uint64_t texels_ = 0;
    bool nearest_ = false;

    void set_sampler(std::size_t sampler, TextureImage& texture);
    Picture picture_of(const Place& reference, std::size_t texture, TextureImage& read,
                       std::uint64_t bytes_of_texel);
};

} // namespace shadowproof::gltf
