// What workers have done so far, piece by piece, as their supervisor records it.
#pragma once

#include "compare/loss.h"

#include <cstddef>
#include <string>
#include <vector>

namespace shadowproof {

struct PieceRecord {
    std::string name{};
    bool done = false;
    std::string result{};   ///< where it is done: packed
    Loss loss = Loss::none; ///< if not none, it is not tried again
    std::string why{};      ///< "the process that tried it was ended by signal 6 (Aborted)"
    std::size_t number = 0; ///< the first loss of the run is 1
    std::vector<PieceRecord> inner{}; ///< in the order in which they were begun
};

/// The work as a whole.
struct WorkRecord {
    PieceRecord whole{};
    std::size_t losses = 0;
};

} // namespace shadowproof
