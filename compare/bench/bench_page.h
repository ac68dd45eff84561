// The page of a benchmark's plot: one file that opens from disk, with its data in a script beside
// it.
#pragma once

#include <string>

namespace shadowproof {

/// index.html; it holds no results.
std::string bench_page();

/// results.js of a run, and of an older one to be shown beside it (empty: none), both as JSON.
std::string bench_script(const std::string& bench_json, const std::string& older_json);

} // namespace shadowproof
