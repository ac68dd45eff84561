// Many mutated assets through the program itself, as a user would give them:
//   mutate PROGRAM COUNT SEED KEEP FOLDER...
// Takes the .gltf, .glb, .md2 and .png files below the folders, and mutates each anew: its tree and
// geometry, its pictures, its bytes. `verify` at 32x32 must answer each with an exit code of 0 to
// 3, within 20 s and 2 GB, and every message must have a file, a place and a reason; so must
// `normal-map` of pictures. Exits 1 where one did not. Unexplained judgements are listed.
// Mutants that are odd or listed lie in the folder KEEP.
#include "tests/fuzz/campaign.h"

#include <fmt/format.h>

#include <exception>
#include <string>

namespace {

using namespace shadowproof::fuzz;

int report(const CampaignSettings& settings, std::size_t originals,
           const CampaignOutcome& outcome) {
    fmt::print("{} mutants of {} originals, seed {}: {} assets ({} judged, {} refused), "
               "{} pictures ({} became maps)\n",
               settings.count, originals, settings.seed, outcome.assets, outcome.judged,
               outcome.refused, outcome.pictures, outcome.maps);
    for (const auto& [kind, files] : outcome.listed)
        fmt::print("listed: {} of {}, such as {}\n", files.size(), kind, files.front());
    for (const std::string& fault : outcome.faults) fmt::print("fault: {}\n", fault);
    // A campaign in which nothing loads proves nothing.
    const bool proves = outcome.assets < 100 || outcome.judged > outcome.assets / 4;
    if (!proves) fmt::print("fault: hardly any asset was judged\n");
    return outcome.faults.empty() && proves ? 0 : 1;
}

} // namespace

int main(int count, char** arguments) {
    if (count < 6) {
        fmt::print(stderr, "usage: mutate PROGRAM COUNT SEED KEEP FOLDER...\n");
        return 2;
    }
    try {
        const CampaignSettings settings{arguments[1], std::stoul(arguments[2]),
                                        std::stoull(arguments[3]), arguments[4]};
        const std::vector<std::filesystem::path> folders(arguments + 5, arguments + count);
        const std::vector<Original> originals = originals_in(folders);
        return report(settings, originals.size(), run_campaign(settings, originals));
    } catch (const std::exception& error) {
        fmt::print(stderr, "mutate: {}\n", error.what());
        return 2;
    }
}
