#include "compare/output/replaced_folder.h"

#include "compare/output/followed.h"
#include "compare/output/kept.h"
#include "compare/output/passing_file.h"
#include "compare/output/report_place.h"
#include "compare/output/unwritable.h"
#include "scenes/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

constexpr const char* journal_name = "journal";
constexpr const char* progress_name = "progress";

bool is_there(const fs::path& path) {
    return fs::exists(fs::symlink_status(path));
}

fs::path work_folder_of(const fs::path& place) {
    return place.string() + ".writing";
}

fs::path place_of(const fs::path& folder) {
    try {
        return followed(folder);
    } catch (const std::system_error& error) {
        throw unwritable_report(folder, error.code().value());
    }
}

/// Makes the folders above `place`. Returns those that were not there, from the top.
std::vector<fs::path> make_parents(const fs::path& place) {
    std::vector<fs::path> missing;
    for (fs::path at = place.parent_path(); !is_there(at); at = at.parent_path())
        missing.insert(missing.begin(), at);
    for (const fs::path& folder : missing)
        if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) throw_errno();
    return missing;
}

FateOf fate_of_old_content(const fs::path& folder, const std::set<std::string>& replaced) {
    return [manifest = read_manifest(folder).value_or(Manifest()),
            &replaced](const std::string& name, const fs::path& file) {
        if (name == manifest_name || replaced.contains(name)) return Fate::remove;
        return is_as_listed(manifest, name, file) ? Fate::remove : Fate::bring_home;
    };
}

FateOf fate_of_new_content(const JournalRecord& record, bool has_home) {
    return [&record, has_home](const std::string& name, const fs::path& file) {
        if (is_as_listed(record.begun, name, file)) return Fate::remove;
        return has_home && record.kept.contains(name) ? Fate::bring_home : Fate::leave;
    };
}

/// Removes what this run, or one that died, left in the work folder: unfinished new content, and
/// exchanged old content. `replaced`: names of old files that need not be kept though no manifest
/// lists them. Returns what belongs to no report and stays.
std::vector<std::string> empty_work_folder(const fs::path& work, const fs::path& place,
                                           const std::set<std::string>& replaced) {
    const fs::path content = work / "report";
    const fs::path older = work / "older";
    const JournalRecord record = read_journal(work / journal_name);
    remove_leftovers(work, Writers::none);
    std::vector<std::string> left;
    if (is_there(older)) {
        // It was moved away, and nothing has taken its place.
        if (!is_there(place) && ::rename(older.c_str(), place.c_str()) != 0) throw_errno();
        if (is_there(older)) left = empty_out(older, place, fate_of_old_content(older, replaced));
    }
    if (is_there(content)) {
        const bool is_new = !record.folder || identity_of(content) == *record.folder;
        const std::vector<std::string> more =
            empty_out(content, place,
                      is_new ? fate_of_new_content(record, is_there(place))
                             : fate_of_old_content(content, replaced));
        left.insert(left.end(), more.begin(), more.end());
    }
    if (!left.empty()) return left;
    for (const char* own : {progress_name, journal_name})
        if (::unlink((work / own).c_str()) != 0 && errno != ENOENT) throw_errno();
    return left;
}

/// A folder where there is none yet, also under a plain file's name.
void make_folders_for(const fs::path& file) {
    fs::create_directories(file.parent_path());
}

void sync_file_system(const fs::path& folder) {
    const Descriptor opened = open_file(folder, O_RDONLY | O_DIRECTORY);
    if (::syncfs(opened.number()) != 0) throw_errno();
}

/// "a, b, c, d and 3 more"
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
    return text;
}

[[noreturn]] void refuse_left(const fs::path& content, const std::string& what) {
    throw Error(content.string(),
                fmt::format("is left of a run that was cut off, and holds {}, not as this program "
                            "wrote it",
                            what),
                "move it away, or name another folder with --out");
}

/// A foreign folder stands for its contents.
std::vector<std::string> names_to_say(const std::vector<KeptFile>& kept, bool changed) {
    std::vector<std::string> names;
    for (const KeptFile& each : kept) {
        if (each.changed != changed) continue;
        const bool said =
            !names.empty() && names.back().ends_with('/') && each.name.starts_with(names.back());
        if (!said) names.push_back(each.name + (each.is_folder ? "/" : ""));
    }
    return names;
}

/// Whether a kept file stands where the new content has a file, or a folder, or the other way.
bool is_in_the_way(const KeptFile& kept, const Manifest& manifest) {
    if (manifest.contains(kept.name)) return true;
    if (!kept.is_folder && lists_below(manifest, kept.name)) return true;
    for (fs::path above = fs::path(kept.name).parent_path(); !above.empty();
         above = above.parent_path())
        if (manifest.contains(above.string())) return true;
    return false;
}

} // namespace

