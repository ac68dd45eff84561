// The one exception type: something outside the program (a file, a driver, a setting) is not as it
// must be. A disagreement between truth and claim is a result, never an error.
#pragma once

#include "scenes/printable.h"

#include <stdexcept>
#include <string>

namespace shadowproof {

/// The message reads "<where>: <what is wrong>; <remedy>", one sentence, no trailing newline. Text
/// from files in it is made printable and short, as what() ends at the first NUL.
struct Error : std::runtime_error {
    Error(const std::string& where, const std::string& what, const std::string& remedy)
        : std::runtime_error(message(where + ": " + what + "; " + remedy)) {}
};

} // namespace shadowproof
