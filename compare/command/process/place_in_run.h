// Where a run over several scenes is, for the line of its progress.
#pragma once

#include <cstddef>
#include <string>

namespace shadowproof {

/// ", about 300 s left", where `done` of `all` things took so many seconds; empty before the first
/// is done.
std::string time_left(std::size_t done, std::size_t all, double seconds);

/// "scene 2 of 37, about 300 s left: "; the time is that of the earlier scenes on average. Empty
/// for a single scene. `scene`: its index; `seconds`: since the first began.
std::string place_in_run(std::size_t scene, std::size_t scenes, double seconds);

} // namespace shadowproof
