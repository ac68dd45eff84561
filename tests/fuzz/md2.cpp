// FileBytes of a Quake II model: loads, or is refused in a sentence. Two pictures that its skin may
// name lie beside it.
#include "scenes/load/md2/md2.h"

#include "scenes/error.h"
#include "tests/fuzz/asset.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/private_folder.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

namespace {

using namespace shadowproof;

/// 2 x 2 texels of 127 127 255.
constexpr const char* normals =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEElEQVR4nGOor/8PRAwQCgA1ugf1LpMv+gAAAABJRU5E"
    "rkJggg==";

struct Beside {
    fuzz::PrivateFolder folder;
    Beside() {
        for (const char* name : {"skin.png", "skin_normal.png"})
            folder.write(name, fuzz::from_base64(normals));
    }
};

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const Beside beside;
    const fuzz::Input input(bytes, size);
    const std::filesystem::path file = beside.folder.write("asset.md2", input);
    SceneRequest request;
    request.time = 0.05;
    request.width = 24;
    request.height = 24;
    const fuzz::TimePromise promise("md2", input, 1);
    try {
        fuzz::check_scene(load_md2(file, request));
    } catch (const Error& error) {
        // Of the model, or of a picture beside it.
        fuzz::check_message(error.what(), file.parent_path().string(), "md2", input);
    }
    return 0;
}
