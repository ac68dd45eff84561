// shadowproof_author FOLDER: writes the bundled scenes there.
#include "scenes/bundled/author/stages.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: shadowproof_author FOLDER\n";
        return 2;
    }
    for (const shadowproof::author::Stage& stage : shadowproof::author::all_stages()) {
        const std::filesystem::path file = std::filesystem::path(argv[1]) / (stage.name + ".gltf");
        std::ofstream stream(file, std::ios::binary);
        stream << write_gltf(stage);
        if (!stream.flush()) {
            std::cerr << file.string() << ": cannot be written\n";
            return 3;
        }
        std::cout << file.string() << '\n';
    }
    return 0;
}
