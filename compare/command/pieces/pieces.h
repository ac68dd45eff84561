// Work cut into named pieces, so that a crash loses one of them. A worker process does the pieces
// in turn and sends each result to its supervisor. If it crashes or takes too long in a piece, a
// new worker does the same work from its beginning: results that earlier workers sent are taken
// over, and the piece that was lost throws. So whatever is done between pieces must depend on their
// results alone, and be quick.
#pragma once

#include "compare/command/pieces/archive.h"
#include "compare/command/pieces/messages.h"
#include "compare/command/pieces/record.h"
#include "compare/command/process/console.h"
#include "scenes/error.h"

#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace shadowproof {

/// An earlier worker crashed in this piece, or took too long.
struct LostPiece : Error {
    Loss loss;
    std::string why; ///< as in PieceRecord

    LostPiece(const PieceRecord& piece);
};

/// The worker's side. Pieces may lie within pieces: a loss is that of the innermost one, and those
/// around it are done again.
class Pieces {
public:
    /// `record`: what earlier workers did. It must outlive this. The console is muted up to the
    /// last loss: earlier workers have printed those lines already.
    Pieces(int pipe, const WorkRecord& record, Console& console);

    /// The work's result, or that of an earlier worker: either way as it was sent. Throws LostPiece
    /// where a worker was lost in it, and what the work throws.
    template <class Work>
    auto piece(const std::string& name, const Work& work) {
        return piece(name, work, [](const auto&) { return true; });
    }
    /// `is_final`: whether a result holds for a later run, too, that goes on with this one.
    template <class Work, class IsFinal>
    auto piece(const std::string& name, const Work& work, const IsFinal& is_final) {
        using Result = std::decay_t<decltype(work())>;
        const Entered entered = enter(name, 0);
        if (entered.known != nullptr && entered.known->done)
            return unpacked<Result>(entered.known->result);
        bool holds = true;
        const std::string result = within([&] {
            const Result made(work());
            holds = is_final(made);
            return packed(made);
        });
        leave(Message::Kind::done, result, !holds);
        return unpacked<Result>(result);
    }

    /// The same where the result cannot be sent: each worker does it again. `least_seconds`: that
    /// it is given at least, whatever the time limit.
    template <class Work>
    auto step(const std::string& name, const Work& work, double least_seconds = 0) {
        enter(name, least_seconds);
        if constexpr (std::is_void_v<decltype(work())>) {
            within([&] { return work(), 0; });
            leave(Message::Kind::ended, {});
        } else {
            auto result = within([&] { return work(); });
            leave(Message::Kind::ended, {});
            return result;
        }
    }

    /// Sends what the supervisor itself keeps (Supervision::keep).
    void aside(std::string bytes) const;

    /// Whether this worker has not yet come to where the last one was lost.
    bool catching_up() const { return losses_met_ < record_.losses; }

private:
    /// A piece that was begun and has not ended.
    struct Scope {
        const PieceRecord* known; ///< null: no earlier worker has begun it
        std::map<std::string, std::vector<std::size_t>> places; ///< of pieces in it, backwards
        std::size_t count = 0;                                  ///< of pieces in it
    };
    struct Entered {
        const PieceRecord* known;
    };

    int pipe_;
    const WorkRecord& record_;
    Console& console_;
    std::vector<Scope> scopes_;
    std::size_t losses_met_ = 0;

    void open(const PieceRecord* known);
    Entered enter(const std::string& name, double least_seconds);
    void leave(Message::Kind how, std::string bytes, bool for_this_run = false);
    void meet(const PieceRecord& lost);

    template <class Work>
    auto within(const Work& work) {
        try {
            return work();
        } catch (...) {
            leave(Message::Kind::ended, {});
            throw;
        }
    }
};

} // namespace shadowproof
