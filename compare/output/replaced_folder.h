// Replaces the folder of a report in one step. The new folder is written beside its place, in
// DIR.writing/, which holds
//   lock      held by the process that writes; its first line names it
//   journal   what has been written so far, with hashes, for finishing the work or cleaning up
//   .shadowproof-...  a file that is being written, where it cannot be without a name
//   report/   the new content; then, for a moment, the old one that was exchanged for it
//   older/    the old one, where the file system cannot exchange two folders
#pragma once

#include "compare/output/folder_lock.h"
#include "compare/output/journal.h"
#include "compare/output/unfinished.h"

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// At any moment, even if the process is killed, either the old or the new content is complete at
/// the folder's place. (If the file system cannot exchange two folders, there is a moment without
/// either, which the next run repairs.) Files that this program did not write stay at their place.
/// Nothing is left behind if this is destroyed before finish(), or if a signal ends the program.
class ReplacedFolder {
public:
    /// `fixed`: names of files that the new content will have in any case, manifest.json not among
    /// them. Throws Error where the folder must not be replaced, where another process is writing
    /// it, and where it cannot be written.
    ReplacedFolder(const std::filesystem::path& folder, const std::vector<std::string>& fixed);
    ReplacedFolder(const ReplacedFolder&) = delete;
    ReplacedFolder& operator=(const ReplacedFolder&) = delete;
    ~ReplacedFolder() = default;

    /// Writes a file of the new content; `name` is relative to the folder, with slashes. For
    /// several threads, and processes forked from the one that made this. Throws Error naming the
    /// file, also if that name was added already.
    void add(const std::string& name, std::string_view bytes) const;
    /// The same for a file that the user asked for by its name: it replaces what has that name.
    void add_requested(const std::string& name, std::string_view bytes);

    /// What has been added so far.
    Manifest added() const;
    /// The bytes of a file that was added. Both throw Error where it cannot be read, or removed.
    std::string bytes_of(const std::string& name) const;
    /// Removes a file that was added; its name is free again.
    void remove(const std::string& name) const;

    /// Puts the new content in its place, with manifest.json, and removes the old one. Only by the
    /// process that made this. If it throws Error, the old content is untouched.
    void finish();

    /// Messages for the user: files that were kept.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    void prepare();
    void make_whole(const std::string& name, std::string_view bytes) const;
    void keep_what_is_foreign(const Manifest& manifest);
    void exchange();
    void clean_up();

    std::filesystem::path named_; ///< as the user gave it
    std::filesystem::path place_; ///< without links
    std::filesystem::path work_;
    std::filesystem::path content_;                   ///< work_/report
    std::vector<std::filesystem::path> made_parents_; ///< folders that were made for it
    std::vector<std::string> fixed_;
    std::set<std::string> requested_;
    std::vector<std::string> notes_;
    FolderLock lock_;
    Journal journal_;
    Unfinished unfinished_; ///< last: its removal needs all the others
};

/// What lies below a folder of the new content: "pictures/", or all of it where that is empty.
struct FolderPart {
    const ReplacedFolder& whole;
    std::string below{};

    /// As ReplacedFolder::add; `name` is relative to this part.
    void add(const std::string& name, std::string_view bytes) const {
        whole.add(below + name, bytes);
    }
};

} // namespace shadowproof
