#include "compare/report_template.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

TEST(Template, gaps_are_filled_and_values_are_not_filled_again) {
    EXPECT_EQ(fill("a {{x}} b {{y}}{{x}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2{{y}}");
    EXPECT_EQ(fill("no gap", {}), "no gap");
}

TEST(Template, markup_is_escaped_also_between_quotes) {
    EXPECT_EQ(escaped("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(Template, text_that_is_utf8_passes_and_bytes_that_are_not_are_replaced) {
    EXPECT_EQ(escaped("Ñandú 影"), "Ñandú 影");
    EXPECT_EQ(escaped("a\xff\xfe z"), "a\uFFFD\uFFFD z");
    EXPECT_EQ(escaped("\xC0\xAF"), "\uFFFD\uFFFD");                   // overlong '/'
    EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");         // a surrogate
    EXPECT_EQ(escaped("\xE5\xBD"), "\uFFFD\uFFFD");                   // cut short
    EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)), "a\uFFFDb\uFFFD"); // control characters
}

} // namespace
} // namespace shadowproof
