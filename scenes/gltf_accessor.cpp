#include "scenes/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace shadowproof::gltf {

namespace {

/// A component type's number in glTF, its size, and how a normalized integer becomes a real
/// (section 3.6.2.2: divide by the largest, and for signed ones not below -1).
struct Component {
    std::uint32_t code = 0;
    std::size_t bytes = 0;
    double largest = 0; ///< 0: float
    bool is_signed = false;
};

constexpr std::array<Component, 6> component_types{{{5120, 1, 127, true},
                                                    {5121, 1, 255, false},
                                                    {5122, 2, 32767, true},
                                                    {5123, 2, 65535, false},
                                                    {5125, 4, 4294967295.0, false},
                                                    {5126, 4, 0, true}}};

template <class T>
double load(const std::byte* bytes) {
    T value{};
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double component_at(const std::byte* bytes, const Component& component) {
    switch (component.code) {
    case 5120:
        return load<std::int8_t>(bytes);
    case 5121:
        return load<std::uint8_t>(bytes);
    case 5122:
        return load<std::int16_t>(bytes);
    case 5123:
        return load<std::uint16_t>(bytes);
    case 5125:
        return load<std::uint32_t>(bytes);
    default:
        return load<float>(bytes);
    }
}

Component component_type(const Item& owner) {
    const Item code = owner.at("componentType");
    const std::uint64_t value = code.whole(0, 0xffff);
    for (const Component& component : component_types)
        if (component.code == value) return component;
    code.refuse(fmt::format("{} is no component type", value), "use 5120 to 5123, 5125 or 5126");
}

std::size_t components_of(const Item& accessor) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 7> types{{{"SCALAR", 1},
                                                                             {"VEC2", 2},
                                                                             {"VEC3", 3},
                                                                             {"VEC4", 4},
                                                                             {"MAT2", 4},
                                                                             {"MAT3", 9},
                                                                             {"MAT4", 16}}};
    const std::string name = accessor.at("type").text();
    for (const auto& [type, components] : types)
        if (type == name) return components;
    accessor.at("type").refuse(fmt::format("\"{}\" is no accessor type", name), "use \"VEC3\"");
}

/// Elements at equal distances in a buffer.
struct Strided {
    const std::byte* first = nullptr; ///< null: all zero
    std::size_t stride = 0;
};

/// The bytes of `count` elements of `element_bytes` each that `owner` (an accessor, or a sparse
/// part of one) finds through its bufferView.
Strided strided(const Document& document, const Item& owner, std::size_t count,
                std::size_t element_bytes) {
    const Item root = document.root();
    const Item view = referenced(root, "bufferViews", owner.at("bufferView"));
    const Item buffer_reference = view.at("buffer");
    const std::size_t index = reference_index(root, "buffers", buffer_reference);
    const std::span<const std::byte> buffer = document.buffers[index];
    const std::uint64_t length = view.at("byteLength").whole(1, limits.bytes);
    const std::uint64_t view_offset = view.whole_or("byteOffset", 0, limits.bytes, 0);
    if (view_offset + length > buffer.size())
        view.refuse(
            fmt::format("ends at byte {} of a buffer of {}", view_offset + length, buffer.size()),
            "mend byteOffset and byteLength");
    const std::uint64_t stride = view.whole_or("byteStride", 4, 252, element_bytes);
    if (stride < element_bytes)
        view.at("byteStride")
            .refuse(fmt::format("{} is less than an element's {} bytes", stride, element_bytes),
                    "widen the stride");
    const std::uint64_t offset = owner.whole_or("byteOffset", 0, limits.bytes, 0);
    // No overflow: count < 2^32, stride < 2^8, and the offset at most 2^30.
    const std::uint64_t needed = offset + (count - 1) * stride + element_bytes;
    if (needed > length)
        owner.refuse(fmt::format("needs {} bytes but its buffer view has {}", needed, length),
                     "mend count, byteOffset or the buffer view");
    return {buffer.data() + view_offset + offset, stride};
}

struct Accessor {
    Item item;
    std::size_t count = 0;
    std::size_t components = 1;
    Component component;
    bool normalized = false;
    Strided values;
};

Accessor open_accessor(const Document& document, const Item& reference) {
    const Item item = referenced(document.root(), "accessors", reference);
    Accessor accessor{item,
                      item.at("count").whole(1, 0xffffffffU),
                      components_of(item),
                      component_type(item),
                      item.has("normalized") && item.at("normalized").truth(),
                      {}};
    if (item.has("bufferView"))
        accessor.values =
            strided(document, item, accessor.count, accessor.components * accessor.component.bytes);
    return accessor;
}

void read_element(const Accessor& accessor, const std::byte* bytes, double* values) {
    const Component& component = accessor.component;
    for (std::size_t k = 0; k < accessor.components; ++k) {
        const double value = component_at(bytes + k * component.bytes, component);
        values[k] = accessor.normalized && component.largest > 0
                        ? std::max(value / component.largest, -1.0)
                        : value;
    }
}

/// Overwrites the elements that accessor.sparse lists (section 3.6.2.3).
void substitute_sparse(const Document& document, const Accessor& accessor, Elements& elements) {
    const auto sparse = accessor.item.find("sparse");
    if (!sparse) return;
    const std::size_t count = sparse->at("count").whole(1, accessor.count);
    const Item indices = sparse->at("indices");
    const Component index_type = component_type(indices);
    if (index_type.is_signed)
        indices.at("componentType").refuse("is not an unsigned integer", "use 5121, 5123 or 5125");
    const Strided places = strided(document, indices, count, index_type.bytes);
    const Strided values = strided(document, sparse->at("values"), count,
                                   accessor.components * accessor.component.bytes);
    double previous = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const double place = component_at(places.first + i * places.stride, index_type);
        if (place <= previous || place >= static_cast<double>(accessor.count))
            indices.refuse(fmt::format("element {} is {}, not above the one before it and below {}",
                                       i, place, accessor.count),
                           "sort the indices and keep them in range");
        previous = place;
        read_element(accessor, values.first + i * values.stride,
                     elements.values.data() +
                         static_cast<std::size_t>(place) * accessor.components);
    }
}

