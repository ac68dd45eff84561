#include "tests/fuzz/findings.h"

#include "tests/fuzz/promises.h"

#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace shadowproof::fuzz {

void report_finding(const std::string& kind, Input input) {
    constexpr int most = 4;
    const char* folder = std::getenv("SHADOWPROOF_FUZZ_FINDINGS");
    if (folder == nullptr || *folder == '\0') broken(kind);
    for (int number = 0; number < most; ++number) {
        const std::filesystem::path file =
            std::filesystem::path(folder) / (kind + "." + std::to_string(number));
        std::error_code missing;
        const std::uintmax_t kept = std::filesystem::file_size(file, missing);
        if (!missing && kept <= input.size()) continue;
        std::ofstream(file, std::ios::binary | std::ios::trunc)
            .write(reinterpret_cast<const char*>(input.data()),
                   static_cast<std::streamsize>(input.size()));
        return;
    }
}

void check_message(const std::string& message, const std::string& where, const char* target,
                   Input input) {
    if (const auto fault = fault_of_message(message, where)) {
        std::fprintf(stderr, "%.2000s\n", message.c_str());
        report_finding(std::string(target) + "-" + *fault, input);
    }
}

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

TimePromise::TimePromise(const char* target, Input input, double most_seconds)
    : target_(target), input_(input), most_seconds_(most_seconds), begin_(processor_seconds()) {}

TimePromise::~TimePromise() {
    constexpr bool is_fuzzing = SHADOWPROOF_FUZZING != 0;
    if (is_fuzzing && processor_seconds() - begin_ > most_seconds_)
        report_finding(std::string(target_) + "-slow", input_);
}

} // namespace shadowproof::fuzz
