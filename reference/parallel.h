// Work shared out over threads in numbered pieces. Which thread takes which piece never shows in
// the result.
#pragma once

#include <functional>

namespace shadowproof {

/// 0 means one per core; at least 1.
int thread_count(int requested);

/// Calls work(piece, thread) for piece in [0, pieces), thread in [0, threads). Returns when all
/// are done; the first exception is rethrown.
void parallel_for(int pieces, int threads, const std::function<void(int piece, int thread)>& work);

} // namespace shadowproof
