// A fuzz target: what one input is put through. libFuzzer calls it with inputs of its making, the
// replay with those that are kept.
#pragma once

#include <cstddef>
#include <cstdint>

/// 0: the input may join the corpus; -1: it may not. Broken promises abort.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
