// Messages from a worker, the process that does the work, to its supervisor: what it begins and
// what came of it, so that a crash loses only the piece that crashed.
#pragma once

#include "compare/command/pieces/archive.h"

#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof {

struct Message {
    enum class Kind : std::uint8_t {
        begun,  ///< a piece, within the one that was begun last and has not ended
        ended,  ///< the innermost piece, without a result: another worker would do it again
        done,   ///< the innermost piece; `bytes` are its result
        aside,  ///< what the supervisor itself keeps, in `bytes`
        failed, ///< the work as a whole cannot go on; `bytes` say why
        result, ///< of the work as a whole, in `bytes`
        started ///< by the supervisor, in a WorkLog: a new worker
    };
    Kind kind = Kind::begun;
    std::string bytes{};
    // Of a piece that is begun:
    std::string name{};
    std::uint64_t place = 0;  ///< among those within the same piece
    bool again = false;       ///< an earlier worker has begun it, too
    double least_seconds = 0; ///< that it is given at least, whatever the time limit
    // Of a piece that is done:
    bool for_this_run = false; ///< another run would do it again
};

SHADOWPROOF_SEND_ALL(Message, kind, bytes, name, place, again, least_seconds, for_this_run)

/// Throws Error if the pipe has no reader any more.
void send(int pipe, const Message& message);

/// Reads messages from a pipe as their bytes come.
class MessageReader {
public:
    explicit MessageReader(int pipe) : pipe_(pipe) {}

    /// The next complete message; none if not all of its bytes have arrived. Waits for bytes at
    /// most this long, or for ever if negative.
    std::optional<Message> next(int milliseconds);
    /// The writing end is closed and all messages were read.
    bool at_end() const { return ended_ && !holds_message(); }

private:
    int pipe_;
    std::string bytes_;
    bool ended_ = false;

    bool holds_message() const;
    void read_some(int milliseconds);
};

} // namespace shadowproof
