// Writes the first inputs of every fuzzer: FOLDER/ply/little-endian, FOLDER/stl/ascii and so on.

#include <cstdio>
#include <filesystem>

#include "segment/files/file.h"
#include "tests/segment/intake/encodings.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("make_seeds FOLDER\n", stderr);
        return 64;
    }
    for (const qchopper::Encoded& seed : qchopper::encodings()) {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / seed.reader;
        std::filesystem::create_directories(folder);
        qchopper::write_file(folder / seed.name, seed.bytes);
    }
    return 0;
}
