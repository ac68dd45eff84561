// Of the target that goes the whole way: scenes that mostly load.
#include "tests/fuzz/gltf_mutation.h"
#include "tests/fuzz/mutator.h"

using shadowproof::Dice;
using namespace shadowproof::fuzz;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size,
                                               std::size_t most, unsigned seed) {
    Dice dice(seed);
    auto asset = read_asset({bytes, size});
    if (!asset) return LLVMFuzzerMutate(bytes, size, most);
    for (std::size_t n = 1 + dice.below(4); n > 0; --n) move_scene(*asset, dice);
    if (dice.one_in(20)) mutate_gltf(*asset, dice);
    return hand_over(written(*asset), bytes, size, most);
}
