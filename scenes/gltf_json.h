// One value of a glTF file's JSON together with its place, so that whatever is wrong with it is
// named by file and JSON pointer. tinygltf is not used: it drops values of a wrong type and folds
// large integers, and then nothing is left to check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof::gltf {

/// A view: file name and JSON must outlive it. Every getter refuses (throws Error) a value that is
/// not of the kind asked for.
class Item {
public:
    Item(const std::string& file, const nlohmann::json& value, std::string pointer = {})
        : file_(&file), value_(&value), pointer_(std::move(pointer)) {}

    /// Member of an object; find: nothing where it is missing, at: refused.
    std::optional<Item> find(const char* key) const;
    Item at(const char* key) const;
    bool has(const char* key) const { return find(key).has_value(); }

    /// Elements of an array.
    std::size_t size() const;
    Item operator[](std::size_t element) const;

    double number() const; ///< always finite: JSON has no other
    std::string text() const;
    bool truth() const;
    std::uint64_t whole(std::uint64_t least, std::uint64_t most) const; ///< an integer in [.., ..]
    std::vector<double> numbers(std::size_t count) const; ///< an array of exactly that many
    glm::dvec3 vector() const;                            ///< an array of three

    double number_or(const char* key, double otherwise) const;
    std::string text_or(const char* key, const std::string& otherwise) const;
    std::uint64_t whole_or(const char* key, std::uint64_t least, std::uint64_t most,
                           std::uint64_t otherwise) const;

    /// "scene.gltf /nodes/3/mesh"
    std::string where() const;
    const std::string& pointer() const { return pointer_; }
    [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const;

private:
    const std::string* file_;
    const nlohmann::json* value_;
    std::string pointer_;
};

/// Number of elements of a root array such as "nodes"; 0 where it is missing.
std::size_t count_of(const Item& root, const char* array);

/// The element of a root array that `reference` (an index) names; refused where there is none.
Item referenced(const Item& root, const char* array, const Item& reference);
std::size_t reference_index(const Item& root, const char* array, const Item& reference);

} // namespace shadowproof::gltf
