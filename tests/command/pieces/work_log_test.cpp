// A log of work that was cut off at any byte gives back all whole records before it.
#include "compare/command/pieces/work_log.h"
#include "scenes/error.h"
#include "tests/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof {
namespace {

namespace fs = std::filesystem;

struct Scratch {
    test::ScratchFolder folder{"log"};
    fs::path path = folder.path / "progress";

    std::string bytes() const { return test::text_in(path); }
    void put(const std::string& bytes) const { test::put_text(path, bytes); }
};

Message done(const std::string& bytes) {
    return {.kind = Message::Kind::done, .bytes = bytes};
}

std::vector<std::string> results_in(const fs::path& file) {
    std::vector<std::string> results;
    for (const Message& message : WorkLog::gone_on_with(file).take_earlier())
        results.push_back(message.bytes);
    return results;
}

TEST(WorkLog, cut_off_at_any_byte_it_has_what_was_whole_and_goes_on_behind_it) {
    const Scratch scratch;
    std::vector<std::size_t> ends;
    {
        const WorkLog log = WorkLog::begun(scratch.path, "the work");
        ends.push_back(scratch.bytes().size());
        for (const char* result : {"first", "", "a third one that is longer"}) {
            log.add(done(result));
            ends.push_back(scratch.bytes().size());
        }
    }
    const std::string whole = scratch.bytes();
    const std::vector<std::string> all{"first", "", "a third one that is longer"};
    for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
        scratch.put(whole.substr(0, cut));
        if (cut < ends[0]) {
            EXPECT_EQ(WorkLog::work_in(scratch.path), "") << cut;
            continue;
        }
        EXPECT_EQ(WorkLog::work_in(scratch.path), "the work");
        const auto kept = std::ranges::count_if(ends, [&](std::size_t end) { return end <= cut; });
        std::vector<std::string> expected(all.begin(), all.begin() + kept - 1);
        EXPECT_EQ(results_in(scratch.path), expected) << cut;
        WorkLog::gone_on_with(scratch.path).add(done("more"));
        expected.emplace_back("more");
        EXPECT_EQ(results_in(scratch.path), expected) << cut;
    }
}

TEST(WorkLog, a_bit_that_has_flipped_ends_it) {
    const Scratch scratch;
    const WorkLog log = WorkLog::begun(scratch.path, "the work");
    const std::size_t begin = scratch.bytes().size();
    log.add(done("first"));
    const std::string whole = scratch.bytes();
    for (std::size_t at = begin; at < whole.size(); ++at) {
        std::string spoiled = whole;
        spoiled[at] = static_cast<char>(spoiled[at] ^ 1);
        scratch.put(spoiled);
        EXPECT_TRUE(results_in(scratch.path).empty()) << at;
    }
}

TEST(WorkLog, what_holds_for_one_run_alone_is_ended_there_and_not_done) {
    const Scratch scratch;
    const WorkLog log = WorkLog::begun(scratch.path, "the work");
    Message message = done("of this run");
    message.for_this_run = true;
    log.add(message);
    log.add({.kind = Message::Kind::aside, .bytes = "aside"});
    log.add({.kind = Message::Kind::result, .bytes = "all"});
    const std::vector<Message> kept = WorkLog::gone_on_with(scratch.path).take_earlier();
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].kind, Message::Kind::ended);
    EXPECT_EQ(kept[0].bytes, "");
}

TEST(WorkLog, none_is_begun_where_there_is_one) {
    const Scratch scratch;
    scratch.put("mine");
    EXPECT_THROW(WorkLog::begun(scratch.path, "the work"), Error);
    EXPECT_EQ(scratch.bytes(), "mine");
    EXPECT_EQ(WorkLog::work_in(scratch.path), "");
    EXPECT_EQ(WorkLog::work_in(scratch.path.string() + "-none"), "");
}

} // namespace
} // namespace shadowproof
