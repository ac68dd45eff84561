// Distributes numbered pieces of work over threads. Which thread takes which piece never affects
// the result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace shadowproof {

/// The number of threads to use: one per core for 0; at least 1.
int thread_count(int requested);

/// Calls work(piece, thread) for piece in [0, pieces), thread in [0, threads). Returns when all
/// are done; the first exception is rethrown.
void parallel_for(int pieces, int threads, const std::function<void(int piece, int thread)>& work);

/// Calls work(i) for i in [0, count), `piece_size` at a time: for work that is small.
template <class Work>
void parallel_for_all(std::size_t count, int threads, const Work& work,
                      std::size_t piece_size = 4096) {
    const auto pieces = static_cast<int>((count + piece_size - 1) / piece_size);
    parallel_for(pieces, threads, [&](int piece, int) {
        const std::size_t begin = static_cast<std::size_t>(piece) * piece_size;
        for (std::size_t i = begin; i < std::min(count, begin + piece_size); ++i) work(i);
    });
}

} // namespace shadowproof
