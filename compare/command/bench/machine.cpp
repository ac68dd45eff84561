#include "compare/command/bench/machine.h"

#include <sched.h>
#include <sys/utsname.h>

#include <fstream>

namespace shadowproof {

BenchMachine this_machine() {
    BenchMachine machine{.processor = "unknown", .cores = 0, .system = "unknown"};
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (!line.starts_with("model name") || colon == std::string::npos) continue;
        machine.processor = line.substr(colon + 2);
        break;
    }
    cpu_set_t usable;
    CPU_ZERO(&usable);
    if (sched_getaffinity(0, sizeof(usable), &usable) == 0)
        machine.cores = static_cast<std::uint64_t>(CPU_COUNT(&usable));
    utsname system{};
    if (uname(&system) == 0)
        machine.system = std::string(system.sysname) + " " + system.release + " " + system.machine;
    return machine;
}

} // namespace shadowproof
