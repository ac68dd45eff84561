// Writes files that the user names: --json, --junit, -o and the like. Their bytes are made in
// memory first, so that all are written with the same checks.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace shadowproof {

/// A file appears whole or not at all, and is on the disk when this returns. Links are followed,
/// and stay. An existing regular file keeps its mode, and its owner where that is allowed; it is
/// replaced by a new one, so that other hard links to it keep the old content, and extended
/// attributes and access control lists are not taken over. What is no regular file (a device, a
/// pipe, /dev/stdout, /dev/fd/3) is written into. Where the file system takes files without a name
/// (O_TMPFILE), kill -9 leaves nothing behind, unless it comes between the two calls that give the
/// file its name; the next file that is written into that folder removes what is left then. Throws
/// Error naming `file`, with what was there untouched.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The same where the bytes come in parts.
using TakesBytes = std::function<void(std::string_view)>;
using BytesInParts = std::function<void(const TakesBytes&)>;
void write_file(const std::filesystem::path& file, const BytesInParts& bytes);

/// Throws Error naming the file if write_file could not write it now. To be called before the work.
/// Changes nothing.
void check_writable(const std::filesystem::path& file);

/// Whether write_file puts a new file under this name, so that a second one replaces the first;
/// false where it writes into what is there (a device, a pipe, /dev/stdout). Throws Error naming it
/// where it could not be written.
bool is_replaced(const std::filesystem::path& file);

/// Appends to a file to which others append as well, and creates it if there is none. Throws Error
/// naming it.
void append_to_file(const std::filesystem::path& file, std::string_view bytes);

} // namespace shadowproof
