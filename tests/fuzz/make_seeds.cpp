// Writes the first inputs of every fuzzer: FOLDER/ply/little-endian, FOLDER/job/packed and so on.

#include <cstdio>
#include <filesystem>

#include "base/files/file.h"
#include "tests/fuzz/seeds.h"
#include "tests/segment/io/encodings.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("make_seeds FOLDER\n", stderr);
        return 64;
    }
    std::vector<qchopper::Encoded> seeds = qchopper::encodings();
    for (const auto& more : {qchopper::job_seeds(), qchopper::project_seeds(), qchopper::link_seeds()}) {
        seeds.insert(seeds.end(), more.begin(), more.end());
    }
    for (const qchopper::Encoded& seed : seeds) {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / seed.reader;
        std::filesystem::create_directories(folder);
        qchopper::write_file(folder / seed.name, seed.bytes);
    }
    return 0;
}
