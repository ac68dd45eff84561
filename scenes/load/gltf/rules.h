// The rules of glTF 2.0 and of the evaluated extensions for a file's JSON, value by value, for
// everything that is read. check.cpp checks files against them.
#pragma once

#include "scenes/limits.h"
#include "scenes/scene.h"

#include <array>
#include <cstdint>

namespace shadowproof::gltf {

enum class Kind : std::uint8_t {
    text,
    boolean,
    number,
    positive,       ///< a number above 0
    numbers,        ///< an array of `most` numbers
    whole,          ///< an integer from `least` to `most`
    index,          ///< into `array`
    component_type, ///< those that tinygltf::GetComponentSizeInBytes knows, except any that glTF
                    ///< does not have
    accessor_type,
};

/// What the values at `path` are. In a path, * stands for every element of an array and {} for
/// every member of an object; "name!" must be there, "name?" counts only where it is an object.
struct Rule {
    const char* path;
    Kind kind = Kind::text;
    std::uint64_t least = 0;
    std::uint64_t most = 0;
    const char* array = "";
};

constexpr Rule index(const char* path, const char* array) {
    return {path, Kind::index, 0, 0xffffffffU, array};
}
constexpr Rule whole(const char* path, std::uint64_t least, std::uint64_t most) {
    return {path, Kind::whole, least, most, ""};
}
constexpr Rule numbers(const char* path, std::uint64_t count) {
    return {path, Kind::numbers, count, count, ""};
}

/// Checked first, as another version or an extension may break the other rules.
inline constexpr std::array rules_of_the_head{
    Rule{"asset!/version!"},
    Rule{"extensionsUsed/*"},
    Rule{"extensionsRequired/*"},
};

inline constexpr std::array rules{
    Rule{"extras?/shadowproof/provokes/*"},
    Rule{"extras?/shadowproof/provokesWide/*"},
    index("scene", "/scenes"),
    index("scenes/*/nodes/*", "/nodes"),
    Rule{"nodes/*/name"},
    Rule{"nodes/*/extras?/shadowproof/casts", Kind::boolean},
    Rule{"nodes/*/extras?/shadowproof/receives", Kind::boolean},
    index("nodes/*/mesh", "/meshes"),
    index("nodes/*/skin", "/skins"),
    index("nodes/*/camera", "/cameras"),
    index("nodes/*/children/*", "/nodes"),
    numbers("nodes/*/matrix", 16),
    numbers("nodes/*/translation", 3),
    numbers("nodes/*/rotation", 4),
    numbers("nodes/*/scale", 3),
    Rule{"nodes/*/weights/*", Kind::number},
    index("nodes/*/extensions/EXT_mesh_gpu_instancing/attributes!/{}", "/accessors"),
    Rule{"nodes/*/extensions/KHR_node_visibility/visible", Kind::boolean},
    index("nodes/*/extensions/KHR_lights_punctual/light!",
          "/extensions/KHR_lights_punctual/lights"),
    Rule{"extensions/KHR_lights_punctual/lights/*/name"},
    Rule{"extensions/KHR_lights_punctual/lights/*/type!"},
    numbers("extensions/KHR_lights_punctual/lights/*/color", 3),
    Rule{"extensions/KHR_lights_punctual/lights/*/intensity", Kind::number},
    Rule{"extensions/KHR_lights_punctual/lights/*/range", Kind::positive},
    Rule{"extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Kind::number},
    Rule{"extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Kind::number},
    Rule{"cameras/*/name"},
    Rule{"cameras/*/type!"},
    Rule{"cameras/*/perspective/yfov!", Kind::number},
    Rule{"cameras/*/perspective/aspectRatio", Kind::positive}, // tinygltf uses 0 for none
    Rule{"cameras/*/perspective/znear!", Kind::positive},
    Rule{"cameras/*/perspective/zfar", Kind::positive}, // tinygltf uses 0 for none
    Rule{"cameras/*/orthographic/xmag!", Kind::number},
    Rule{"cameras/*/orthographic/ymag!", Kind::number},
    Rule{"cameras/*/orthographic/znear!", Kind::number},
    Rule{"cameras/*/orthographic/zfar!", Kind::positive},
    Rule{"materials/*/name"},
    Rule{"materials/*/alphaMode"},
    Rule{"materials/*/alphaCutoff", Kind::number},
    Rule{"materials/*/doubleSided", Kind::boolean},
    whole("materials/*/normalTexture/index", 0, 0x7fffffff),
    Rule{"meshes/*/name"},
    Rule{"meshes/*/weights/*", Kind::number},
    index("meshes/*/primitives!/*/attributes!/{}", "/accessors"),
    index("meshes/*/primitives/*/targets/*/{}", "/accessors"),
    index("meshes/*/primitives/*/indices", "/accessors"),
    index("meshes/*/primitives/*/material", "/materials"),
    whole("meshes/*/primitives/*/mode", 0, 6),
    index("meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView!",
          "/bufferViews"),
    whole("meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes!/{}", 0,
          0x7fffffff),
    index("skins/*/joints!/*", "/nodes"),
    index("skins/*/inverseBindMatrices", "/accessors"),
    whole("animations/*/channels!/*/sampler!", 0, 0x7fffffff),
    index("animations/*/channels/*/target!/node", "/nodes"),
    Rule{"animations/*/channels/*/target/path!"},
    index("animations/*/samplers!/*/input!", "/accessors"),
    index("animations/*/samplers/*/output!", "/accessors"),
    Rule{"animations/*/samplers/*/interpolation"},
    whole("accessors/*/count!", 1, 0xffffffffU),
    Rule{"accessors/*/type!", Kind::accessor_type},
    Rule{"accessors/*/componentType!", Kind::component_type},
    Rule{"accessors/*/normalized", Kind::boolean},
    index("accessors/*/bufferView", "/bufferViews"),
    whole("accessors/*/byteOffset", 0, limits.bytes),
    whole("accessors/*/sparse/count!", 1, 0x7fffffff),
    index("accessors/*/sparse/indices!/bufferView!", "/bufferViews"),
    whole("accessors/*/sparse/indices/byteOffset", 0, limits.bytes),
    Rule{"accessors/*/sparse/indices/componentType!", Kind::component_type},
    index("accessors/*/sparse/values!/bufferView!", "/bufferViews"),
    whole("accessors/*/sparse/values/byteOffset", 0, limits.bytes),
    index("bufferViews/*/buffer!", "/buffers"),
    whole("bufferViews/*/byteLength!", 1, limits.bytes),
    whole("bufferViews/*/byteOffset", 0, limits.bytes),
    whole("bufferViews/*/byteStride", 4, 252),
    index("bufferViews/*/extensions/EXT_meshopt_compression/buffer!", "/buffers"),
    whole("bufferViews/*/extensions/EXT_meshopt_compression/byteOffset", 0, limits.bytes),
    whole("bufferViews/*/extensions/EXT_meshopt_compression/byteLength!", 1, limits.bytes),
    whole("bufferViews/*/extensions/EXT_meshopt_compression/byteStride!", 1, 256),
    whole("bufferViews/*/extensions/EXT_meshopt_compression/count!", 1, 0xffffffffU),
    Rule{"bufferViews/*/extensions/EXT_meshopt_compression/mode!"},
    Rule{"bufferViews/*/extensions/EXT_meshopt_compression/filter"},
    Rule{"buffers/*/extensions/EXT_meshopt_compression/fallback", Kind::boolean},
    index("bufferViews/*/extensions/KHR_meshopt_compression/buffer!", "/buffers"),
    whole("bufferViews/*/extensions/KHR_meshopt_compression/byteOffset", 0, limits.bytes),
    whole("bufferViews/*/extensions/KHR_meshopt_compression/byteLength!", 1, limits.bytes),
    whole("bufferViews/*/extensions/KHR_meshopt_compression/byteStride!", 1, 256),
    whole("bufferViews/*/extensions/KHR_meshopt_compression/count!", 1, 0xffffffffU),
    Rule{"bufferViews/*/extensions/KHR_meshopt_compression/mode!"},
    Rule{"bufferViews/*/extensions/KHR_meshopt_compression/filter"},
    Rule{"buffers/*/extensions/KHR_meshopt_compression/fallback", Kind::boolean},
    whole("buffers/*/byteLength!", 1, 1ULL << 53U),
    Rule{"buffers/*/uri"},
};

/// Checked only where surfaces are lit by bump maps or have alpha masks; otherwise textures are not
/// read.
inline constexpr std::array rules_of_lighting{
    numbers("extras?/shadowproof/ambient", 3),
    Rule{"extras?/shadowproof/inverseSquare", Kind::boolean},
    Rule{"extras?/shadowproof/highlight/shadow"},
    whole("extras?/shadowproof/highlight/exponent", 1, 1U << largest_squarings),
    index("extras?/shadowproof/environment/faces!/*", "/textures"),
    numbers("materials/*/pbrMetallicRoughness/baseColorFactor", 4),
    index("materials/*/pbrMetallicRoughness/baseColorTexture/index!", "/textures"),
    whole("materials/*/pbrMetallicRoughness/baseColorTexture/texCoord", 0, 0x7fffffff),
    index("materials/*/normalTexture/index!", "/textures"),
    whole("materials/*/normalTexture/texCoord", 0, 0x7fffffff),
    Rule{"materials/*/normalTexture/scale", Kind::number},
    index("materials/*/extras?/shadowproof/height/index!", "/textures"),
    whole("materials/*/extras?/shadowproof/height/texCoord", 0, 0x7fffffff),
    Rule{"materials/*/extras?/shadowproof/height/scale", Kind::number},
    Rule{"materials/*/extras?/shadowproof/height/unit", Kind::text},
    Rule{"materials/*/extras?/shadowproof/glossInAlpha", Kind::boolean},
    numbers(
        "materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset",
        2),
    numbers(
        "materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale",
        2),
    Rule{"materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
         "rotation",
         Kind::number},
    whole("materials/*/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
          "texCoord",
          0, 0x7fffffff),
    numbers("materials/*/normalTexture/extensions/KHR_texture_transform/offset", 2),
    numbers("materials/*/normalTexture/extensions/KHR_texture_transform/scale", 2),
    Rule{"materials/*/normalTexture/extensions/KHR_texture_transform/rotation", Kind::number},
    whole("materials/*/normalTexture/extensions/KHR_texture_transform/texCoord", 0, 0x7fffffff),
    numbers("materials/*/extras?/shadowproof/height/extensions/KHR_texture_transform/offset", 2),
    numbers("materials/*/extras?/shadowproof/height/extensions/KHR_texture_transform/scale", 2),
    Rule{"materials/*/extras?/shadowproof/height/extensions/KHR_texture_transform/rotation",
         Kind::number},
    whole("materials/*/extras?/shadowproof/height/extensions/KHR_texture_transform/texCoord", 0,
          0x7fffffff),
    numbers("materials/*/extras?/shadowproof/specular", 3),
    numbers("materials/*/extras?/shadowproof/reflectance", 3),
    index("textures/*/sampler", "/samplers"),
    index("textures/*/source", "/images"),
    whole("samplers/*/magFilter", 0, 0xffff),
    whole("samplers/*/wrapS", 0, 0xffff),
    whole("samplers/*/wrapT", 0, 0xffff),
    index("images/*/bufferView", "/bufferViews"),
    Rule{"images/*/uri"},
};

} // namespace shadowproof::gltf
