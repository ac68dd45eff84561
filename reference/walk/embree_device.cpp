#include "reference/walk/embree_device.h"

#include "reference/walk/instruction_set.h"
#include "scenes/error.h"

#include <fmt/format.h>

namespace shadowproof {

EmbreeDevice make_embree_device(int threads) {
    EmbreeDevice device(
        rtcNewDevice(fmt::format("threads={}{}", threads, embree_instruction_set()).c_str()));
    if (!device)
        throw Error(
            "Embree",
            fmt::format("no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr))),
            "check that the processor has SSE2");
    return device;
}

} // namespace shadowproof
