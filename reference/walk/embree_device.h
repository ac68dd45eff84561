// Embree's device, whose instruction set is the reference's own (instruction_set.h).
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace shadowproof {

struct ReleaseEmbreeDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbreeDevice>;

/// threads 0: one per core. Throws Error where there is none.
EmbreeDevice make_embree_device(int threads);

} // namespace shadowproof
