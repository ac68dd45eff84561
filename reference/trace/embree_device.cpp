#include "reference/trace/embree_device.h"

#include "reference/trace/instruction_set.h"
#include "reference/trace/trace.h"
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

std::string embree_version() {
    const EmbreeDevice device(rtcNewDevice(nullptr));
    const auto part = [&](RTCDeviceProperty property) {
        return static_cast<long>(rtcGetDeviceProperty(device.get(), property));
    };
    return fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_MINOR),
                       part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
}

} // namespace shadowproof
