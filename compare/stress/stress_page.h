// The page of stress: one file that opens from disk, with its data in a script beside it.
#pragma once

#include <string>

namespace shadowproof {

/// index.html; it holds no results.
std::string stress_page();

/// results.js of a run, as JSON.
std::string stress_script(const std::string& stress_json);

} // namespace shadowproof
