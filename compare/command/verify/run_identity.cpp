#include "compare/command/verify/run_identity.h"

#include "compare/output/manifest.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

/// Hash of a file; of none where no file is named.
std::string hash_of(const fs::path& file) {
    if (file.empty()) return {};
    try {
        return fingerprint_of(fs::canonical(file)).xxh3;
    } catch (const std::system_error& error) {
        throw Error(file.string(), fmt::format("cannot be read ({})", error.code().message()),
                    "check its permissions");
    }
}

/// A run that is given more time is the same.
std::vector<std::string> without_time_limit(std::vector<std::string> words) {
    const auto limit = std::ranges::find(words, "--timeout");
    if (limit != words.end()) words.erase(limit, limit + 2);
    return words;
}

} // namespace

ResultsJson run_identity(const VerifyOptions& options, const std::vector<std::string>& arguments) {
    ResultsJson identity{{"scenes", scenes_to_verify(options)},
                         {"techniques", ResultsJson::array()}};
    for (const Technique* technique : options.technique.chosen())
        identity["techniques"].push_back(technique->name);
    identity["named"] = !options.scenes.empty() && !options.technique.techniques.empty();
    identity["settings"] = without_time_limit(arguments);
    identity["witness"] = options.witness;
    identity["baseline"] = hash_of(results_path(options.gate.baseline));
    identity["costs"] = hash_of(results_path(options.costs));
    return identity;
}

std::string run_name(ResultsJson identity, const std::string& plan) {
    identity["plan"] = plan;
    return fingerprint_of(std::string_view(results_text(identity))).xxh3.substr(0, 16);
}

std::string process_identity(ResultsJson identity, const VerifyOptions& options) {
    if (options.shard)
        identity["shard"] = fmt::format("{}/{}", options.shard->number, options.shard->of);
    identity["program"] = hash_of("/proc/self/exe");
    return results_text(identity);
}

void require_same_process(const std::string& out, const std::string& cut_off,
                          const std::string& now) {
    if (cut_off == now) return;
    const ResultsJson was = ResultsJson::parse(cut_off, nullptr, false);
    const ResultsJson is = ResultsJson::parse(now);
    std::string what = "not by the same command";
    for (const char* member :
         {"scenes", "techniques", "settings", "shard", "witness", "baseline", "costs", "program"}) {
        const ResultsJson before =
            was.is_object() ? was.value(member, ResultsJson()) : ResultsJson();
        const ResultsJson now_is = is.value(member, ResultsJson());
        if (before == now_is) continue;
        what = fmt::format("with other {} ({}, and now {})", member,
                           before.is_null() ? "none" : shown(before),
                           now_is.is_null() ? "none" : shown(now_is));
        break;
    }
    throw Error(out, "cannot be gone on with: the run that was cut off was begun " + what,
                "leave out --resume, and all is tried anew");
}

} // namespace shadowproof
