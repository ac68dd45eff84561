#include "scenes/load/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace shadowproof::gltf {

namespace {

/// A normalized integer is divided by the largest, and a signed one does not come below -1
/// (section 3.6.2.2).
template <class T>
double load(const unsigned char* bytes, bool normalized) {
    T value{};
    std::memcpy(&value, bytes, sizeof value);
    const auto real = static_cast<double>(value);
    return normalized ? std::max(real / std::numeric_limits<T>::max(), -1.0) : real;
}

double component_at(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return load<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return load<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<std::uint32_t>(bytes, normalized);
    default:
        return load<float>(bytes, false);
    }
}

unsigned kind_of(int component_type, bool normalized) {
    if (component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) return floats;
    if (normalized) return normalized_integers;
    const bool is_signed = component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
                           component_type == TINYGLTF_COMPONENT_TYPE_SHORT;
    return is_signed ? plain_integers : plain_integers | unsigned_integers;
}

/// "VEC3"
std::string type_name(int type) {
    if (type == TINYGLTF_TYPE_SCALAR) return "SCALAR";
    return type <= TINYGLTF_TYPE_VEC4 ? fmt::format("VEC{}", type)
                                      : fmt::format("MAT{}", type - TINYGLTF_TYPE_MAT2 + 2);
}

