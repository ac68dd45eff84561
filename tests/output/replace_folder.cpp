// replace_folder DIR NAME=CONTENT...: puts the files given into a new folder that replaces DIR, as
// a report does, without the seconds that its pictures take. Says what was kept; exit code 3 and a
// sentence where it could not.
#include "compare/output/replaced_folder.h"

#include <sys/wait.h>
#include <unistd.h>

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
        ReplacedFolder folder(argc > 1 ? argv[1] : "", {"index.html"});
        const auto add = [&](int begin) {
            for (int i = begin; i < argc; i += 2) {
                const std::string argument = argv[i];
                const std::size_t equals = argument.find('=');
                folder.add(argument.substr(0, equals), argument.substr(equals + 1));
            }
        };
        add(2);
        if (std::getenv("REPLACE_FOLDER_FORKS") == nullptr) {
            add(3);
        } else if (const pid_t child = fork(); child == 0) {
            // Its end is not that of the folder, whether it could write or not.
            try {
                add(3);
            } catch (const std::exception&) {
                return 1;
            }
            return 0;
        } else {
            waitpid(child, nullptr, 0);
        }
        // So that a test meets the folder while it is being written.
        if (std::getenv("REPLACE_FOLDER_WAITS") != nullptr) {
            std::puts("waiting");
            std::fflush(stdout);
            while (std::getchar() != '\n') {
            }
        }
        folder.finish();
        for (const std::string& note : folder.notes()) std::puts(note.c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "replace_folder: %s\n", error.what());
        return 3;
    }
}
