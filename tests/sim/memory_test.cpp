#include "sim/memory.h"

#include <gtest/gtest.h>

#include "segment/error.h"
#include "tests/sim/cell_rig.h"

namespace qchopper {
namespace {

CellMemory a_memory() {
    CellMemory memory;
    memory.boot_count = 3;
    memory.epoch_held = 0xFFFFFFFE;
    memory.starts_total = 17;
    for (std::uint8_t n = 1; n <= 20; ++n) {
        JobRecord& record = memory.jobs[Uuid{n, 0xAB}];
        record.state = JobState::ended;
        record.result = JobResult::complete;
        record.starts = 1;
        record.start_epoch = n;
        record.start_seq = 4000000000U;
        record.start_time_ms = 1700000000000U + n;
        record.end_time_ms = 1700000009999U;
        record.file_sha256.fill(n);
        record.last_block = 12;
    }
    return memory;
}

TEST(Memory, LoadingGivesBackWhatWasSaved) {
    const rig::Folder folder;
    const auto file = folder.path / "memory.json";
    save_memory(file, a_memory());
    EXPECT_EQ(load_memory(file), a_memory());
    save_memory(file, {});
    EXPECT_EQ(load_memory(file), CellMemory{});
}

TEST(Memory, AFileThatIsNotThereIsANewCell) {
    const rig::Folder folder;
    EXPECT_EQ(load_memory(folder.path / "memory.json"), CellMemory{});
}

TEST(Memory, ADamagedFileIsNeverTakenForANewCell) {
    const rig::Folder folder;
    const auto file = folder.path / "memory.json";
    const std::string whole = to_json(a_memory());
    for (std::size_t length = 0; length + 2 < whole.size(); length += 7) {
        write_file(file, whole.substr(0, length));
        EXPECT_THROW(load_memory(file), InputError) << length;
    }
    for (const char* bad : {"[]", "{}", "{\"schema\":2}", "null", "{\"schema\":1,\"boot_count\":\"x\"}"}) {
        write_file(file, std::string_view(bad));
        EXPECT_THROW(load_memory(file), InputError) << bad;
    }
}

TEST(Store, BelongsToOneCellAtATime) {
    const rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    options.store_folder = folder.path / "store";
    CellSim first(options);
    first.start();
    CellSim second(options);
    EXPECT_THROW(second.start(), InputError);
    first.stop();
    second.start();
    EXPECT_EQ(second.status().boot_count, 2U);
}

TEST(Store, AStoreThatCannotBeReadStopsTheCellFromStarting) {
    const rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    options.store_folder = folder.path / "store";
    std::filesystem::create_directories(options.store_folder);
    write_file(options.store_folder / "memory.json", std::string_view("not json"));
    CellSim cell(options);
    EXPECT_THROW(cell.start(), InputError);
}

}  // namespace
}  // namespace qchopper
