// A driver with faults, for LD_PRELOAD: SHADOWPROOF_FAULT=FUNCTION:N:HOW makes the Nth call of
// FUNCTION end the process, or never return. Functions are glReadPixels, which each technique calls
// when it has drawn, glFinish, with which a sample of bench ends, rtcBuildBVH, with which tracing
// begins, and fork, with which the command hands its work to a child. HOW is a signal's number,
// "hang", or "throw": a thread throws what nobody catches, as one of a library does where memory
// runs out. SHADOWPROOF_FAULT_ONCE names a file: once it exists there are no more faults.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string_view>
#include <thread>

namespace {

using Procedure = void (*)();
using ReadPixels = void (*)(int, int, int, int, unsigned, unsigned, void*);

int calls = 0;
ReadPixels true_read_pixels = nullptr;
Procedure true_finish = nullptr;

void fault_at(std::string_view function) {
    const char* text = std::getenv("SHADOWPROOF_FAULT");
    const std::string_view wanted = text != nullptr ? text : "";
    if (!wanted.starts_with(function)) return;
    char* how = nullptr;
    if (++calls != std::strtol(text + function.size() + 1, &how, 10)) return;
    if (const char* once = std::getenv("SHADOWPROOF_FAULT_ONCE")) {
        const int mark = open(once, O_CREAT | O_EXCL | O_WRONLY, 0600);
        if (mark < 0) return;
        close(mark);
    }
    if (std::string_view(how) == ":hang")
        for (;;) pause();
    if (std::string_view(how) == ":throw") std::thread([] { throw std::bad_alloc(); }).join();
    const int number = std::atoi(how + 1);
    std::signal(number, SIG_DFL);
    std::raise(number);
}

void read_pixels(int x, int y, int w, int h, unsigned format, unsigned type, void* to) {
    fault_at("glReadPixels");
    true_read_pixels(x, y, w, h, format, type, to);
}

void finish() {
    fault_at("glFinish");
    true_finish();
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" Procedure OSMesaGetProcAddress(const char* name) {
    const Procedure found = next<Procedure (*)(const char*)>("OSMesaGetProcAddress")(name);
    if (std::string_view(name) == "glFinish") {
        true_finish = found;
        return finish;
    }
    if (std::string_view(name) != "glReadPixels") return found;
    true_read_pixels = reinterpret_cast<ReadPixels>(found);
    return reinterpret_cast<Procedure>(read_pixels);
}

extern "C" void* rtcBuildBVH(const void* arguments) {
    fault_at("rtcBuildBVH");
    return next<void* (*)(const void*)>("rtcBuildBVH")(arguments);
}

extern "C" pid_t fork() {
    fault_at("fork");
    return next<pid_t (*)()>("fork")();
}
