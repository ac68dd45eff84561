// Which of the processor's instruction sets the reference uses: the best by default. The
// environment variable SHADOWPROOF_INSTRUCTION_SET selects one (sse2, ssse3, sse4, avx2, avx512, or
// best), so that tests can check that all of them give the same bytes.
#pragma once

#include <string>

namespace shadowproof {

/// Selects the instruction set that the variable names now, for the whole process. Throws Error
/// where it names an unknown one, or one that this processor does not have.
void choose_instruction_set();

/// The name of the one that is used: "AVX2". After choose_instruction_set.
std::string instruction_set_in_use();

/// The same as a setting of Embree's device: ",isa=avx2"; empty where none was selected.
std::string embree_instruction_set();

} // namespace shadowproof
