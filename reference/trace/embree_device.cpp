#include "reference/trace/embree_device.h"

#include "reference/trace/instruction_set.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"

#include <fmt/format.h>

namespace shadowproof {

namespace {
/// The version whose walk the bound in box_tree.cpp was read off.
constexpr const char* proven_embree = "3.13.5";
} // namespace

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

std::optional<std::string> note_on_embree(const std::string& version) {
    if (version == proven_embree) return std::nullopt;
    return fmt::format("Embree {} finds what rays may meet; that it loses nothing was shown of {}",
                       version, proven_embree);
}

} // namespace shadowproof
