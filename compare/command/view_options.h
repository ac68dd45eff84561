// The flags that put another view in place of the file's: --camera-matrix, --light-position, --fov,
// --ortho.
#pragma once

#include "scenes/load/common/scene_request.h"

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace shadowproof {

/// Numbers are separated by commas or white space. Values are checked as they are parsed: a bad one
/// is wrong usage.
void add_view_flags(CLI::App& command, ViewOverride& view);

/// Whether any of them was given.
bool is_given(const ViewOverride& view);

/// The flags that were given, as words of a command line.
std::vector<std::string> settings(const ViewOverride& view);

} // namespace shadowproof
