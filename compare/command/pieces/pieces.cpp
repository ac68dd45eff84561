#include "compare/command/pieces/pieces.h"

#include <algorithm>
#include <utility>

namespace shadowproof {

namespace {

const char* remedy_for(Loss loss) {
    return loss == Loss::timed_out
               ? "give it more seconds (0: any number), a smaller --size, or a simpler scene"
               : "report this with the command; all else was tried all the same";
}

} // namespace

LostPiece::LostPiece(const PieceRecord& piece)
    : Error(piece.name, piece.why, remedy_for(piece.loss)), loss(piece.loss), why(piece.why) {}

Pieces::Pieces(int pipe, const WorkRecord& record, Console& console)
    : pipe_(pipe), record_(record), console_(console) {
    open(&record.whole);
    console_.mute(catching_up());
}

void Pieces::open(const PieceRecord* known) {
    Scope& scope = scopes_.emplace_back(Scope{.known = known, .places = {}});
    if (known == nullptr) return;
    scope.count = known->inner.size();
    for (std::size_t i = scope.count; i-- > 0;) scope.places[known->inner[i].name].push_back(i);
}

Pieces::Entered Pieces::enter(const std::string& name, double least_seconds) {
    Scope& around = scopes_.back();
    const PieceRecord* known = nullptr;
    std::size_t place = around.count;
    if (const auto found = around.places.find(name);
        found != around.places.end() && !found->second.empty()) {
        place = found->second.back();
        found->second.pop_back();
        known = &around.known->inner[place];
    } else {
        ++around.count;
    }
    if (known != nullptr && known->loss != Loss::none) {
        meet(*known);
        throw LostPiece(*known);
    }
    if (known != nullptr && known->done) return {known};
    Message begun{.kind = Message::Kind::begun, .name = name};
    begun.place = place;
    begun.again = known != nullptr;
    begun.least_seconds = least_seconds;
    send(pipe_, begun);
    open(known);
    return {known};
}

void Pieces::leave(Message::Kind how, std::string bytes, bool for_this_run) {
    scopes_.pop_back();
    Message message{.kind = how, .bytes = std::move(bytes)};
    message.for_this_run = for_this_run;
    send(pipe_, message);
}

void Pieces::meet(const PieceRecord& lost) {
    losses_met_ = std::max(losses_met_, lost.number);
    console_.mute(catching_up());
}

void Pieces::aside(std::string bytes) const {
    send(pipe_, {.kind = Message::Kind::aside, .bytes = std::move(bytes)});
}

} // namespace shadowproof
