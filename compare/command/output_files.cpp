#include "compare/command/output_files.h"

#include "compare/output/followed.h"
#include "compare/output/manifest.h"
#include "compare/output/write_file.h"
#include "compare/report/report.h"
#include "scenes/error.h"

#include <filesystem>
#include <system_error>

namespace shadowproof {

namespace fs = std::filesystem;

std::optional<std::string> name_in_report(const std::string& file, const std::string& out) {
    if (file.empty()) return std::nullopt;
    try {
        if (open_descriptor(file)) return std::nullopt;
        const fs::path relative = followed(file).lexically_relative(followed(out));
        if (relative.empty() || *relative.begin() == ".." || *relative.begin() == ".")
            return std::nullopt;
        return relative.generic_string();
    } catch (const std::system_error&) {
        return std::nullopt; // check_writable says why
    }
}

void check_output(const std::string& file, const std::string& out, Output output) {
    if (file.empty()) return;
    const std::optional<std::string> name = name_in_report(file, out);
    if (!name) return check_writable(file);
    const bool is_results = *name == results_name;
    if ((is_results && output != Output::results) || *name == page_name ||
        *name == results_script_name || *name == manifest_name)
        throw Error(file, "is a file of the report itself", "name another file");
    if (const std::string kind = fs::path(*name).extension(); kind == ".png" || kind == ".js")
        throw Error(file, "is named as the report's own pictures and data are",
                    "name another file");
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(fs::path(out) / *name, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw Error(file, "lies in the report's folder, and is no regular file",
                    "name a file elsewhere");
}

namespace {

/// Whether two names lead to one file on disk; devices do not count. A name that cannot be resolved
/// is no output: check_writable says why.
bool are_one(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    try {
        if (open_descriptor(a) || open_descriptor(b)) return false;
        if (fs::exists(a) && !fs::is_regular_file(a) && !fs::is_directory(a)) return false;
        if (fs::exists(a) && fs::exists(b)) return fs::equivalent(a, b);
        return followed(a) == followed(b);
    } catch (const std::system_error&) {
        return false;
    }
}

} // namespace

void check_apart(std::span<const std::string> written, std::span<const std::string> read) {
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k)
            if (are_one(written[i], written[k]))
                throw Error(written[i], "is named for two outputs", "name another file for one");
        std::error_code ignored;
        for (const std::string& file : read)
            // Else it is the name of a bundled scene.
            if (fs::is_regular_file(file, ignored) && are_one(written[i], file))
                throw Error(written[i], "is read, and would be lost", "name another file");
    }
}

} // namespace shadowproof
