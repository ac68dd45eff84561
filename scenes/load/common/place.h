// A place in a file: the file's name and, in JSON, a pointer (RFC 6901). Errors name both.
#pragma once

#include "scenes/error.h"

#include <string>
#include <string_view>

namespace shadowproof {

/// Holds a reference: the file's name must outlive it.
class Place {
public:
    explicit Place(const std::string& file, std::string pointer = {})
        : file_(&file), pointer_(std::move(pointer)) {}

    Place operator/(std::string_view key) const {
        std::string pointer = pointer_ + '/';
        for (const char c : key) // RFC 6901, section 3
            if (c == '~' || c == '/')
                pointer += c == '~' ? "~0" : "~1";
            else
                pointer += c;
        return Place(*file_, std::move(pointer));
    }
    Place operator/(std::size_t element) const {
        return Place(*file_, pointer_ + '/' + std::to_string(element));
    }

    /// "/nodes/3/mesh"
    const std::string& pointer() const { return pointer_; }
    /// "scene.gltf /nodes/3/mesh"
    std::string where() const { return pointer_.empty() ? *file_ : *file_ + ' ' + pointer_; }
    [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
        throw Error(where(), what, remedy);
    }

private:
    const std::string* file_;
    std::string pointer_;
};

} // namespace shadowproof
