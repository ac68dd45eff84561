// Replaces the folder of a report in one step. The new folder is written beside its place, in
// DIR.writing/, which holds
//   lock      held by the process that writes; its first line names it
//   journal   what has been written so far, with hashes, for finishing the work or cleaning up
//   .shadowproof-...  a file that is being written, where it cannot be without a name
//   report/   the new content; then, for a moment, the old one that was exchanged for it
//   older/    the old one, where the file system cannot exchange two folders
//   progress  what a caller keeps there for a later run that goes on with this one
#pragma once

#include "compare/output/folder_lock.h"
#include "compare/output/journal.h"
#include "compare/output/passing_file.h"
#include "compare/output/unfinished.h"

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// What becomes of new content when its writing is cut off.
enum class CutOff { is_removed, is_kept };

/// At any moment, even if the process is killed, either the old or the new content is complete at
/// the folder's place. (If the file system cannot exchange two folders, there is a moment without
/// either, which the next run repairs.) Files that this program did not write stay at their place.
/// Nothing is left behind if this is destroyed before finish(), or if a signal ends the program;
/// unless what is cut off is kept, and there is something to keep.
class ReplacedFolder {
public:
    /// `fixed`: names of files that the new content will have in any case, manifest.json not among
    /// them. Where what is cut off is kept, goes on with what an earlier process has left, if all
    /// of that is as it was written. Throws Error where the folder must not be replaced, where
    /// another process is writing it, and where it cannot be written.
    ReplacedFolder(const std::filesystem::path& folder, const std::vector<std::string>& fixed,
                   CutOff cut_off = CutOff::is_removed);
    ReplacedFolder(const ReplacedFolder&) = delete;
    ReplacedFolder& operator=(const ReplacedFolder&) = delete;
    ~ReplacedFolder() = default;

    /// Whether it holds content that an earlier process has written.
    bool goes_on() const { return goes_on_; }
    /// Removes that content.
    void begin_anew();
    /// A file beside the content, for the caller to say how far it has come. It is removed with the
    /// content, or when that is finished.
    std::filesystem::path progress_file() const { return progress_file_of(place_); }
    /// The same for a folder that nothing writes.
    static std::filesystem::path progress_file_of(const std::filesystem::path& folder);

    /// Writes a file of the new content; `name` is relative to the folder, with slashes. For
    /// several threads, and processes forked from the one that made this. Throws Error naming the
    /// file, also if that name was added already, but by an earlier process.
    void add(const std::string& name, std::string_view bytes) const;
    /// The same for a file that the user asked for by its name: it replaces what has that name.
    void add_requested(const std::string& name, std::string_view bytes);

    /// A file whose bytes come in parts. Nothing is left of one that is not ended.
    class GrowingFile {
    public:
        ~GrowingFile();
        GrowingFile(GrowingFile&&) noexcept = default;
        GrowingFile& operator=(GrowingFile&&) = delete;
        /// Both throw Error naming the file.
        void write(std::string_view bytes);
        void end();

    private:
        friend class ReplacedFolder;
        GrowingFile(const ReplacedFolder& folder, std::string name);

        const ReplacedFolder* folder_;
        std::string name_;
        PassingFile file_;
        GrowingFingerprint fingerprint_;
    };
    GrowingFile grow(const std::string& name) const { return {*this, name}; }
    GrowingFile grow_requested(const std::string& name) {
        requested_.insert(name);
        return grow(name);
    }

    /// The bytes of a file that was added. Throws Error where it cannot be read.
    std::string bytes_of(const std::string& name) const;

    /// Puts the new content in its place, with manifest.json, and removes the old one. Only by the
    /// process that made this. If it throws Error, the old content is untouched.
    void finish();

    /// Messages for the user: files that were kept.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    void prepare();
    bool take_over();
    void make_whole(const std::string& name, std::string_view bytes) const;
    void make_whole(const std::string& name, const Fingerprint& fingerprint,
                    PassingFile& file) const;
    void make_room(const std::string& name) const;
    void keep_what_is_foreign(const Manifest& manifest);
    void exchange();
    bool is_worth_keeping() const;
    void clean_up();

    std::filesystem::path named_; ///< as the user gave it
    std::filesystem::path place_; ///< without links
    std::filesystem::path work_;
    std::filesystem::path content_;                   ///< work_/report
    std::vector<std::filesystem::path> made_parents_; ///< folders that were made for it
    std::vector<std::string> fixed_;
    CutOff cut_off_;
    bool goes_on_ = false;
    Manifest earlier_; ///< files that an earlier process has written
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
