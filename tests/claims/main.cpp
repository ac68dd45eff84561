// Writes the page of claims to the console; or, with --check FILE, fails where a page written
// before says something else (but for times, which every run has its own of).
//   build/dev/tests/claims/shadowproof_claims > docs/claims.md
#include "scenes/error.h"
#include "tests/claims/bump_claims.h"
#include "tests/claims/filter_claims.h"
#include "tests/claims/map_claims.h"
#include "tests/claims/reach_claims.h"
#include "tests/claims/volume_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr const char* heading =
    "# What the documents claim\n\n"
    "Kilgard's talk on hardware rendering (2001), Stanford's lecture on bump mapping and shadows\n"
    "(CS448), the lecture VGP353 and the paper on omni-directional shadows with geometry shaders\n"
    "claim more than they show, of bump mapping and of shadow maps against shadow volumes. Each\n"
    "claim is measured here on the bundled scenes, at 512x512, with OSMesa. This page is written "
    "by `build/dev/tests/claims/shadowproof_claims > "
    "docs/claims.md`,\n"
    "and a test (`claims_page`) holds it against a new run.\n";

using shadowproof::claims::Section;

std::vector<Section> all_claims() {
    std::vector<Section> all = shadowproof::claims::bump_claims();
    std::ranges::move(shadowproof::claims::filter_claims(), std::back_inserter(all));
    std::ranges::move(shadowproof::claims::volume_claims(), std::back_inserter(all));
    std::ranges::move(shadowproof::claims::reach_claims(), std::back_inserter(all));
    std::ranges::move(shadowproof::claims::map_claims(), std::back_inserter(all));
    return all;
}

int check(const std::string& file) {
    std::ifstream stream(file);
    const std::string page(std::istreambuf_iterator<char>(stream), {});
    int missing = 0;
    for (const Section& section : all_claims()) {
        const std::string text = fmt::format("## {}\n\n{}", section.title, section.text);
        if (page.find(text) != std::string::npos) continue;
        fmt::print(stderr, "{} does not say, as this run does:\n{}\n", file, text);
        ++missing;
    }
    return missing == 0 ? 0 : 1;
}

int write() {
    std::string page = heading;
    for (const Section& section : all_claims()) {
        page += fmt::format("\n## {}\n\n{}", section.title, section.text);
        if (!section.timing.empty()) page += "\n" + section.timing;
    }
    fmt::print("{}", page);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        const bool checks = argc == 3 && std::string(argv[1]) == "--check";
        if (argc == 1 || checks) return checks ? check(argv[2]) : write();
        fmt::print(stderr, "usage: shadowproof_claims [--check FILE]\n");
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 3;
    }
}
