#include "sim/cell/memory.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/sha256.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

CellMemory a_memory() {
    CellMemory memory;
    memory.store_id = Uuid{1, 2, 3};
    memory.store_created_ms = 1700000000000U;
    memory.boot_count = 3;
    memory.epoch_held = 0xFFFFFFFE;
    memory.starts_total = 17;
    memory.mark = 0xFEDCBA9876543210U;
    memory.grants = {{4711, 1}, {0xFFFFFFFF, 0xFFFFFFFE}};
    for (std::uint8_t n = 1; n <= 20; ++n) {
        JobRecord& record = memory.jobs[Uuid{n, 0xAB}];
        record.state = JobState::ended;
        record.result = JobResult::complete;
        record.starts = 1;
        record.start_epoch = n;
        record.start_seq = 4000000000U;
        record.start_time_ms = 1700000000000U + n;
        record.end_time_ms = 1700000009999U;
        record.file_sha256.bytes.fill(n);
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
    for (const char* bad :
         {"[]", "{}", "{\"schema\":2}", "{\n  \"schema\": 2\n}\n", "null", "{\"schema\":1,\"boot_count\":\"x\"}"}) {
        write_file(file, std::string_view(bad));
        EXPECT_THROW(load_memory(file), InputError) << bad;
    }
}

// A flipped digit would make another id, another count, another end: a job could start twice.
TEST(Memory, EveryChangedByteIsFound) {
    const std::string whole = to_json(a_memory());
    EXPECT_EQ(memory_from_json(whole, "m"), a_memory());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char other : {'0', '9', ' ', '"', '\0'}) {
            if (whole[at] == other) continue;
            std::string damaged = whole;
            damaged[at] = other;
            EXPECT_THROW(memory_from_json(damaged, "m"), InputError) << at << other;
        }
    }
    for (const std::string& longer : {whole + " ", whole + whole, " " + whole}) {
        EXPECT_THROW(memory_from_json(longer, "m"), InputError);
    }
}

// A right checksum over wrong contents: what is read is only what could have been written.
TEST(Memory, ValuesThatNoCellWritesAreRefused) {
    using Json = nlohmann::json;
    const auto with = [](const std::string& place, const Json& value) {
        Json all = Json::parse(to_json(a_memory()));
        all.erase("sha256");
        all[Json::json_pointer(place)] = value;
        const std::string rest = all.dump(1);
        all["sha256"] = to_hex(sha256({reinterpret_cast<const std::uint8_t*>(rest.data()), rest.size()}));
        try {
            memory_from_json(all.dump(1) + "\n", "m");
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find("json.exception"), std::string::npos) << error.what();
            return std::string(error.what());
        }
        return std::string("taken");
    };
    EXPECT_EQ(with("/boot_count", 4), "taken") << "the forger itself does no harm";
    const std::vector<Json> others{4294967296ULL, -1, 1.5, 1e300, "3", nullptr, true, Json::array(), Json::object()};
    const std::string job = "/jobs/" + Json::parse(to_json(a_memory()))["jobs"].begin().key();
    for (const Json& other : others) {
        for (const char* place : {"/boot_count", "/epoch_held", "/starts_total", "/schema"}) {
            EXPECT_NE(with(place, other), "taken") << place << other;
        }
        EXPECT_NE(with(job, other), "taken") << other;
        EXPECT_NE(with(job + "/state", other), "taken") << other;
        EXPECT_NE(with(job + "/file_sha256", other), "taken") << other;
    }
    EXPECT_NE(with(job + "/state", 8), "taken");
    EXPECT_NE(with("/more", 8), "taken");
    EXPECT_THROW(memory_from_json(std::string(5'000'000, '['), "m"), InputError);
}

TEST(Memory, MarksAreReadBackAndDamagedOnesAreNone) {
    const rig::Folder folder;
    const auto file = folder.path / "store.marks.json";
    EXPECT_EQ(load_marks(file), SaveMarks{}) << "it is not there";
    const SaveMarks marks{0xFEDCBA9876543210U, 3};
    save_marks(file, marks);
    EXPECT_EQ(load_marks(file), marks);
    for (const char* damaged : {"", "[]", "{\"last\":1}", "{\"last\":1,\"next\":-1}", "{\"last\":1,\"next\":\"2\"}"}) {
        write_file(file, std::string_view(damaged));
        EXPECT_EQ(load_marks(file), SaveMarks{}) << damaged;
    }
}

// What a person does who restores a backup of the store's folder.
TEST(Store, AnOlderCopyOfTheFolderIsFoundByTheMarksBesideIt) {
    const rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    options.store_folder = folder.path / "store";
    const auto id = [&] {
        CellSim cell(options);
        cell.start();
        const auto bus = rig::connect(cell);
        return decode<Identity>(bus->read_input(identity_block.base, identity_block.count).registers).value.store_id;
    };
    const Uuid first = id();
    EXPECT_EQ(id(), first);
    std::filesystem::copy(folder.path / "store", folder.path / "backup", std::filesystem::copy_options::recursive);
    EXPECT_EQ(id(), first);
    std::filesystem::remove_all(folder.path / "store");
    std::filesystem::rename(folder.path / "backup", folder.path / "store");
    const Uuid restored = id();
    EXPECT_NE(restored, first);
    EXPECT_EQ(id(), restored) << "from then on it is the one written last";
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
