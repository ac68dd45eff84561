// Libraries of this program that are loaded only when something needs them: their dependencies take
// time to load, or export symbols that would clash with ours.
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
