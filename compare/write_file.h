// A file appears whole or not at all: it is written beside its place and renamed into it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace shadowproof {

/// Calls `write` with a path beside `file`, and renames what it wrote into place. Whatever `write`
/// throws passes through, with nothing left behind. Throws Error where the renaming fails.
void write_beside(const std::filesystem::path& file,
                  const std::function<void(const std::filesystem::path&)>& write);

/// Text by write_beside.
void write_file(const std::filesystem::path& file, const std::string& text);

/// Text at its place, for what lies in a folder that is itself unfinished. Throws Error naming the
/// file.
void write_text(const std::filesystem::path& file, const std::string& text);

/// Throws Error, naming the file, where write_beside could not write it now: for asking before
/// the work, not after.
void check_writable(const std::filesystem::path& file);

} // namespace shadowproof
