// FileBytes of a picture: decoded, or refused in a sentence before more is allocated than was
// allowed.
#include "scenes/load/picture/picture.h"

#include "scenes/error.h"
#include "scenes/load/picture/openimageio.h"
#include "scenes/load/picture/pcx.h"
#include "tests/fuzz/allocations.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

#include <array>
#include <cmath>

namespace {

using namespace shadowproof;

/// What the first use of the libraries takes is the program's share, and not the picture's.
void load_libraries() {
    openimageio();
    const std::array<unsigned char, 129> black{10, 5, 1, 8}; // a PCX picture of one pixel
    const MemoryAccount memory({std::uint64_t{1} << 30U, "the fuzzer"});
    try {
        decode_pcx(black, "black", {memory, 1});
    } catch (const Error&) { // as it has no planes
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 18U;
    load_libraries();
    const fuzz::Input input(bytes, size);
    const fuzz::TimePromise promise("picture", input, 1);
    constexpr std::uint64_t promised = 10'000'000; // bytes
    const MemoryAccount memory({program_bytes + promised, "the fuzzer"});
    const fuzz::PeakAllocation peak;
    try {
        const PictureRoom room{memory, most_pixels};
        const Picture picture = is_pcx({bytes, size})
                                    ? decode_pcx({bytes, size}, "picture", room)
                                    : decode_picture({bytes, size}, "picture", room);
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