unsigned kind_of(const Accessor& accessor) {
    if (accessor.component.largest == 0) return floats;
    if (accessor.normalized) return normalized_integers;
    return accessor.component.is_signed ? plain_integers : plain_integers | unsigned_integers;
}

void require_finite(const Item& reference, const Elements& elements) {
    const auto bad = std::find_if(elements.values.begin(), elements.values.end(),
                                  [](double value) { return !std::isfinite(value); });
    if (bad == elements.values.end()) return;
    const auto at = static_cast<std::size_t>(bad - elements.values.begin()) / elements.components;
    reference.refuse(fmt::format("element {} holds {}", at, *bad), "replace it by a finite number");
}

} // namespace

void AccessorReader::charge(const Item& reference, std::size_t elements) {
    elements_read_ += elements;
    if (elements_read_ > limits.elements)
        reference.refuse(fmt::format("brings the elements read above {}", limits.elements),
                         "split the asset");
}

Elements AccessorReader::read(const Item& reference, std::initializer_list<std::string_view> types,
                              unsigned component_kinds) {
    const Accessor accessor = open_accessor(document_, reference);
    const std::string type = accessor.item.at("type").text();
    if (std::find(types.begin(), types.end(), type) == types.end())
        reference.refuse(
            fmt::format("names an accessor of type {}, not {}", type, fmt::join(types, " or ")),
            "name another accessor");
    if ((kind_of(accessor) & component_kinds) == 0)
        reference.refuse(fmt::format("names an accessor of component type {}{}, which is not "
                                     "allowed here",
                                     accessor.component.code,
                                     accessor.normalized ? " (normalized)" : ""),
                         "name another accessor, or list the extension that allows it");
    // 16 doubles an element at most, and elements are limited: a bound on memory as well.
    charge(reference, accessor.count * ((accessor.components + 3) / 4));
    Elements elements{accessor.count, accessor.components, {}};
    elements.values.resize(accessor.count * accessor.components);
    if (accessor.values.first != nullptr)
        for (std::size_t i = 0; i < accessor.count; ++i)
            read_element(accessor, accessor.values.first + i * accessor.values.stride,
                         elements.values.data() + i * accessor.components);
    substitute_sparse(document_, accessor, elements);
    require_finite(reference, elements);
    return elements;
}

std::vector<std::uint32_t> AccessorReader::read_indices(const Item& reference, std::size_t end) {
    const Elements elements = read(reference, {"SCALAR"}, unsigned_integers);
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

std::size_t AccessorReader::count(const Item& reference) const {
    return referenced(document_.root(), "accessors", reference).at("count").whole(1, 0xffffffffU);
}

} // namespace shadowproof::gltf
