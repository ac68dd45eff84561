#include "scenes/gltf_json.h"

#include "scenes/error.h"

#include <fmt/format.h>

namespace shadowproof::gltf {

namespace {

/// A key as it stands in a JSON pointer (RFC 6901, section 3).
std::string escaped(const char* key) {
    std::string result;
    for (const char* c = key; *c != '\0'; ++c)
        result += *c == '~' ? "~0" : *c == '/' ? "~1" : std::string(1, *c);
    return result;
}

} // namespace

std::optional<Item> Item::find(const char* key) const {
    if (!value_->is_object())
        refuse(fmt::format("is {}, not an object", value_->type_name()), "write an object");
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return Item(*file_, *member, pointer_ + '/' + escaped(key));
}

Item Item::at(const char* key) const {
    if (auto member = find(key)) return *member;
    refuse(fmt::format("\"{}\" is missing", key), "add it; glTF 2.0 requires it");
}

std::size_t Item::size() const {
    if (!value_->is_array())
        refuse(fmt::format("is {}, not an array", value_->type_name()), "write an array");
    return value_->size();
}

Item Item::operator[](std::size_t element) const {
    if (element >= size()) refuse(fmt::format("has no element {}", element), "add it");
    return {*file_, (*value_)[element], fmt::format("{}/{}", pointer_, element)};
}

double Item::number() const {
    if (!value_->is_number())
        refuse(fmt::format("is {}, not a number", value_->type_name()), "write a number");
    return value_->get<double>();
}

std::string Item::text() const {
    if (!value_->is_string())
        refuse(fmt::format("is {}, not a string", value_->type_name()), "write a string");
    return value_->get<std::string>();
}

bool Item::truth() const {
    if (!value_->is_boolean())
        refuse(fmt::format("is {}, not true or false", value_->type_name()), "write a boolean");
    return value_->get<bool>();
}

std::uint64_t Item::whole(std::uint64_t least, std::uint64_t most) const {
    // glTF allows an integer to be written with a fraction of zero, such as 3.0.
    const double value = number();
    const bool unsigned_integer = value_->is_number_unsigned();
    const bool fits = unsigned_integer
                          ? value_->get<std::uint64_t>() <= most
                          : value >= 0 && value < 0x1p53 &&
                                value == static_cast<double>(static_cast<std::uint64_t>(value));
    const std::uint64_t integer = !fits              ? 0
                                  : unsigned_integer ? value_->get<std::uint64_t>()
                                                     : static_cast<std::uint64_t>(value);
    if (!fits || integer < least || integer > most)
        refuse(fmt::format("{} is not an integer from {} to {}", value_->dump(), least, most),
               "write one");
    return integer;
}

std::vector<double> Item::numbers(std::size_t count) const {
    if (size() != count)
        refuse(fmt::format("has {} elements, not {}", size(), count),
               fmt::format("write {} numbers", count));
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = (*this)[i].number();
    return values;
}

glm::dvec3 Item::vector() const {
    const std::vector<double> values = numbers(3);
    return {values[0], values[1], values[2]};
}

double Item::number_or(const char* key, double otherwise) const {
    const auto member = find(key);
    return member ? member->number() : otherwise;
}

std::string Item::text_or(const char* key, const std::string& otherwise) const {
    const auto member = find(key);
    return member ? member->text() : otherwise;
}

std::uint64_t Item::whole_or(const char* key, std::uint64_t least, std::uint64_t most,
                             std::uint64_t otherwise) const {
    const auto member = find(key);
    return member ? member->whole(least, most) : otherwise;
}

std::string Item::where() const {
    return pointer_.empty() ? *file_ : *file_ + ' ' + pointer_;
}

void Item::refuse(const std::string& what, const std::string& remedy) const {
    throw Error(where(), what, remedy);
}

std::size_t count_of(const Item& root, const char* array) {
    const auto items = root.find(array);
    return items ? items->size() : 0;
}

std::size_t reference_index(const Item& root, const char* array, const Item& reference) {
    const std::size_t count = count_of(root, array);
    const std::uint64_t index = reference.whole(0, 0xffffffffU);
    if (index >= count)
        reference.refuse(fmt::format("{} is no index into /{}, which has {}", index, array, count),
                         "name an element that exists");
    return index;
}

Item referenced(const Item& root, const char* array, const Item& reference) {
    const std::size_t index = reference_index(root, array, reference); // first: it names itself
    return root.at(array)[index];
}

} // namespace shadowproof::gltf
