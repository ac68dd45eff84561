// write_output FILE [BYTES]: asks whether FILE can be written, then writes that many bytes to it
// (8), as every command does with its files. Exit code 3 and a sentence where it could not.
#include "compare/output/write_file.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

int main(int argc, char** argv) {
    using namespace shadowproof;
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        const std::string file = argc > 1 ? argv[1] : "";
        const std::size_t bytes = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 8;
        std::printf("before ");
        check_writable(file);
        // Alone: whether the question changes anything.
        if (std::getenv("WRITE_OUTPUT_ASKS") == nullptr) write_file(file, std::string(bytes, 'n'));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "write_output: %s\n", error.what());
        return 3;
    }
}
