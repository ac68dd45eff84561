// What must hold of whatever a file makes the program do. A broken promise is said on standard
// error and aborts, which a fuzzer takes for a crash.
#pragma once

#include "scenes/scene.h"

#include <optional>
#include <string>

namespace shadowproof::fuzz {

[[noreturn]] void broken(const std::string& promise);

inline void require(bool holds, const char* promise) {
    if (!holds) broken(promise);
}

/// What is wrong with an Error's text, which is to read "<where>: <what>; <remedy>", to begin with
/// `where`, and to be one line of valid UTF-8 without control characters, and not endless.
std::optional<std::string> fault_of_message(const std::string& message, const std::string& where);

/// All numbers finite, all indices in range, all meshes without gaps.
void check_scene(const Scene& scene);

} // namespace shadowproof::fuzz
