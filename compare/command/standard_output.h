// What a command prints. Output that gets lost is an error: a build server that reads half of it
// must not hear that all went well.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace shadowproof {

/// Standard output cannot be written. No Error, which may be one scene's own: it ends the run.
struct OutputLost : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Opens what of standard input, output and error is closed, so that no file of ours gets its
/// number: input is empty, errors go nowhere, and output is lost, which print() says. To be called
/// first.
void open_standard_streams();

/// Writes text to standard output at once. Throws OutputLost.
void print(std::string_view text);

/// "shadowproof: ..." on standard error, printable. Never throws: nobody would hear of it.
void complain(std::string_view message) noexcept;

} // namespace shadowproof