ReplacedFolder::ReplacedFolder(const fs::path& folder, const std::vector<std::string>& fixed,
                               CutOff cut_off)
    : named_(folder), place_(place_of(folder)), work_(work_folder_of(place_)),
      content_(work_ / "report"), fixed_(fixed), cut_off_(cut_off),
      unfinished_([this] { clean_up(); }) {
    const auto lock = hold_unfinished();
    check_report_place(named_, place_, fixed_);
    try {
        made_parents_ = make_parents(place_);
        lock_ = FolderLock(work_, named_);
        goes_on_ = cut_off_ == CutOff::is_kept && take_over();
        if (!goes_on_) prepare();
    } catch (const std::system_error& error) {
        throw unwritable_report(named_, error.code().value());
    }
}

fs::path ReplacedFolder::progress_file_of(const fs::path& folder) {
    return work_folder_of(place_of(folder)) / progress_name;
}

void ReplacedFolder::begin_anew() {
    const auto lock = hold_unfinished();
    try {
        goes_on_ = false;
        earlier_.clear();
        prepare();
    } catch (const std::system_error& error) {
        throw unwritable_report(named_, error.code().value());
    }
}

/// Whether all that the journal lists is there. Throws Error where there is anything else, and
/// leaves all of it.
bool ReplacedFolder::take_over() {
    const JournalRecord record = read_journal(work_ / journal_name);
    if (is_there(work_ / "older") || !is_there(content_) || !record.folder ||
        identity_of(content_) != *record.folder)
        return false;
    remove_leftovers(work_, Writers::none);
    Manifest intact;
    const std::vector<std::string> left =
        empty_out(content_, place_, [&](const std::string& name, const fs::path& file) {
            // It is made when all else is there.
            if (name == manifest_name && is_as_listed(record.begun, name, file))
                return Fate::remove;
            // One whose end the journal does not have is whole: it has its name only then.
            for (const Manifest* listed : {&record.written, &record.begun})
                if (is_as_listed(*listed, name, file)) intact.insert(*listed->find(name));
            return Fate::leave;
        });
    if (left.size() != intact.size()) {
        std::vector<std::string> foreign = left;
        std::erase_if(foreign, [&](const std::string& name) { return intact.contains(name); });
        refuse_left(content_, listed(foreign));
    }
    const auto is_there_still = [&](const auto& written) { return intact.contains(written.first); };
    if (intact.empty() || !std::ranges::all_of(record.written, is_there_still)) return false;
    journal_ = Journal(work_ / journal_name);
    for (const auto& [name, fingerprint] : intact)
        if (!record.written.contains(name)) journal_.complete(name);
    earlier_ = std::move(intact);
    return true;
}

void ReplacedFolder::prepare() {
    const std::vector<std::string> left = empty_work_folder(work_, place_, {});
    if (!left.empty() || is_there(content_))
        refuse_left(content_, left.empty() ? "a folder" : listed(left));
    if (::mkdir(content_.c_str(), 0777) != 0) throw_errno();
    journal_ = Journal(work_ / journal_name, identity_of(content_));
}

/// Its name is that of the whole file from the beginning, so that what is found under it can be
/// compared with the journal.
void ReplacedFolder::make_whole(const std::string& name, const Fingerprint& fingerprint,
                                PassingFile& file) const {
    if (is_there(content_ / name)) throw std::system_error(EEXIST, std::generic_category());
    journal_.begin(name, fingerprint);
    make_folders_for(content_ / name);
    put_at_place(file, content_ / name);
}

void ReplacedFolder::make_whole(const std::string& name, std::string_view bytes) const {
    PassingFile file = make_passing_file(work_);
    try {
        write_all(file.opened, bytes);
        make_whole(name, fingerprint_of(bytes), file);
    } catch (...) {
        discard(file);
        throw;
    }
}

/// What an earlier process wrote under a name is written again.
void ReplacedFolder::make_room(const std::string& name) const {
    if (!is_name_below(name)) throw std::system_error(EINVAL, std::generic_category());
    if (!earlier_.contains(name)) return;
    if (::unlink((content_ / name).c_str()) != 0 && errno != ENOENT) throw_errno();
    journal_.drop(name);
}

void ReplacedFolder::add(const std::string& name, std::string_view bytes) const {
    try {
        make_room(name);
        make_whole(name, bytes);
        journal_.complete(name);
    } catch (const std::system_error& error) {
        throw unwritable_report(named_ / name, error.code().value());
    }
}

std::string ReplacedFolder::bytes_of(const std::string& name) const {
    try {
        std::string bytes;
        read_pieces(content_ / name, [&](std::string_view piece) { bytes += piece; });
        return bytes;
    } catch (const std::system_error& error) {
        throw unwritable_report(named_ / name, error.code().value());
    }
}

void ReplacedFolder::add_requested(const std::string& name, std::string_view bytes) {
    requested_.insert(name);
    add(name, bytes);
}

ReplacedFolder::GrowingFile::GrowingFile(const ReplacedFolder& folder, std::string name)
    : folder_(&folder), name_(std::move(name)) {
    const auto lock = hold_unfinished();
    try {
        folder.make_room(name_);
        file_ = make_passing_file(folder.work_);
    } catch (const std::system_error& error) {
        throw unwritable_report(folder.named_ / name_, error.code().value());
    }
}

