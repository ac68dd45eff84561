// Standard output of the commands. Lost output is an error: a build server that reads half of it
// must not see success.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace shadowproof {

/// Standard output cannot be written. Not an Error, which may concern one scene only: this ends the
/// run.
struct OutputLost : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Opens those of standard input, output and error that are closed, so that no other file gets
/// their numbers. Input is then empty, errors are discarded, and print() throws. To be called
/// first.
void open_standard_streams();

/// Writes text to standard output at once. Throws OutputLost.
void print(std::string_view text);

/// "shadowproof: ..." on standard error, printable. Never throws.
void complain(std::string_view message) noexcept;

} // namespace shadowproof
