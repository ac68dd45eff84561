#include "scenes/load/gltf/mask.h"

#include "scenes/load/gltf/check.h"
#include "scenes/load/gltf/texture.h"
#include "scenes/load/gltf/texture_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace shadowproof::gltf {

namespace {

using nlohmann::json;

bool is_masked(const Document& document, std::size_t material) {
    return document.model.materials[material].alphaMode == "MASK";
}

/// One material being read.
struct MaskSource {
    const Document& document;
    const json& look;
    const json& value;
    Place place;
    const std::string& name;

    double cutoff() const {
        const double given = value.value("alphaCutoff", 0.5);
        if (!(given >= 0)) (place / "alphaCutoff").refuse("is negative", "write 0 or more");
        return given;
    }
    /// The alpha of the material's own colour.
    double own_alpha() const {
        const json& color = find(value, {"pbrMetallicRoughness", "baseColorFactor"});
        const double alpha = color.is_null() ? 1 : color[3].get<double>();
        if (alpha < 0)
            (place / "pbrMetallicRoughness" / "baseColorFactor" / 3)
                .refuse("is negative", "write 0 to 1");
        return alpha;
    }
    const json& texture() const {
        return find(value, {"pbrMetallicRoughness", "baseColorTexture"});
    }
    Place texture_place() const { return place / "pbrMetallicRoughness" / "baseColorTexture"; }
};

/// Decodes each texture once, and keeps one mask for all materials that read it alike.
class MaskReader {
public:
    MaskReader(const Document& document, const json& look, std::vector<AlphaMask>& masks)
        : document_(document), textures_(document, look, none_), masks_(masks) {}

    AlphaMask& decoded(const MaskSource& source) {
        const std::size_t texture = source.texture()["index"];
        const auto known = decoded_.find(texture);
        if (known != decoded_.end()) return known->second;
        return decoded_
            .emplace(texture, textures_.decode_alpha(source.texture_place() / "index", texture))
            .first->second;
    }
    /// Index of the mask; `alpha`: as decoded, with its `least`.
    std::uint32_t kept(const AlphaMask& alpha) {
        const auto found = std::ranges::find_if(masks_, [&](const AlphaMask& mask) {
            return mask.name == alpha.name && mask.least == alpha.least;
        });
        if (found != masks_.end()) return static_cast<std::uint32_t>(found - masks_.begin());
        document_.memory->keep({alpha.alpha.pixels.size() * sizeof(float),
                                document_.root().where() + alpha.name, "its alpha",
                                "give its materials one alphaCutoff"});
        masks_.push_back(alpha);
        return static_cast<std::uint32_t>(masks_.size() - 1);
    }

private:
    const Document& document_;
    std::vector<TextureImage> none_;
    TextureReader textures_;
    std::vector<AlphaMask>& masks_;
    std::map<std::size_t, AlphaMask> decoded_; ///< by texture
};

/// What is left of a material's surface.
enum class Left : std::uint8_t { all, some, nothing };

/// Alpha is nowhere beyond its texels'.
Left what_is_left(const AlphaMask& mask) {
    const auto [least, most] = std::ranges::minmax(mask.alpha.pixels);
    if (double{least} >= mask.least) return Left::all;
    return double{most} < mask.least ? Left::nothing : Left::some;
}

/// `mask`: set where something is left, and something is left out.
Left read_mask(const MaskSource& source, MaskReader& reader, Scene& scene, std::uint32_t& mask) {
    const double cutoff = source.cutoff();
    const double own = source.own_alpha();
    if (cutoff <= 0) return Left::all;
    if (own == 0) return Left::nothing;
    if (source.texture().is_null()) return own >= cutoff ? Left::all : Left::nothing;
    if (is_unread(source.look, source.texture()["index"])) {
        scene.notes.push_back(fmt::format("{} \"{}\": alphaMode MASK is drawn as opaque, for {} is "
                                          "in a format that is not read",
                                          source.place.pointer(), source.name,
                                          source.texture_place().pointer()));
        return Left::all;
    }
    AlphaMask& alpha = reader.decoded(source);
    alpha.least = cutoff / own;
    const Left left = what_is_left(alpha);
    if (left == Left::some) mask = reader.kept(alpha);
    return left;
}

void note_blending(const Document& document, const std::vector<bool>& used, Scene& scene) {
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string& mode = document.model.materials[i].alphaMode;
        if (used[i] && mode != "OPAQUE" && mode != "MASK")
            scene.notes.push_back(fmt::format("{} \"{}\": alphaMode {} is drawn as opaque",
                                              (document.root() / "materials" / i).pointer(),
                                              scene.materials[i].name, mode));
    }
}

} // namespace

void read_masks(const Document& document, const std::vector<bool>& used, Materials& materials,
                Scene& scene) {
    materials.left_out.assign(scene.materials.size(), false);
    note_blending(document, used, scene);
    bool some = false;
    for (std::size_t i = 0; i < used.size(); ++i)
        some = some || (used[i] && is_masked(document, i));
    if (!some) return;
    json look = document.look;
    check_lighting(document.root(), look);
    MaskReader reader(document, look, scene.masks);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i] || !is_masked(document, i)) continue;
        const Place place = document.root() / "materials" / i;
        const MaskSource source{document, look, look["materials"][i], place,
                                scene.materials[i].name};
        switch (read_mask(source, reader, scene, scene.materials[i].mask)) {
        case Left::all:
            break;
        case Left::some:
            materials.sets[i].mask = read_coordinates(source.texture());
            break;
        case Left::nothing:
            materials.left_out[i] = true;
            scene.notes.push_back(fmt::format("{} \"{}\": its alpha mask leaves nothing of it",
                                              place.pointer(), source.name));
            break;
        }
    }
}

} // namespace shadowproof::gltf
