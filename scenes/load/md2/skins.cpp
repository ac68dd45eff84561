#include "scenes/load/md2/skins.h"

#include "scenes/error.h"
#include "scenes/limits.h"
#include "scenes/load/common/file_bytes.h"
#include "scenes/load/picture/pcx.h"
#include "scenes/load/picture/texels.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace shadowproof::md2 {

namespace {

constexpr double height_of_white = 8; // texels

/// "models/imp/skin.pcx" to "skin"; never empty, and never a path into another folder.
std::string stem_of(const Model& model, const std::filesystem::path& file) {
    const std::string name = model.skin.substr(model.skin.find_last_of("/\\") + 1);
    const std::string stem = name.substr(0, name.find_last_of('.'));
    return stem.empty() ? file.stem().string() : stem;
}

/// Reads pictures beside a model.
class Wardrobe {
public:
    Wardrobe(MemoryAccount& memory, Scene& scene) : memory_(memory), scene_(scene) {}

    bool has(const std::string& name) const {
        std::error_code failure;
        return std::filesystem::exists(beside(name), failure);
    }
    /// Index of the new texture.
    std::uint32_t texture(const std::string& name, Encoding encoding) {
        const Picture picture = read(name);
        memory_.keep(need_of(name, picture));
        return add({.name = beside(name).string(),
                    .texels = texels_of(picture, encoding),
                    .bits = picture.bits});
    }
    /// Makes a picture's gray, or its red, the alpha of a texture of its size, or of a white one
    /// where there is none. Its index.
    std::uint32_t with_alpha(std::uint32_t texture, const std::string& name) {
        const Picture picture = read(name);
        if (texture == no_texture) {
            memory_.keep(need_of(name, picture));
            texture = add({.name = "white",
                           .texels = Image<glm::vec4>(picture.width, picture.height, glm::vec4(1)),
                           .bits = 8});
        }
        Image<glm::vec4>& texels = scene_.textures[texture].texels;
        if (picture.width != texels.width || picture.height != texels.height)
            throw Error(beside(name).string(),
                        fmt::format("is of {}x{} pixels, and {} of {}x{}", picture.width,
                                    picture.height, scene_.textures[texture].name, texels.width,
                                    texels.height),
                        "scale one to the other's size");
        const auto channels = static_cast<std::size_t>(picture.channels);
        for (std::size_t i = 0; i < texels.pixels.size(); ++i)
            texels.pixels[i].a = picture.values[channels * i];
        return texture;
    }

private:
    MemoryAccount& memory_;
    Scene& scene_;

    std::filesystem::path beside(const std::string& name) const {
        return scene_.file.parent_path() / name;
    }
    std::uint32_t add(TextureImage image) {
        scene_.textures.push_back(std::move(image));
        return static_cast<std::uint32_t>(scene_.textures.size() - 1);
    }
    MemoryNeed need_of(const std::string& name, const Picture& picture) const {
        return {sizeof(glm::vec4) * static_cast<std::uint64_t>(picture.width) *
                    static_cast<std::uint64_t>(picture.height),
                beside(name).string(), "its texels", "scale it down"};
    }
    /// With room for its texels.
    Picture read(const std::string& file) {
        const std::string name = beside(file).string();
        std::uint64_t texels = 0;
        for (const TextureImage& texture : scene_.textures) texels += texture.texels.pixels.size();
        const FileBytes bytes = read_bytes(beside(file), Place(name), memory_);
        const MemoryHold held = memory_.hold({bytes.size(), name, "its bytes", "scale it down"});
        const PictureRoom room{.memory = memory_,
                               .most_pixels = limits.texels - texels,
                               .bytes_made_of_pixel = sizeof(glm::vec4)};
        return file.ends_with(".pcx") ? decode_pcx(bytes, name, room)
                                      : decode_picture(bytes, name, room);
    }
};

} // namespace

void dress(const Model& model, MemoryAccount& memory, Scene& scene) {
    const std::string stem = stem_of(model, scene.file);
    const std::string normals = stem + "_normal.png";
    const std::string heights = stem + "_height.png";
    const std::string decal = stem + ".png";
    const std::string own_skin = stem + ".pcx";
    const std::string gloss = stem + "_gloss.png";
    Wardrobe wardrobe(memory, scene);
    Material material{.name = stem};
    const bool has_normals = wardrobe.has(normals);
    if (!has_normals && !wardrobe.has(heights)) {
        scene.notes.push_back(fmt::format(
            "no {} and no {} beside the model: colours are not judged", normals, heights));
        scene.materials.push_back(material);
        return;
    }
    std::vector<std::string> worn{has_normals ? normals : heights};
    material.bump_map = wardrobe.texture(worn.front(), Encoding::plain);
    material.bump = has_normals ? Bump::normal_map : Bump::height_field;
    material.bump_scale = has_normals ? 1 : height_of_white;
    material.specular = glm::dvec3(0.25);
    scene.ambient = glm::dvec3(0.125);
    std::string but;
    if (wardrobe.has(decal)) {
        worn.push_back(decal);
    } else if (wardrobe.has(own_skin)) {
        worn.push_back(own_skin);
        but = fmt::format("; skins of the game mostly have light painted in, which is lit again: "
                          "take it out, and keep the rest as {}",
                          decal);
    } else {
        but = fmt::format("; no {} and no {} beside the model, so its colour is white", decal,
                          own_skin);
    }
    if (worn.size() > 1) material.decal = wardrobe.texture(worn.back(), Encoding::srgb);
    if (wardrobe.has(gloss)) {
        material.decal = wardrobe.with_alpha(material.decal, gloss);
        material.gloss_in_alpha = true;
        worn.push_back(gloss);
    }
    scene.notes.push_back(fmt::format("wears {}{}", fmt::join(worn, ", "), but));
    scene.materials.push_back(material);
}

} // namespace shadowproof::md2
