// The commands that make a point of a benchmark again.
#pragma once

#include "compare/command/bench/options.h"
#include "scenes/scene.h"

#include <string>
#include <vector>

namespace shadowproof {

/// The words that measure one point again.
std::string bench_command(const BenchOptions& options, const std::string& scene,
                          const std::string& technique, const BenchSettings& settings);

/// The words, after the program's name, that show the same with verify. `scene`: as it was read;
/// `argument`: as it was named.
std::vector<std::string> verify_words(const BenchOptions& options, const Scene& scene,
                                      const std::string& argument, const Technique& technique,
                                      const BenchSettings& with);

} // namespace shadowproof
