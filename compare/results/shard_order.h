// The shards of a run among several results.
#pragma once

#include "compare/results/results_index.h"

#include <vector>

namespace shadowproof {

bool is_shard(const IndexedResults& run);

/// Puts shards in order, before other runs, of which there may be none. Throws Error naming the
/// file where they are not all shards of one run, each once.
void order_shards(std::vector<IndexedResults>& runs);

} // namespace shadowproof