ReplacedFolder::GrowingFile::~GrowingFile() {
    discard(file_);
}

void ReplacedFolder::GrowingFile::write(std::string_view bytes) {
    try {
        write_all(file_.opened, bytes);
    } catch (const std::system_error& error) {
        throw unwritable_report(folder_->named_ / name_, error.code().value());
    }
    fingerprint_.add(bytes);
}

void ReplacedFolder::GrowingFile::end() {
    const auto lock = hold_unfinished();
    try {
        folder_->make_whole(name_, fingerprint_.so_far(), file_);
        folder_->journal_.complete(name_);
    } catch (const std::system_error& error) {
        throw unwritable_report(folder_->named_ / name_, error.code().value());
    }
}

void ReplacedFolder::keep_what_is_foreign(const Manifest& manifest) {
    std::vector<KeptFile> kept = kept_in(place_, read_manifest(place_).value_or(Manifest()));
    std::erase_if(kept, [&](const KeptFile& each) { return requested_.contains(each.name); });
    for (const KeptFile& each : kept)
        if (is_in_the_way(each, manifest)) refuse_in_the_way(named_, each.name);
    for (const KeptFile& each : kept) {
        if (!each.is_folder) journal_.keep(each.name);
        try {
            link_kept(each, place_, content_);
        } catch (const std::system_error& error) {
            throw Error((named_ / each.name).string(),
                        fmt::format("is not of this program, and cannot be kept beside the new "
                                    "report ({})",
                                    error.code().message()),
                        "move it away, or name another folder with --out");
        }
    }
    take_over_folder_modes(kept, place_, content_);
    const std::vector<std::string> foreign = names_to_say(kept, false);
    const std::vector<std::string> changed = names_to_say(kept, true);
    if (!foreign.empty())
        notes_.push_back(fmt::format("{}: kept {}, which this program did not write",
                                     named_.string(), listed(foreign)));
    if (!changed.empty())
        notes_.push_back(fmt::format("{}: kept {}, changed since this program wrote {}",
                                     named_.string(), listed(changed),
                                     changed.size() == 1 ? "it" : "them"));
}

void ReplacedFolder::exchange() {
    const char* const to = place_.c_str();
    if (!is_there(place_)) {
        if (::renameat2(AT_FDCWD, content_.c_str(), AT_FDCWD, to, RENAME_NOREPLACE) == 0) return;
        // rename(2) replaces no folder that holds anything.
        if (!cannot_rename_so(errno) || ::rename(content_.c_str(), to) != 0) throw_errno();
        return;
    }
    if (::renameat2(AT_FDCWD, content_.c_str(), AT_FDCWD, to, RENAME_EXCHANGE) == 0) return;
    if (!cannot_rename_so(errno)) throw_errno();
    const fs::path older = work_ / "older";
    if (::rename(to, older.c_str()) != 0) throw_errno();
    if (::rename(content_.c_str(), to) == 0) return;
    const int reason = errno;
    static_cast<void>(::rename(older.c_str(), to)); // else clean_up() tries again
    throw std::system_error(reason, std::generic_category());
}

void ReplacedFolder::finish() {
    const auto lock = hold_unfinished();
    try {
        const JournalRecord record = read_journal(work_ / journal_name);
        for (const auto& [name, fingerprint] : record.begun) {
            const fs::path file = content_ / name;
            if (record.written.contains(name) || !is_as_listed(record.begun, name, file)) continue;
            // The process that wrote it has died.
            if (::unlink(file.c_str()) != 0) throw_errno();
        }
        check_report_place(named_, place_, fixed_);
        const bool replaces = is_there(place_);
        if (replaces) keep_what_is_foreign(record.written);
        make_whole(manifest_name, to_json(record.written));
        if (replaces) take_over_mode(place_, content_);
        sync_file_system(content_);
        exchange();
        made_parents_.clear();
        sync_folder(place_.parent_path());
    } catch (const std::system_error& error) {
        throw unwritable_report(named_, error.code().value());
    }
    cut_off_ = CutOff::is_removed;
    clean_up();
    if (lock_)
        notes_.push_back(fmt::format("{}: could not be removed whole; the next run into {} tries "
                                     "again",
                                     work_.string(), named_.string()));
}

/// Whether there is something for a later run to go on with.
bool ReplacedFolder::is_worth_keeping() const {
    try {
        return cut_off_ == CutOff::is_kept && !read_journal(work_ / journal_name).written.empty();
    } catch (const std::exception&) {
        return false;
    }
}

void ReplacedFolder::clean_up() {
    if (is_worth_keeping()) return;
    constexpr int tries = 2; // a passing failure must not leave anything behind
    for (int i = 0; i < tries && lock_; ++i) {
        try {
            if (empty_work_folder(work_, place_, requested_).empty()) lock_.give_back();
        } catch (const std::exception&) {
            continue;
        }
    }
    for (auto folder = made_parents_.rbegin(); folder != made_parents_.rend(); ++folder)
        ::rmdir(folder->c_str()); // fails where something is in it
}

} // namespace shadowproof
