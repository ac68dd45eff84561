#include "reference/walk/instruction_set.h"

#include "scenes/error.h"

#include <fmt/format.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace shadowproof {

namespace {

constexpr const char* variable = "SHADOWPROOF_INSTRUCTION_SET";

struct InstructionSet {
    std::string_view name;
    std::int64_t targets = 0; ///< Highway's
    const char* embree = "";
};

// Without the others Highway emulates vectors, in what every processor has: here SSE2.
#if HWY_ARCH_X86
constexpr std::array known{
    InstructionSet{"sse2", HWY_EMU128, "sse2"}, InstructionSet{"ssse3", HWY_SSSE3, "sse2"},
    InstructionSet{"sse4", HWY_SSE4, "sse4.2"}, InstructionSet{"avx2", HWY_AVX2, "avx2"},
    InstructionSet{"avx512", HWY_AVX3 | HWY_AVX3_DL, "avx512"}};
#else
constexpr std::array<InstructionSet, 0> known{};
#endif

/// Null where none is selected.
const InstructionSet* chosen() {
    const char* const value = std::getenv(variable);
    const std::string_view name = value != nullptr ? value : "";
    if (name.empty() || name == "best") return nullptr;
    const auto* const found = std::find_if(
        known.begin(), known.end(), [&](const InstructionSet& set) { return set.name == name; });
    if (found != known.end()) return found;
    std::string names;
    for (const InstructionSet& set : known) names += fmt::format("{}, ", set.name);
    throw Error(variable, fmt::format("\"{}\" is not known", name),
                fmt::format("give {}best, or unset it", names));
}

} // namespace

void choose_instruction_set() {
    hwy::SetSupportedTargetsForTest(0);
    const std::int64_t available = hwy::SupportedTargets() | HWY_EMU128;
    if (const InstructionSet* set = chosen()) {
        if ((set->targets & available) == 0)
            throw Error(variable, fmt::format("this processor has no {}", set->name),
                        "give another, or unset it");
        hwy::SetSupportedTargetsForTest(set->targets & available);
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::string instruction_set_in_use() {
    const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable); // the lowest bit is the best one's
}

std::string embree_instruction_set() {
    const InstructionSet* set = chosen();
    return set != nullptr ? fmt::format(",isa={}", set->embree) : "";
}

} // namespace shadowproof
