// Of the glTF target: the tree and the geometry, now and then plain bytes.
#include "tests/fuzz/gltf_mutation.h"
#include "tests/fuzz/mutator.h"

using shadowproof::Dice;
using namespace shadowproof::fuzz;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size,
                                               std::size_t most, unsigned seed) {
    Dice dice(seed);
    auto asset = dice.one_in(8) ? std::nullopt : read_asset({bytes, size});
    if (!asset) return LLVMFuzzerMutate(bytes, size, most);
    for (std::size_t n = 1 + dice.below(3); n > 0; --n) mutate_gltf(*asset, dice);
    return hand_over(written(*asset), bytes, size, most);
}
