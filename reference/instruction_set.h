// Which of the processor's instruction sets the reference runs on: by itself the best. For tests,
// which hold that all of them give the same bytes, the environment variable
// SHADOWPROOF_INSTRUCTION_SET chooses: sse2, ssse3, sse4, avx2, avx512, or best.
#pragma once

#include <string>

namespace shadowproof {

/// As the variable says now, for the whole process. Throws Error where it names none that is known,
/// or one that this processor does not have.
void choose_instruction_set();

/// The same as a setting of Embree's device: ",isa=avx2"; empty where nothing was chosen.
std::string embree_instruction_set();

} // namespace shadowproof
