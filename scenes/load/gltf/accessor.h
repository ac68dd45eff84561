// Accessors (glTF 2.0, section 3.6.2): every type, normalized integers, strides and sparse
// substitution, each byte range checked before it is read.
#pragma once

#include "scenes/load/gltf/file.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof::gltf {

/// Values of one accessor as doubles, element by element, each finite.
struct Elements {
    std::size_t count = 0;
    std::size_t components = 1; ///< 1 to 4, or 16
    std::vector<double> values; ///< count * components
    MemoryHold held{};          ///< for the values

    glm::dvec3 vec3(std::size_t element) const {
        const double* v = values.data() + element * components;
        return {v[0], v[1], v[2]};
    }
};

/// One bit per kind of component that a reader accepts.
enum ComponentKinds : unsigned {
    floats = 1,
    normalized_integers = 2,
    plain_integers = 4,
    unsigned_integers = 8, ///< not normalized
};

/// Reads accessors of one document and counts how much was read in all, so that a small file that
/// requests the same bytes again and again is refused.
class AccessorReader {
public:
    explicit AccessorReader(const Document& document) : document_(document) {}

    /// The accessor of that index, which `reference` names; `type` is TINYGLTF_TYPE_VEC3 or the
    /// like. Refused at the reference: another type, a component kind not listed, NaN, infinity.
    Elements read(const Place& reference, int accessor, int type, unsigned component_kinds);

    /// A scalar accessor of unsigned integers, each below `end`.
    std::vector<std::uint32_t> read_indices(const Place& reference, int accessor, std::size_t end);

    const Document& document() const { return document_; }
    MemoryAccount& memory() const { return *document_.memory; }

    /// Counts `elements` more as read; refused at the reference above limits.elements. For elements
    /// that are processed repeatedly without being read from a buffer.
    void charge(const Place& reference, std::size_t elements);

private:
    const Document& document_;
    std::uint64_t elements_read_ = 0;
};

} // namespace shadowproof::gltf
