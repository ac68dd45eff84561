// Distributes numbered pieces of work over threads. Which thread takes which piece never affects
// the result.
#pragma once

#include <functional>

namespace shadowproof {

/// The number of threads to use: one per core for 0; at least 1.
int thread_count(int requested);

/// Calls work(piece, thread) for piece in [0, pieces), thread in [0, threads). Returns when all
/// are done; the first exception is rethrown.
void parallel_for(int pieces, int threads, const std::function<void(int piece, int thread)>& work);

} // namespace shadowproof
