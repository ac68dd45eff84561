#include "reference/witness/agreement.h"

#include "reference/parallel.h"
#include "reference/witness/witness.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace shadowproof {

namespace {

/// So many of the candidates, evenly spread.
std::vector<std::size_t> spread(const std::vector<std::size_t>& candidates, std::size_t count) {
    if (candidates.size() <= count) return candidates;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(candidates[i * candidates.size() / count]);
    return chosen;
}

std::vector<std::size_t> undecided_pixels(const GroundTruth& truth) {
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < truth.exactness.pixels.size(); ++i)
        if (truth.exactness.pixels[i] != Exactness::filtered) pixels.push_back(i);
    return pixels;
}

/// All different, in order.
std::vector<std::size_t> pixels_to_ask(const GroundTruth& truth, std::size_t count) {
    const std::size_t all = truth.visibility.pixels.size();
    std::vector<std::size_t> chosen(all);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    if (count >= all) return chosen;
    chosen = spread(undecided_pixels(truth), count / 2);
    std::vector<std::uint8_t> taken(all, 0);
    for (const std::size_t pixel : chosen) taken[pixel] = 1;
    std::mt19937_64 random; // its sequence is the same everywhere, unlike that of distributions
    while (chosen.size() < count) {
        const std::size_t pixel = random() % all;
        if (taken[pixel] != 0) continue;
        taken[pixel] = 1;
        chosen.push_back(pixel);
    }
    std::ranges::sort(chosen);
    return chosen;
}

} // namespace

Agreement ask_witness(const Scene& scene, const GroundTruth& truth, std::uint64_t pixels,
                      int threads) {
    const witness::Witness witness(scene);
    const std::vector<std::size_t> asked = pixels_to_ask(truth, static_cast<std::size_t>(pixels));
    std::vector<witness::Answer> answers(asked.size());
    const auto width = static_cast<std::size_t>(truth.visibility.width);
    parallel_for(static_cast<int>(asked.size()), thread_count(threads), [&](int piece, int) {
        const auto i = static_cast<std::size_t>(piece);
        const double x = static_cast<double>(asked[i] % width) + 0.5;
        const double y = static_cast<double>(asked[i] / width) + 0.5;
        answers[i] = witness.look(line_of_sight(scene.camera, x, y));
        answers[i].hit = {}; // a long rational each
    });
    Agreement agreement{.asked = asked.size()};
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::size_t pixel = asked[i];
        agreement.undecided += truth.exactness.pixels[pixel] != Exactness::filtered ? 1 : 0;
        if (answers[i].visibility == truth.visibility.pixels[pixel] &&
            answers[i].triangle == truth.triangle.pixels[pixel])
            continue;
        ++agreement.disagreements;
        if (!agreement.first)
            agreement.first = {.x = static_cast<int>(pixel % width),
                               .y = static_cast<int>(pixel / width),
                               .truth = truth.visibility.pixels[pixel],
                               .witness = answers[i].visibility,
                               .truth_triangle = truth.triangle.pixels[pixel],
                               .witness_triangle = answers[i].triangle};
    }
    return agreement;
}

std::string words_of(const Agreement& agreement) {
    const std::string asked =
        fmt::format("{} pixels decided again by the witness, {} of them undecided by filters: ",
                    agreement.asked, agreement.undecided);
    if (!agreement.first) return asked + "all agree";
    const Disagreement& first = *agreement.first;
    const auto triangle = [](std::uint32_t number) {
        return number == no_triangle ? std::string("nothing") : fmt::format("triangle {}", number);
    };
    return asked + fmt::format("{} disagree, the first at ({},{}), where the truth sees {}, {}, "
                               "and the witness {}, {}",
                               agreement.disagreements, first.x, first.y,
                               triangle(first.truth_triangle), name_of(first.truth),
                               triangle(first.witness_triangle), name_of(first.witness));
}

} // namespace shadowproof
