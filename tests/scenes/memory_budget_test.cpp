#include "scenes/available_memory.h"
#include "scenes/error.h"
#include "scenes/memory_budget.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace shadowproof::test {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    write_bytes(file, FileBytes(text.begin(), text.end()));
}

TEST(memory_budget, one_byte_too_much_is_refused_with_what_is_needed_and_what_there_is) {
    MemoryAccount account({program_bytes + 100, "--memory"});
    const MemoryNeed need{100, "file.gltf /accessors/0", "its elements", "split it"};
    EXPECT_NO_THROW(account.require(need));
    {
        const MemoryHold held = account.hold(need);
        EXPECT_EQ(account.held(), program_bytes + 100);
        EXPECT_THROW(account.require({1, "file.gltf", "one byte", "split it"}), Error);
    }
    EXPECT_EQ(account.held(), program_bytes);
    account.keep(need);
    try {
        account.require({2'500'000'000, "file.gltf /images/0", "its texels", "scale it down"});
        FAIL() << "more than there is was granted";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "file.gltf /images/0: needs 2.5 GB of memory for its texels beside 250 MB "
                     "that are held, and the budget is 250 MB (--memory); scale it down, or give "
                     "more by --memory");
    }
}

TEST(memory_budget, a_need_beyond_every_number_does_not_wrap_around) {
    const MemoryAccount account({program_bytes * 2, "--memory"});
    EXPECT_THROW(account.require({~std::uint64_t{0}, "file", "all", "none"}), Error);
    EXPECT_NO_THROW(MemoryAccount().require({~std::uint64_t{0} - program_bytes, "", "", ""}));
}

TEST(memory_budget, holds_that_are_moved_are_given_back_once) {
    MemoryAccount account;
    MemoryHold first = account.hold({5, "", "", ""});
    MemoryHold second = std::move(first);
    first = account.hold({7, "", "", ""});
    second = std::move(first);
    first = {};
    second = {};
    EXPECT_EQ(account.held(), program_bytes);
}

TEST(parse_bytes, knows_the_units_and_nothing_else) {
    EXPECT_EQ(parse_bytes("123"), 123U);
    EXPECT_EQ(parse_bytes("2GB"), 2'000'000'000U);
    EXPECT_EQ(parse_bytes("2g"), 2'000'000'000U);
    EXPECT_EQ(parse_bytes("1.5GiB"), 1610612736U);
    EXPECT_EQ(parse_bytes("512MB"), 512'000'000U);
    EXPECT_EQ(parse_bytes("4ki"), 4096U);
    EXPECT_EQ(parse_bytes("2e9"), 2'000'000'000U);
    for (const char* bad :
         {"", "GB", "0", "-1", "0.1", "1 GB", "1,5GB", "2XB", "2GBB", "nan", "inf", "1e30"})
        EXPECT_FALSE(parse_bytes(bad)) << bad;
}

TEST(available_memory, is_the_least_of_what_the_machine_and_every_group_around_it_leave) {
    const Folder folder;
    const std::filesystem::path root = folder.path();
    write_text(root / "proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    8000 kB\n");
    EXPECT_EQ(available_memory(root), 8000U * 1024);

    write_text(root / "proc/self/cgroup", "0::/outer/inner\n");
    const std::filesystem::path groups = root / "sys/fs/cgroup";
    write_text(groups / "outer/inner/memory.max", "max\n");
    write_text(groups / "outer/memory.max", "6000000\n");
    write_text(groups / "outer/memory.current", "2000000\n");
    EXPECT_EQ(available_memory(root), 4000000U);
    write_text(groups / "outer/memory.stat", "anon 5\ninactive_file 500000\n");
    EXPECT_EQ(available_memory(root), 4500000U);
    write_text(groups / "outer/inner/memory.max", "1000000\n");
    write_text(groups / "outer/inner/memory.current", "999990\n");
    EXPECT_EQ(available_memory(root), 10U);
    write_text(groups / "outer/inner/memory.current", "1000001\n");
    EXPECT_EQ(available_memory(root), 0U);
}

TEST(available_memory,
     knows_the_groups_of_version_1_and_a_container_that_sees_its_own_as_the_root) {
    const Folder folder;
    const std::filesystem::path root = folder.path();
    write_text(root / "proc/meminfo", "MemAvailable: 8000 kB\n");
    write_text(root / "proc/self/cgroup", "4:cpu,memory:/docker/abc\n1:name=systemd:/x\n");
    const std::filesystem::path groups = root / "sys/fs/cgroup/memory";
    write_text(groups / "memory.limit_in_bytes", "3000000\n");
    write_text(groups / "memory.usage_in_bytes", "1000000\n");
    EXPECT_EQ(available_memory(root), 2000000U);
    write_text(groups / "docker/abc/memory.limit_in_bytes", "500000\n");
    write_text(groups / "docker/abc/memory.usage_in_bytes", "100000\n");
    EXPECT_EQ(available_memory(root), 400000U);
}

TEST(available_memory, is_bounded_by_the_limits_of_the_process_less_what_it_has_mapped) {
    const Folder folder;
    // Far above what a sanitizer maps.
    const std::uint64_t limit = 1ULL << 52U;
    write_text(folder.path() / "proc/meminfo", "MemAvailable: 8000000000000 kB\n");
    write_text(folder.path() / "proc/self/status", "VmSize:\t 1000 kB\nVmData:\t 600 kB\n");
    for (const auto& [resource, mapped] : {std::pair{RLIMIT_AS, 1000}, {RLIMIT_DATA, 600}}) {
        struct rlimit before {};
        ASSERT_EQ(getrlimit(resource, &before), 0);
        struct rlimit limited = before;
        limited.rlim_cur = limit;
        ASSERT_EQ(setrlimit(resource, &limited), 0);
        const std::uint64_t available = available_memory(folder.path());
        ASSERT_EQ(setrlimit(resource, &before), 0);
        EXPECT_EQ(available, limit - 1024U * static_cast<unsigned>(mapped));
    }
}

TEST(available_memory, of_this_machine_is_some_and_the_budget_is_three_quarters_of_it) {
    EXPECT_GT(available_memory(), 1ULL << 20U);
    const Folder folder;
    write_text(folder.path() / "proc/meminfo", "MemAvailable: 8000 kB\n");
    EXPECT_EQ(default_memory_budget(folder.path()).bytes, 6000U * 1024);
    const Folder nothing;
    EXPECT_EQ(default_memory_budget(nothing.path()).bytes, MemoryBudget::no_limit);
}

TEST(loading, fits_its_budget_or_is_refused_naming_the_place) {
    nlohmann::json gltf = triangle_gltf();
    SceneRequest request;
    request.memory = {program_bytes + 1'000'000, "--memory"};
    EXPECT_EQ(refusal(gltf, request), "");
    gltf["accessors"][0].erase("bufferView");
    gltf["accessors"][0]["count"] = 1'000'000;
    gltf["meshes"][0]["primitives"][0].erase("indices");
    const std::string words = refusal(gltf, request);
    EXPECT_NE(words.find("/accessors/0: needs 24 MB of memory for its elements"), std::string::npos)
        << words;
    EXPECT_NE(words.find("251 MB (--memory)"), std::string::npos) << words;
}

} // namespace
} // namespace shadowproof::test
