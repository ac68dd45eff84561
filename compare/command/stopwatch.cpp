#include "compare/command/stopwatch.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace shadowproof {

double milliseconds_since_start_of_process() {
    std::ifstream file("/proc/self/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    // The second field is the program's name in parentheses, and may hold spaces itself.
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int field = 3; field < 22; ++field) fields >> skipped;
    long long start = 0; // ticks
    fields >> start;
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    const double seconds =
        static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    return 1e3 * (seconds - static_cast<double>(start) / static_cast<double>(sysconf(_SC_CLK_TCK)));
}

} // namespace shadowproof
