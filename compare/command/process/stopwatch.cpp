#include "compare/command/process/stopwatch.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace shadowproof {

std::optional<double> milliseconds_since_start_of_process() {
    std::ifstream file("/proc/self/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    // The second field is the program's name in parentheses, and may hold spaces itself.
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int field = 3; field < 22; ++field) fields >> skipped;
    double ticks = 0;
    if (!(fields >> ticks)) return std::nullopt;
    timespec boot{};
    clock_gettime(CLOCK_BOOTTIME, &boot);
    using Milliseconds = std::chrono::duration<double, std::milli>;
    const Milliseconds now =
        std::chrono::seconds(boot.tv_sec) + std::chrono::nanoseconds(boot.tv_nsec);
    const Milliseconds start =
        std::chrono::duration<double>(ticks / static_cast<double>(sysconf(_SC_CLK_TCK)));
    return (now - start).count();
}

} // namespace shadowproof
