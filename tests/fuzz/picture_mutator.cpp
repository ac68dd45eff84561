// Of the picture target: PNG by its chunks, JPEG by bytes.
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/png_mutation.h"

using shadowproof::Dice;
using namespace shadowproof::fuzz;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size,
                                               std::size_t most, unsigned seed) {
    Dice dice(seed);
    auto chunks = dice.one_in(8) ? std::nullopt : read_png({bytes, size});
    if (!chunks) return LLVMFuzzerMutate(bytes, size, most);
    for (std::size_t n = 1 + dice.below(3); n > 0; --n) mutate_png(*chunks, dice);
    return hand_over(written(*chunks), bytes, size, most);
}
