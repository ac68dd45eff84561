// A shared object for LD_PRELOAD: memory that runs out where a test says so. It counts the
// allocations of the process from main() to its end, since nobody can answer for those before; of
// the processes that it forks, each goes on from the count of its parent. Counted are places in the
// code that allocate, each when it does so for the first time.
//   ALLOCATION_COUNTER  a file of 16 bytes, as uint64: the highest count of any process, and
//                       whether an allocation has failed; without it nothing is counted
//   ALLOCATION_AT       the allocation that fails, from 1, in the process that reaches it first;
//                       none: all are counted and none fails
//   ALLOCATION_KIND     new: those of operator new alone; else all that come to malloc too
//   ALLOCATION_EVERY    set: every allocation counts, not the first of each place alone
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

// What glibc's own are called as well, so that these need not be looked up, which allocates.
extern "C" {
void* __libc_malloc(std::size_t);                // NOLINT
void* __libc_calloc(std::size_t, std::size_t);   // NOLINT
void* __libc_realloc(void*, std::size_t);        // NOLINT
void* __libc_memalign(std::size_t, std::size_t); // NOLINT
}

namespace {

struct Shared {
    std::atomic<unsigned long> most;
    std::atomic<unsigned long> has_failed;
};

std::atomic<bool> in_main = false;
std::atomic<unsigned long> count = 0;
Shared* shared = nullptr;
unsigned long at = 0;
bool counts_new = false;
bool counts_malloc = false;
bool counts_every = false;

/// Return addresses of calls that have allocated. Open addressing; a place that finds no room in a
/// full table is never new.
std::array<std::atomic<std::uintptr_t>, 1U << 16U> places;

bool is_new(const void* caller) {
    const auto place = reinterpret_cast<std::uintptr_t>(caller);
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::uintptr_t held = 0;
        std::atomic<std::uintptr_t>& slot =
            places[(place * 0x9e3779b97f4a7c15U + i) >> 7U & 0xffffU];
        if (slot.compare_exchange_strong(held, place)) return true;
        if (held == place) return false;
    }
    return false;
}

[[gnu::constructor]] void begin() {
    if (const char* text = std::getenv("ALLOCATION_AT")) at = std::strtoul(text, nullptr, 10);
    const char* const kind = std::getenv("ALLOCATION_KIND");
    const char* const counter = std::getenv("ALLOCATION_COUNTER");
    if (kind == nullptr || counter == nullptr) return;
    const int file = ::open(counter, O_RDWR | O_CLOEXEC);
    if (file < 0) return;
    void* const mapped =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (mapped == MAP_FAILED) return;
    shared = static_cast<Shared*>(mapped);
    counts_new = std::strcmp(kind, "new") == 0;
    counts_malloc = !counts_new;
    counts_every = std::getenv("ALLOCATION_EVERY") != nullptr;
}

bool fails(bool counted, const void* caller) {
    if (!counted || !in_main || !(counts_every || is_new(caller))) return false;
    const unsigned long now = count.fetch_add(1) + 1;
    unsigned long most = shared->most;
    while (now > most && !shared->most.compare_exchange_weak(most, now)) {
    }
    if (now != at || shared->has_failed.exchange(1) != 0) return false;
    errno = ENOMEM;
    return true;
}

using Main = int(int, char**, char**);
Main* real_main = nullptr;

int counted_main(int argc, char** argv, char** environment) {
    in_main = true;
    const int code = real_main(argc, argv, environment);
    in_main = false;
    return code;
}

void* allocate(std::size_t size, const void* caller) {
    void* const memory = fails(counts_new || counts_malloc, caller) ? nullptr : __libc_malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void* aligned(std::size_t alignment, std::size_t size, const void* caller) {
    return fails(counts_malloc, caller) ? nullptr : __libc_memalign(alignment, size);
}

void* allocate(std::size_t size, std::align_val_t alignment, const void* caller) {
    const auto bytes = static_cast<std::size_t>(alignment);
    void* const memory =
        fails(counts_new || counts_malloc, caller) ? nullptr : __libc_memalign(bytes, size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

} // namespace

extern "C" {
// What calls main(), as glibc has it.
int __libc_start_main(Main* given, int argc, char** argv, void (*begin_all)(),
                      void (*end_all)(), // NOLINT
                      void (*end_loader)(), void* stack_end) {
    using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
    real_main = given;
    auto* const start = reinterpret_cast<Start*>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(counted_main, argc, argv, begin_all, end_all, end_loader, stack_end);
}
void* malloc(std::size_t size) noexcept {
    return fails(counts_malloc, __builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) noexcept {
    return fails(counts_malloc, __builtin_return_address(0)) ? nullptr
                                                             : __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
    return fails(counts_malloc, __builtin_return_address(0)) ? nullptr
                                                             : __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
    return aligned(alignment, size, __builtin_return_address(0));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    return aligned(alignment, size, __builtin_return_address(0));
}
/// Unlike the others it returns what went wrong.
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
    const bool is_power_of_two = alignment != 0 && (alignment & (alignment - 1)) == 0;
    if (!is_power_of_two || alignment % sizeof(void*) != 0) return EINVAL;
    void* const got = aligned(alignment, size, __builtin_return_address(0));
    if (got == nullptr) return ENOMEM;
    *memory = got;
    return 0;
}
}

void* operator new(std::size_t size) {
    return allocate(size == 0 ? 1 : size, __builtin_return_address(0));
}
void* operator new[](std::size_t size) {
    return allocate(size == 0 ? 1 : size, __builtin_return_address(0));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size == 0 ? 1 : size, alignment, __builtin_return_address(0));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size == 0 ? 1 : size, alignment, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
