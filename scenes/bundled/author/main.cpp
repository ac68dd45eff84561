// shadowproof_author FOLDER: writes the bundled scenes there.
#include "scenes/bundled/author/stages.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace {

bool write_all(const std::vector<shadowproof::author::Stage>& stages,
               const std::filesystem::path& folder) {
    for (const shadowproof::author::Stage& stage : stages) {
        const std::filesystem::path file = folder / (stage.name + ".gltf");
        std::ofstream stream(file, std::ios::binary);
        stream << write_gltf(stage);
        if (!stream.flush()) {
            std::cerr << file.string() << ": cannot be written\n";
            return false;
        }
        std::cout << file.string() << '\n';
    }
    return true;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: shadowproof_author FOLDER\n";
        return 2;
    }
    using namespace shadowproof::author;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    return write_all(all_stages(), folder) ? 0 : 3;
}
