// Libraries of this program that are loaded once something needs them: what comes with them takes
// time, or has symbols that must not meet ours.
#pragma once

#include <string>

namespace shadowproof {

/// Where a module is.
struct ModulePlaces {
    const char* installed = ""; ///< relative to where the program is installed
    const char* built = "";     ///< in the build directory
};

/// The address of a symbol of a module, which stays loaded. Throws Error, about `what`, where it is
/// not found.
void* module_symbol(const std::string& what, const ModulePlaces& places, const char* symbol);

} // namespace shadowproof
