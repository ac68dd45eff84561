// Of the results target: the trees of both texts.
#include "compare/results/results_file.h"
#include "tests/fuzz/json_mutation.h"
#include "tests/fuzz/mutator.h"

#include <array>
#include <string>

using shadowproof::Dice;
using namespace shadowproof::fuzz;

namespace {

constexpr std::array<std::string_view, 48> words{"schema",
                                                 "shadowproof/results/1",
                                                 "format",
                                                 "scenes",
                                                 "name",
                                                 "file",
                                                 "folder",
                                                 "width",
                                                 "height",
                                                 "digest",
                                                 "0123456789abcdef",
                                                 "triangles",
                                                 "light",
                                                 "provokes",
                                                 "no_longer_provoked",
                                                 "left_out",
                                                 "notes",
                                                 "reference",
                                                 "images",
                                                 "techniques",
                                                 "truth",
                                                 "color",
                                                 "claim",
                                                 "difference",
                                                 "cause",
                                                 "volumes",
                                                 "verdict",
                                                 "agrees",
                                                 "defect",
                                                 "unexplained",
                                                 "fails_as_predicted",
                                                 "pixels",
                                                 "differing",
                                                 "causes",
                                                 "first",
                                                 "ledger",
                                                 "cause_map",
                                                 "since",
                                                 "error",
                                                 "passed",
                                                 "baseline",
                                                 "gate",
                                                 "allow",
                                                 "near_plane",
                                                 "edge",
                                                 "..",
                                                 "../../x",
                                                 "zpass"};

std::string mutated(const std::string& text, Dice& dice) {
    using Json = shadowproof::ResultsJson;
    Json tree = Json::parse(text, nullptr, false);
    if (tree.is_discarded()) return {};
    for (std::size_t n = 1 + dice.below(2); n > 0; --n) mutate_json(tree, words, dice);
    return tree.dump(1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size,
                                               std::size_t most, unsigned seed) {
    Dice dice(seed);
    const std::string both(reinterpret_cast<const char*>(bytes), size);
    const std::size_t end = both.find('\0');
    const std::string first = both.substr(0, end);
    const std::string second = end == std::string::npos ? "" : both.substr(end + 1);
    const bool of_first = second.empty() || dice.one_in(2);
    std::string changed = dice.one_in(8) ? "" : mutated(of_first ? first : second, dice);
    if (changed.empty()) return LLVMFuzzerMutate(bytes, size, most);
    if (second.empty() && dice.one_in(4))
        changed = first + '\0' + changed;
    else if (!second.empty())
        changed = of_first ? changed + '\0' + second : first + '\0' + changed;
    return hand_over({changed.begin(), changed.end()}, bytes, size, most);
}
