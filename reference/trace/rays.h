// What is computed of a packet's rays before they are sent: floats for the tests of triangles, and
// what the walk needs.
#pragma once

#include "reference/trace/packet.h"

namespace shadowproof {

/// Sets what follows from the inputs of set_lane, for rays of this view. `from_above`: parallel
/// rays are walked from their upper limits down; otherwise from the lower ones up.
void prepare(RayPacket& packet, const OriginView& view, bool from_above);

} // namespace shadowproof
