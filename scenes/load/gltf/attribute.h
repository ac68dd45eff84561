// Vertex attributes of a primitive, moved by its morph targets.
#pragma once

#include "scenes/load/gltf/accessor.h"

#include <string>
#include <vector>

namespace shadowproof::gltf {

/// A primitive and its place in the file.
struct Part {
    Place place;
    const tinygltf::Primitive& primitive;
};

/// An attribute's name, and what its accessor may hold; displacements of a tangent have no w.
struct Attribute {
    std::string name;
    int type = TINYGLTF_TYPE_VEC3;
    int displacement_type = TINYGLTF_TYPE_VEC3;
    unsigned kinds = floats;           ///< of the attribute and of displacements, and
    unsigned quantized_kinds = floats; ///< these as well where KHR_mesh_quantization is used
};

bool has_attribute(const Part& part, const Attribute& attribute);

/// The attribute's values, which must be there, plus weight times displacement for every morph
/// target that moves it (glTF 2.0, section 3.7.2.2). Refused: targets and weights, or vertices
/// (where `vertices` is not 0) and elements, that differ in number.
Elements read_morphed(AccessorReader& reader, const Part& part, const Attribute& attribute,
                      const std::vector<double>& weights, std::size_t vertices = 0);

} // namespace shadowproof::gltf
