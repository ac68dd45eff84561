// A scene as it enters a benchmark: what it is called, and what an earlier run had of it.
#pragma once

#include "compare/command/bench/measure.h"

namespace shadowproof {

/// What results say of a scene, not finished. It has a name of its own in the run: two files may
/// have one stem. `kept`: an earlier run; null: none. The scene has the name that it had there.
BenchScene measured_scene(const BenchRun& run, const BenchRun* kept, const Scene& scene,
                          const std::string& argument);

/// Whether an earlier run had finished the scene: its points are taken over, but where pictures are
/// wanted, which are drawn anew. Throws Error where it had another scene of that name.
bool take_over(const BenchWork& work, BenchScene& scene, const Scene& read);

} // namespace shadowproof
