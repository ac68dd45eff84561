// glTF and GLB bytes: load, or are refused in a sentence.
#include "scenes/load/gltf/gltf.h"

#include "scenes/error.h"
#include "tests/fuzz/allocations.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/private_folder.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace shadowproof;
    static const fuzz::PrivateFolder folder;
    const fuzz::Input input(bytes, size);
    const std::filesystem::path file = folder.write("asset.gltf", input);
    SceneRequest request;
    request.every_light = true;
    request.time = 0.4;
    request.width = 24;
    request.height = 24;
    constexpr std::uint64_t promised = 100'000'000; // bytes
    request.memory = {program_bytes + promised, "the fuzzer"};
    const fuzz::PeakAllocation peak;
    // Of a picture of the largest size, most.
    const fuzz::TimePromise promise("gltf", input, 5);
    try {
        fuzz::check_scene(load_gltf(file, request));
    } catch (const Error& error) {
        fuzz::check_message(error.what(), file.string(), "gltf", input);
    }
    if (peak.bytes() > promised) fuzz::report_finding("gltf-memory", input);
    return 0;
}
