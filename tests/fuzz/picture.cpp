// FileBytes of a picture: decoded, or refused in a sentence before more is allocated than was
// allowed.
#include "scenes/load/picture/picture.h"

#include "scenes/error.h"
#include "scenes/load/picture/openimageio.h"
#include "tests/fuzz/allocations.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace shadowproof;
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 18U;
    // What the first use of the library takes is the program's share, and not the picture's.
    openimageio();
    const fuzz::Input input(bytes, size);
    const fuzz::TimePromise promise("picture", input, 1);
    constexpr std::uint64_t promised = 10'000'000; // bytes
    const MemoryAccount memory({program_bytes + promised, "the fuzzer"});
    const fuzz::PeakAllocation peak;
    try {
        const Picture picture = decode_picture({bytes, size}, "picture", {memory, most_pixels});
        fuzz::require(picture.width > 0 && picture.height > 0 && picture.channels > 0,
                      "pictures have pixels");
        const auto pixels =
            static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
        fuzz::require(pixels <= most_pixels, "pictures are no larger than allowed");
        fuzz::require(picture.values.size() ==
                          pixels * static_cast<std::uint64_t>(picture.channels),
                      "pictures are whole");
        for (const float value : picture.values)
            fuzz::require(std::isfinite(value), "values of pictures are finite");
    } catch (const Error& error) {
        fuzz::check_message(error.what(), "picture", "picture", input);
    }
    if (peak.bytes() > promised) fuzz::report_finding("picture-memory", input);
    return 0;
}
