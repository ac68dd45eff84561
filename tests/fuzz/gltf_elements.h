// The elements of accessors, where they lie in an asset's buffers.
#pragma once

#include "tests/dice.h"
#include "tests/fuzz/asset.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof::fuzz {

/// Elements of an accessor in the bytes of its buffer, packed as most exporters do.
struct Elements {
    std::uint8_t* first = nullptr;
    std::size_t count = 0;
    std::size_t components = 0;
    std::size_t component_bytes = 0;
    bool floating = false;

    std::size_t bytes() const { return components * component_bytes; }
};

/// Of the accessor at `index`; none where anything of it lies outside its buffer.
std::optional<Elements> elements_of(Asset& asset, std::size_t index);

/// Of some accessor that a primitive names as `attribute`, or as its indices where it is "indices".
/// None where there is none, or anything of it lies outside its buffer.
std::optional<Elements> some_accessor(Asset& asset, const std::string& attribute, Dice& dice);

/// The number of a float or an index: counted over all components.
float float_at(const Elements& of, std::size_t number);
void set_float(const Elements& of, std::size_t number, float value);
std::uint32_t index_at(const Elements& of, std::size_t number);
void set_index(const Elements& of, std::size_t number, std::uint32_t value);
void copy_element(const Elements& of, std::size_t to, std::size_t from);

} // namespace shadowproof::fuzz
