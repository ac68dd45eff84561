// Which folders a report may be written to: the homes that accounts have.
#include "compare/output/report_place.h"
#include "scenes/error.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

namespace fs = std::filesystem;

struct Accounts {
    fs::path file =
        fs::temp_directory_path() / ("shadowproof-accounts-" + std::to_string(getpid()));
    explicit Accounts(const std::string& lines) { std::ofstream(file) << lines; }
    Accounts(const Accounts&) = delete;
    Accounts& operator=(const Accounts&) = delete;
    ~Accounts() { fs::remove(file); }
};

TEST(HomesIn, are_those_of_all_accounts_in_the_file) {
    const Accounts accounts("root:x:0:0:root:/root:/bin/sh\n"
                            "# a comment\n"
                            "ann:x:1000:1000:Ann,,,:/home/ann:/bin/sh\n"
                            "not an account\n"
                            "bob:x:1001:1001::/srv/people/bob:/bin/sh\n"
                            "nobody:x:65534:65534:::\n");
    EXPECT_EQ(homes_in(accounts.file),
              (std::vector<fs::path>{"/root", "/home/ann", "/srv/people/bob", ""}));
}

TEST(HomesIn, are_none_where_there_is_no_file_and_bounded_where_there_are_very_many) {
    EXPECT_TRUE(homes_in("/nonexistent/passwd").empty());
    std::string lines;
    for (int i = 0; i < 100'001; ++i) lines += "a:x:1:1::/h:\n";
    const Accounts accounts(lines);
    EXPECT_EQ(homes_in(accounts.file).size(), 100'000U);
}

TEST(CheckReportPlace, refuses_the_homes_of_the_accounts_of_this_machine_and_what_holds_them) {
    int tried = 0;
    for (const fs::path& home : homes_in("/etc/passwd")) {
        if (!home.is_absolute()) continue;
        const fs::path place = fs::weakly_canonical(home);
        for (const fs::path& each : {place, place.parent_path()}) {
            EXPECT_THROW(check_report_place(each, each, {}), Error) << each;
            ++tried;
        }
    }
    EXPECT_GT(tried, 0);
    const fs::path other = fs::temp_directory_path() / "shadowproof-none-of-this-name";
    EXPECT_NO_THROW(check_report_place(other, other, {}));
}

} // namespace
} // namespace shadowproof
