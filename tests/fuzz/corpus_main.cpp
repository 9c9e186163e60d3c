// Passes every file of a folder to the fuzzer that this is linked with, without libFuzzer: inputs that fuzzers found
// are a test of every build.
//
// The name of each file is printed before it is read, so that the last name is that of a crash. No folder or no file is
// a failure.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "base/files/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
    std::error_code error;
    if (argc != 2 || !std::filesystem::is_directory(argv[1], error)) {
        std::fputs("name one folder of inputs\n", stderr);
        return 64;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    LLVMFuzzerTestOneInput(nullptr, 0);
    for (const std::filesystem::path& file : files) {
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);
        const qchopper::Bytes bytes = qchopper::read_file(file);
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    std::printf("%zu inputs\n", files.size());
    return files.empty() ? 1 : 0;
}
