#include "compare/json/memo.h"

#include <gtest/gtest.h>

#include <string_view>

namespace shadowproof {
namespace {

std::string made_of(Memo& memo, std::string_view one, std::string_view other, int& times) {
    return memo.result({bytes_for_memo(one), bytes_for_memo(other)}, [&] {
        ++times;
        return std::string(one) + "+" + std::string(other);
    });
}

TEST(Memo, makes_the_same_once) {
    Memo memo;
    int times = 0;
    EXPECT_EQ(made_of(memo, "zpass", "seen", times), "zpass+seen");
    EXPECT_EQ(made_of(memo, "zpass", "seen", times), "zpass+seen");
    EXPECT_EQ(times, 1);
    memo.forget();
    EXPECT_EQ(made_of(memo, "zpass", "seen", times), "zpass+seen");
    EXPECT_EQ(times, 2);
}

TEST(Memo, tells_inputs_apart_that_are_the_same_end_to_end) {
    Memo memo;
    int times = 0;
    EXPECT_EQ(made_of(memo, "zpass", "seen", times), "zpass+seen");
    EXPECT_EQ(made_of(memo, "zpasss", "een", times), "zpasss+een");
    EXPECT_EQ(made_of(memo, "", "zpassseen", times), "+zpassseen");
    EXPECT_EQ(made_of(memo, "seen", "zpass", times), "seen+zpass");
    EXPECT_EQ(times, 4);
}

TEST(Memo, makes_again_what_is_too_much_to_remember) {
    Memo memo;
    int times = 0;
    const auto large = [&](std::string_view name) {
        return memo
            .result({bytes_for_memo(name)},
                    [&] {
                        ++times;
                        return std::string(std::size_t{2} << 20U, name.front());
                    })
            .front();
    };
    EXPECT_EQ(large("a"), 'a');
    EXPECT_EQ(large("b"), 'b');
    EXPECT_EQ(large("a"), 'a'); // remembered
    EXPECT_EQ(large("b"), 'b');
    EXPECT_EQ(times, 3);
}

} // namespace
} // namespace shadowproof
