#include "sim/memory.h"
#include "tests/fuzz/demand.h"
#include "tests/fuzz/temporary_folder.h"

// The simulated cell's memory: taken, saved and taken again it is the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "memory.json";
    or_refused(InputFault::config, [&] {
        std::filesystem::remove(file);
        write_file(file, Bytes(data, data + size));
        const CellMemory memory = load_memory(file);
        save_memory(file, memory);
        try {
            demand(load_memory(file) == memory);
        } catch (const InputError&) {
            std::abort();
        }
    });
    return 0;
}
