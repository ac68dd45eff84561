// The scenes that come with shadowproof. Each provokes exactly the causes it names; the tests check
// every claim made here by tracing.
#pragma once

#include "scenes/bundled/author/gltf_writer.h"

#include <vector>

namespace shadowproof::author {

/// In the order of the catalog.
std::vector<Stage> all_stages();

} // namespace shadowproof::author
