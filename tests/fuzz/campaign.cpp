#include "tests/fuzz/campaign.h"

#include "tests/fuzz/child.h"
#include "tests/fuzz/promises.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>

namespace shadowproof::fuzz {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t files_a_call = 40;
constexpr double most_seconds = 20; ///< of processor time, for one asset
constexpr std::uint64_t most_memory = 2'000'000'000;
constexpr const char* techniques = "zfail_reversed,bump_tangent_space";

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class Campaign {
public:
    Campaign(const CampaignSettings& settings, std::span<const Original> originals)
        : settings_(settings), originals_(originals), dice_(settings.seed),
          folder_(fs::temp_directory_path() / fmt::format("shadowproof-mutate-{}", getpid())) {
        fs::create_directories(folder_);
        fs::create_directories(settings_.keep);
    }
    ~Campaign() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Campaign(const Campaign&) = delete;
    Campaign& operator=(const Campaign&) = delete;

    CampaignOutcome run() {
        std::vector<fs::path> assets;
        for (std::size_t i = 0; i < settings_.count; ++i) {
            const Original& original = originals_[dice_.below(originals_.size())];
            const fs::path file = folder_ / fmt::format("m{}{}", i, original.extension);
            const FileBytes bytes = mutated(original, dice_);
            std::ofstream(file, std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
            if (original.extension == ".png")
                try_picture(file);
            else
                assets.push_back(file);
            if (assets.size() == files_a_call) try_assets(std::exchange(assets, {}));
        }
        if (!assets.empty()) try_assets(assets);
        return std::move(outcome_);
    }

private:
    fs::path kept(const fs::path& file) const {
        const fs::path to =
            settings_.keep / fmt::format("{}-{}", settings_.seed, file.filename().string());
        fs::copy_file(file, to, fs::copy_options::overwrite_existing);
        return to;
    }
    void fault(const fs::path& file, const std::string& what) {
        outcome_.faults.push_back(fmt::format("{}: {}", kept(file).string(), what));
    }

    /// What is wrong with how the program ended, and with what it said of the files.
    std::optional<std::string> fault_of(const ChildResult& result,
                                        const std::vector<fs::path>& files) const {
        if (result.timed_out) return "takes longer than the limit";
        if (result.signal != 0) return fmt::format("ends by signal {}", result.signal);
        if (result.exit_code < 0 || result.exit_code > 3)
            return fmt::format("ends with exit code {}", result.exit_code);
        if (result.processor_seconds > most_seconds)
            return fmt::format("takes {:.0f} s of processor time", result.processor_seconds);
        if (result.most_memory > most_memory)
            return fmt::format("takes {:.1f} GB", static_cast<double>(result.most_memory) * 1e-9);
        std::istringstream lines(text_of(folder_ / "stderr"));
        for (std::string line; std::getline(lines, line);)
            if (auto fault = fault_of_line(line, files)) return *fault + ": " + line.substr(0, 300);
        return std::nullopt;
    }

    /// "shadowproof: FILE PLACE: REASON; REMEDY"
    static std::optional<std::string> fault_of_line(const std::string& line,
                                                    const std::vector<fs::path>& files) {
        const std::string program = "shadowproof: ";
        if (!line.starts_with(program)) return "a line on standard error is no message";
        const std::string message = line.substr(program.size());
        const bool names_one = std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
            return message.starts_with(file.string());
        });
        if (!names_one) return "a message names no file";
        return fault_of_message(message, "");
    }

    ChildResult verify(const std::vector<fs::path>& files, const ChildLimits& limits) const {
        std::vector<std::string> command{settings_.program, "verify"};
        for (const fs::path& file : files) command.push_back(file.string());
        for (const std::string& word :
             {std::string("--size"), std::string("32x32"), std::string("--technique"),
              std::string(techniques), std::string("--out"), (folder_ / "report").string()})
            command.push_back(word);
        std::error_code ignored;
        fs::remove_all(folder_ / "report", ignored);
        return run_child(command, folder_ / "stdout", folder_ / "stderr", limits);
    }

