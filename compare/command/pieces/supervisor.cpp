#include "compare/command/pieces/supervisor.h"

#include "compare/command/process/child_process.h"
#include "compare/command/process/exit_code.h"
#include "compare/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace shadowproof {

namespace {

using Clock = std::chrono::steady_clock;

/// What an earlier worker did in time may take so many times as long: the machine may be busier.
constexpr double again_factor = 3;

/// The worker process.
int do_work(int pipe, const WorkRecord& record, Console& console,
            const std::function<std::string(Pieces&)>& work) {
    Message last{.kind = Message::Kind::failed};
    try {
        Pieces pieces(pipe, record, console);
        last.bytes = work(pieces);
        last.kind = Message::Kind::result;
    } catch (const std::bad_alloc&) {
        last.bytes = out_of_memory;
    } catch (const std::exception& error) {
        last.bytes = error.what();
    }
    try {
        console.clear_progress();
        send(pipe, last);
    } catch (const std::bad_alloc&) {
        send(pipe,
             {.kind = Message::Kind::failed, .bytes = out_of_memory}); // needs less than a result
    }
    return exit_passed;
}

class Supervisor {
public:
    explicit Supervisor(const Supervision& how) : how_(how) {
        if (how.log == nullptr) return;
        for (Message& message : how.log->take_earlier()) take(std::move(message));
    }

    const WorkRecord& record() const { return record_; }
    std::optional<std::string>& result() { return result_; }

    /// Follows one worker until it ends or takes too long.
    void follow(ChildProcess& worker) {
        MessageReader reader(worker.pipe());
        note({.kind = Message::Kind::started});
        heard_at_ = Clock::now();
        while (!reader.at_end()) {
            if (std::optional<Message> message = reader.next(milliseconds_left())) {
                heard_at_ = Clock::now();
                note(std::move(*message));
            } else if (is_too_late()) {
                worker.kill();
                worker.wait();
                if (!result_)
                    lose(Loss::timed_out,
                         fmt::format("took longer than --timeout {}", how_.timeout));
                return;
            }
        }
        const ChildEnd end = worker.wait();
        if (!result_) lose(Loss::crashed, "the process that tried it " + words_of(end));
    }

private:
    /// A piece that was begun and has not ended; the first is the work as a whole.
    struct Open {
        std::size_t place; ///< within the one before it
        double limit;      ///< seconds without a message; 0: any number
    };

    const Supervision& how_;
    WorkRecord record_;
    std::vector<Open> open_;
    Clock::time_point heard_at_;
    std::optional<std::string> result_;

    PieceRecord& innermost() {
        PieceRecord* piece = &record_.whole;
        for (std::size_t i = 1; i < open_.size(); ++i) piece = &piece->inner[open_[i].place];
        return *piece;
    }

    std::optional<Clock::time_point> deadline() const {
        if (how_.timeout == 0) return std::nullopt;
        const std::chrono::duration<double> limit(open_.back().limit);
        return heard_at_ + std::chrono::ceil<Clock::duration>(limit);
    }
    bool is_too_late() const {
        const auto at = deadline();
        return at && Clock::now() >= *at;
    }
    int milliseconds_left() const {
        const auto at = deadline();
        if (!at) return -1;
        constexpr std::int64_t most = 1'000'000'000; // poll() takes an int
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(*at - Clock::now());
        return static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, most));
    }

    void note(Message message) {
        if (how_.log != nullptr) how_.log->add(message);
        take(std::move(message));
    }

    void take(Message message) {
        switch (message.kind) {
        case Message::Kind::started:
            open_ = {{.place = 0, .limit = how_.timeout}};
            return;
        case Message::Kind::begun:
            return begin(message);
        case Message::Kind::ended:
            open_.pop_back();
            return;
        case Message::Kind::done: {
            PieceRecord& piece = innermost();
            piece.done = true;
            piece.result = std::move(message.bytes);
            piece.inner = {}; // no worker goes into it any more
            open_.pop_back();
            return;
        }
        case Message::Kind::aside:
            return how_.keep(message.bytes);
        case Message::Kind::failed:
            throw std::runtime_error(message.bytes);
        case Message::Kind::result:
            result_ = std::move(message.bytes);
        }
    }

    void begin(const Message& message) {
        PieceRecord& around = innermost();
        if (message.place == around.inner.size()) around.inner.push_back({.name = message.name});
        const double limit = std::max(how_.timeout, message.least_seconds);
        open_.push_back({message.place, message.again ? again_factor * limit : limit});
    }

    /// What the worker was doing is lost: the next one goes on after it.
    void lose(Loss loss, const std::string& why) {
        how_.console.take_over();
        if (open_.size() == 1)
            throw Error("shadowproof", why, "nothing was written; report this with the command");
        PieceRecord& piece = innermost();
        piece.loss = loss;
        piece.why = why;
        piece.number = ++record_.losses;
        piece.inner = {};
    }
};

} // namespace

std::string supervised_bytes(const Supervision& how,
                             const std::function<std::string(Pieces&)>& work) {
    Supervisor supervisor(how);
    while (!supervisor.result()) {
        ChildProcess worker(
            [&](int pipe) { return do_work(pipe, supervisor.record(), how.console, work); });
        supervisor.follow(worker);
    }
    return std::move(*supervisor.result());
}

} // namespace shadowproof
