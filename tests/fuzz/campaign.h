// Runs the program itself on mutated assets, many in one call, and again on each odd one alone.
#pragma once

#include "tests/fuzz/mutants.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace shadowproof::fuzz {

struct CampaignSettings {
    std::string program;
    std::size_t count = 0; ///< of mutants
    std::uint64_t seed = 0;
    std::filesystem::path keep; ///< folder for mutants that are odd or listed
};

struct CampaignOutcome {
    std::size_t assets = 0;
    std::size_t judged = 0;   ///< of them, by at least one technique
    std::size_t refused = 0;  ///< of them, in a sentence
    std::size_t pictures = 0; ///< through normal-map
    std::size_t maps = 0;     ///< of them, made
    /// A signal, another exit code than 0 to 3, too much time or memory, a message without file,
    /// place and reason: a sentence each, with the file that was kept.
    std::vector<std::string> faults;
    /// Judgements to look at: "zfail_reversed unexplained", the files.
    std::map<std::string, std::vector<std::string>> listed;
};

CampaignOutcome run_campaign(const CampaignSettings& settings, std::span<const Original> originals);

} // namespace shadowproof::fuzz
