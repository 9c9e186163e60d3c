// Between the commit of the intent and the frame of START there is a sync of the journal's log: kill -9 cannot show
// that, because the page cache survives it.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <set>
#include <string>

#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// CMD of a COMMAND block that a line "sent HEX" shows, or 0: MBAP header (7 bytes), function 16, address 0, count 60,
// byte count, then registers, of which CMD is the seventh.
int command_in(const std::string& line) {
    constexpr std::size_t begin = 5;
    constexpr std::size_t cmd_at = 13 + 2 * 6;
    if (!line.starts_with("sent ") || line.size() < begin + 2 * (cmd_at + 2)) return 0;
    if (line.substr(begin + 14, 12) != "100000003c78") return 0;
    return std::stoi(line.substr(begin + 2 * cmd_at, 4), nullptr, 16);
}

// What a dispatch wrote, synced, renamed and sent; it has started its job once.
std::vector<std::string> order_of_dispatch() {
    const rig::Folder folder;
    std::filesystem::create_directory(folder.path / "drop");
    CellSim cell(rig::quick_cell(folder.path / "drop"));
    cell.start();
    const std::filesystem::path log = folder.path / "order";
    const std::string call = "LD_PRELOAD=" QCHOPPER_RECORD_ORDER " ORDER_LOG=" + log.string() +
                             " " QCHOPPER_DISPATCH_ONCE " " + std::to_string(cell.port()) + " " +
                             (folder.path / "state").string() + " " + (folder.path / "drop").string() + " > " +
                             (folder.path / "out").string();
    EXPECT_EQ(std::system(call.c_str()), 0);
    EXPECT_EQ(cell.status().starts_total, 1U);
    return lines_of(log);
}

TEST(SyncOrder, EveryCommandFollowsASyncOfItsRow) {
    bool has_write = false;
    bool is_synced = false;
    int commands = 0;
    int starts = 0;
    std::string last_frame;
    for (const std::string& line : order_of_dispatch()) {
        if (line.starts_with("wrote ") && line.ends_with("-wal")) {
            has_write = true;
            is_synced = false;
        }
        if (line.starts_with("synced ") && line.ends_with("-wal")) is_synced = has_write;
        const int command = command_in(line);
        if (command == 0 || line.substr(9) == last_frame) continue;  // the same frame again needs no row of its own
        ++commands;
        starts += command == static_cast<int>(CellCommand::start) ? 1 : 0;
        EXPECT_TRUE(has_write) << "no row before " << line;
        EXPECT_TRUE(is_synced) << "the row is not synced before " << line;
        has_write = is_synced = false;
        last_frame = line.substr(9);
    }
    EXPECT_GE(commands, 11);
    EXPECT_EQ(starts, 1);
}

TEST(SyncOrder, AJobFileIsSyncedBeforeItIsRenamed) {
    const auto name_in = [](const std::string& line) { return line.substr(line.rfind('/') + 1); };
    std::set<std::string> synced;
    int renamed = 0;
    for (const std::string& line : order_of_dispatch()) {
        if (line.starts_with("synced ")) synced.insert(name_in(line));
        if (!line.starts_with("renamed ") || line.find(".tmp.") == std::string::npos) continue;
        ++renamed;
        EXPECT_TRUE(synced.contains(name_in(line))) << line;
    }
    EXPECT_GE(renamed, 1);
}

}  // namespace
}  // namespace qchopper