std::size_t bytes_of(int component_type) {
    return as_index(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

/// Elements at equal distances in a buffer.
struct Strided {
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
};

/// The bytes of `count` elements of `element_bytes` each, from `offset` in a buffer view on, that
/// `owner` (an accessor, or a sparse part of one) refers to. tinygltf does not check ranges.
Strided strided(const Document& document, const Place& owner, std::size_t view_index,
                std::size_t offset, std::size_t count, std::size_t element_bytes) {
    const tinygltf::BufferView& view = document.model.bufferViews[view_index];
    const Place place = document.root() / "bufferViews" / view_index;
    const std::vector<unsigned char>& buffer = document.model.buffers[as_index(view.buffer)].data;
    // No overflow here and below: counts are below 2^32, strides 2^8, all else at most 2^30.
    if (view.byteOffset + view.byteLength > buffer.size())
        place.refuse(fmt::format("ends at byte {} of a buffer of {}",
                                 view.byteOffset + view.byteLength, buffer.size()),
                     "mend byteOffset and byteLength");
    const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
    if (stride < element_bytes)
        (place / "byteStride")
            .refuse(fmt::format("{} is less than an element's {} bytes", stride, element_bytes),
                    "widen the stride");
    const std::uint64_t needed = offset + (count - 1) * stride + element_bytes;
    if (needed > view.byteLength)
        owner.refuse(
            fmt::format("needs {} bytes but its buffer view has {}", needed, view.byteLength),
            "mend count, byteOffset or the buffer view");
    return {buffer.data() + view.byteOffset + offset, stride};
}

/// One accessor being read.
struct Source {
    const Document& document;
    const tinygltf::Accessor& accessor;
    Place place;
    std::size_t components = 1;
    std::size_t element_bytes = 4;
    Strided values{}; ///< null where it has no buffer view: all zero
};

Source open_accessor(const Document& document, std::size_t index) {
    const tinygltf::Accessor& accessor = document.model.accessors[index];
    const auto type = static_cast<std::uint32_t>(accessor.type);
    Source source{document, accessor, document.root() / "accessors" / index,
                  as_index(tinygltf::GetNumComponentsInType(type))};
    source.element_bytes = source.components * bytes_of(accessor.componentType);
    if (accessor.bufferView >= 0)
        source.values = strided(document, source.place, as_index(accessor.bufferView),
                                accessor.byteOffset, accessor.count, source.element_bytes);
    return source;
}

void read_element(const Source& source, const unsigned char* bytes, double* values) {
    const int type = source.accessor.componentType;
    for (std::size_t k = 0; k < source.components; ++k)
        values[k] = component_at(bytes + k * bytes_of(type), type, source.accessor.normalized);
}

Elements read_elements(const Source& source) {
    Elements elements{source.accessor.count, source.components, {}, {}};
    elements.held =
        source.document.memory->hold({elements.count * elements.components * sizeof(double),
                                      source.place.where(), "its elements", "split the accessor"});
    elements.values.resize(elements.count * elements.components);
    for (std::size_t i = 0; source.values.first != nullptr && i < elements.count; ++i)
        read_element(source, source.values.first + i * source.values.stride,
                     elements.values.data() + i * source.components);
    return elements;
}

/// The indices of the elements that accessor.sparse lists: in range, strictly increasing.
std::vector<std::size_t> sparse_places(const Source& source, std::size_t count) {
    const auto& indices = source.accessor.sparse.indices;
    const Place place = source.place / "sparse" / "indices";
    if ((kind_of(indices.componentType, false) & unsigned_integers) == 0)
        (place / "componentType").refuse("is not an unsigned integer", "use 5121, 5123 or 5125");
    const Strided stored =
        strided(source.document, place, as_index(indices.bufferView), as_index(indices.byteOffset),
                count, bytes_of(indices.componentType));
    std::vector<std::size_t> places(count);
    for (std::size_t i = 0; i < count; ++i) {
        places[i] = static_cast<std::size_t>(
            component_at(stored.first + i * stored.stride, indices.componentType, false));
        if (places[i] >= source.accessor.count || (i > 0 && places[i] <= places[i - 1]))
            place.refuse(fmt::format("element {} is {}, not above the one before it and below {}",
                                     i, places[i], source.accessor.count),
                         "sort the indices and keep them in range");
    }
    return places;
}

/// Overwrites the elements that accessor.sparse lists (section 3.6.2.3).
void substitute_sparse(const Source& source, Elements& elements) {
    const auto& sparse = source.accessor.sparse;
    if (!sparse.isSparse) return;
    const std::size_t count = as_index(sparse.count);
    if (count > elements.count)
        (source.place / "sparse" / "count")
            .refuse(fmt::format("{} is above the accessor's {}", count, elements.count),
                    "mend the count");
    const MemoryHold held = source.document.memory->hold(
        {count * sizeof(std::size_t), source.place.where(), "its sparse indices", "split it"});
    const std::vector<std::size_t> places = sparse_places(source, count);
    const Strided values = strided(source.document, source.place / "sparse" / "values",
                                   as_index(sparse.values.bufferView),
                                   as_index(sparse.values.byteOffset), count, source.element_bytes);
    for (std::size_t i = 0; i < count; ++i)
        read_element(source, values.first + i * values.stride,
                     elements.values.data() + places[i] * source.components);
}

void require_finite(const Place& reference, const Elements& elements) {
    const auto bad = std::find_if(elements.values.begin(), elements.values.end(),
                                  [](double value) { return !std::isfinite(value); });
    if (bad == elements.values.end()) return;
    const auto at = static_cast<std::size_t>(bad - elements.values.begin()) / elements.components;
    reference.refuse(fmt::format("element {} holds {}", at, *bad), "replace it by a finite number");
}

} // namespace

void AccessorReader::charge(const Place& reference, std::size_t elements) {
    elements_read_ += elements;
    if (elements_read_ > limits.elements)
        reference.refuse(fmt::format("brings the elements read above {}", limits.elements),
                         "split the asset");
}

Elements AccessorReader::read(const Place& reference, int accessor, int type,
                              unsigned component_kinds) {
    const Source source = open_accessor(document_, as_index(accessor));
    const int component_type = source.accessor.componentType;
    if (source.accessor.type != type)
        reference.refuse(fmt::format("names an accessor of type {}, not {}",
                                     type_name(source.accessor.type), type_name(type)),
                         "name another accessor");
    if ((kind_of(component_type, source.accessor.normalized) & component_kinds) == 0)
        reference.refuse(
            fmt::format("names an accessor of component type {}{}, which is not allowed here",
                        component_type, source.accessor.normalized ? " (normalized)" : ""),
            "name another accessor, or list the extension that allows it");
    // At most 16 doubles per element, and the number of elements is limited: a bound on time.
    charge(reference, source.accessor.count * ((source.components + 3) / 4));
    Elements elements = read_elements(source);
    substitute_sparse(source, elements);
    require_finite(reference, elements);
    return elements;
}

std::vector<std::uint32_t> AccessorReader::read_indices(const Place& reference, int accessor,
                                                        std::size_t end) {
    const Elements elements = read(reference, accessor, TINYGLTF_TYPE_SCALAR, unsigned_integers);
    memory().require({elements.count * sizeof(std::uint32_t), reference.where(), "its indices",
                      "split the primitive"});
    std::vector<std::uint32_t> indices(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) {
        if (elements.values[i] >= static_cast<double>(end))
            reference.refuse(fmt::format("index {} at element {} is not below the {} vertices",
                                         elements.values[i], i, end),
                             "mend the indices");
        indices[i] = static_cast<std::uint32_t>(elements.values[i]);
    }
    return indices;
}

} // namespace shadowproof::gltf