    void try_assets(const std::vector<fs::path>& files) {
        outcome_.assets += files.size();
        const ChildResult all = verify(files, {.processor_seconds = 60, .wall_seconds = 600});
        const auto odd = fault_of(all, files);
        if (odd)
            try_each(files, *odd);
        else
            read_results(files);
        for (const fs::path& file : files) fs::remove(file);
    }

    /// `together`: what was odd when all of them were given to one call.
    void try_each(const std::vector<fs::path>& files, const std::string& together) {
        const std::size_t faults_before = outcome_.faults.size();
        for (const fs::path& file : files) {
            const ChildResult one = verify({file}, {});
            if (const auto odd = fault_of(one, {file}))
                fault(file, *odd);
            else
                read_results({file});
        }
        // Many together may take what one may not.
        if (outcome_.faults.size() == faults_before && !together.starts_with("takes"))
            fault(files.front(), "only together with those that follow it: " + together);
    }

    /// Counts and lists what the report says; messages in it must have a shape as well.
    void read_results(const std::vector<fs::path>& files) {
        const json results =
            json::parse(text_of(folder_ / "report" / "results.json"), nullptr, false);
        if (!results.is_object()) return fault(files.front(), "leaves no results.json");
        std::set<std::string> left;
        for (const fs::path& file : files) left.insert(file.string());
        for (const json& scene : results["scenes"]) {
            const fs::path file = scene["file"].get<std::string>();
            left.erase(file.string());
            if (scene.contains("error")) {
                ++outcome_.refused;
                check_error(file, scene["error"].get<std::string>(), file.string());
                continue;
            }
            bool judged = false;
            for (const json& cell : scene["techniques"]) judged |= read_cell(file, cell);
            outcome_.judged += judged ? 1 : 0;
        }
        if (!left.empty()) fault(*left.begin(), "is missing in the results");
    }

    bool read_cell(const fs::path& file, const json& cell) {
        const auto name = cell["name"].get<std::string>();
        if (cell.contains("error")) {
            const auto error = cell["error"].get<std::string>();
            check_error(file, error, "");
            if (error.find("has no bump map") == std::string::npos &&
                error.find("environment") == std::string::npos)
                list(file, name + " could not run");
            return false;
        }
        const json& verdict = cell["verdict"];
        if (verdict == "unexplained" || verdict == "defect") {
            std::string kind = name + " " + verdict.get<std::string>();
            for (const auto& [cause, pixels] : cell["causes"].items())
                if (cause != "edge") kind += " " + cause;
            if (cell["ledger"]["unexplained"] > 0) kind += " counters";
            list(file, kind);
        }
        return true;
    }

    void check_error(const fs::path& file, const std::string& error, const std::string& where) {
        if (const auto wrong = fault_of_message(error, where))
            fault(file, *wrong + ": " + error.substr(0, 300));
    }

    void list(const fs::path& file, const std::string& kind) {
        constexpr std::size_t most_kept = 5;
        std::vector<std::string>& files = outcome_.listed[kind];
        files.push_back(files.size() < most_kept ? kept(file).string() : file.filename().string());
    }

    void try_picture(const fs::path& file) {
        ++outcome_.pictures;
        const ChildResult result = run_child(
            {settings_.program, "normal-map", file.string(), "-o", (folder_ / "map.png").string()},
            folder_ / "stdout", folder_ / "stderr", {});
        outcome_.maps += result.exit_code == 0 ? 1 : 0;
        if (const auto odd = fault_of(result, {file})) fault(file, *odd);
        fs::remove(file);
    }

    const CampaignSettings& settings_;
    std::span<const Original> originals_;
    Dice dice_;
    fs::path folder_;
    CampaignOutcome outcome_;
};

} // namespace

CampaignOutcome run_campaign(const CampaignSettings& settings,
                             std::span<const Original> originals) {
    return Campaign(settings, originals).run();
}

} // namespace shadowproof::fuzz
