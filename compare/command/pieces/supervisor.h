// The supervisor process: starts a worker, records what it does, and if it crashes or takes too
// long, starts another one that goes on after the piece that was lost. With a log it goes on with
// what an earlier run has done, too; what was lost there is tried again.
#pragma once

#include "compare/command/pieces/pieces.h"
#include "compare/command/pieces/work_log.h"

#include <functional>
#include <string>

namespace shadowproof {

/// The default of --timeout, in seconds.
inline constexpr double usual_timeout = 600;

struct Supervision {
    double timeout = usual_timeout; ///< seconds for a piece; 0: no limit
    Console& console;
    /// Takes what workers send aside, in order; a later worker starts with what was kept.
    std::function<void(const std::string& bytes)> keep{};
    /// Where what is done is kept for a later run, and is taken from first; null: nowhere.
    WorkLog* log = nullptr;
};

/// Does the work in worker processes, and returns its packed result. Neither Embree nor OpenGL may
/// have been used in this process. Throws Error where a worker crashes or takes too long outside of
/// all pieces, and std::runtime_error with the message of what the work throws.
std::string supervised_bytes(const Supervision& how,
                             const std::function<std::string(Pieces&)>& work);

template <class Work>
auto supervised(const Supervision& how, const Work& work) {
    using Result = std::decay_t<decltype(work(std::declval<Pieces&>()))>;
    return unpacked<Result>(
        supervised_bytes(how, [&](Pieces& pieces) { return packed(work(pieces)); }));
}

} // namespace shadowproof
