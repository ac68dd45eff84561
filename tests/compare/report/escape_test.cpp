#include "compare/report/escape.h"
#include "compare/report/report_template.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

TEST(Template, gaps_are_filled_and_values_are_not_filled_again) {
    EXPECT_EQ(fill("a {{x}} b {{y}}{{x}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2{{y}}");
    EXPECT_EQ(fill("no gap", {}), "no gap");
}

TEST(Escape, markup_is_escaped_also_between_quotes) {
    EXPECT_EQ(escaped("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(Escape, text_that_is_utf8_passes_and_bytes_that_are_not_are_replaced) {
    EXPECT_EQ(escaped("Ñandú 影"), "Ñandú 影");
    EXPECT_EQ(escaped("a\xff\xfe z"), "a\uFFFD\uFFFD z");
    EXPECT_EQ(escaped("\xC0\xAF"), "\uFFFD\uFFFD");           // overlong '/'
    EXPECT_EQ(escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD"); // a surrogate
    EXPECT_EQ(escaped("\xF4\x90\x80\x80").size(), 4 * 3U);    // beyond U+10FFFF
    EXPECT_EQ(escaped("\xE5\xBD"), "\uFFFD\uFFFD");           // ends early
    EXPECT_EQ(escaped(std::string_view("a\0b\x1b", 4)), "a\uFFFD"
                                                        "b\uFFFD");
}

TEST(Escape, a_name_can_neither_colour_nor_clear_a_terminal) {
    EXPECT_EQ(printable("a\x1b[31mb"), "a\uFFFD[31mb");
    EXPECT_EQ(printable("a\nb\rc\x7f"), "a\uFFFD"
                                        "b\uFFFD"
                                        "c\uFFFD");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m"),
              "\uFFFD31m"); // C1: control sequence introducer
    EXPECT_EQ(printable("Ñandú 影"), "Ñandú 影");
}

TEST(Escape, a_table_cell_has_no_pipe_and_a_workflow_command_no_line_end) {
    EXPECT_EQ(for_markdown("a|b").find('|'), std::string::npos);
    EXPECT_EQ(for_markdown("<b>").find('<'), std::string::npos);
    EXPECT_EQ(for_workflow("50%\nx"), "50%25%0Ax");
    EXPECT_EQ(for_workflow_property("a:b,c"), "a%3Ab%2Cc");
}

TEST(Escape, a_word_of_the_shell_is_quoted_only_where_it_must_be) {
    EXPECT_EQ(shell_quoted("a/b-c.glb"), "a/b-c.glb");
    EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_quoted(""), "''");
}

} // namespace
} // namespace shadowproof
