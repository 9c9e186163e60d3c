#include "sim/cell/script.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "sim/cell/script_run.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

std::string text_of(const ArmedFault& fault) {
    const NamedFault& row = all_faults()[static_cast<std::size_t>(fault.fault)];
    std::string text = std::string("fault ") + row.name;
    if (row.argument[0] != '\0') text += " " + std::to_string(fault.number);
    text += fault.times == 0 ? " always" : " times " + std::to_string(fault.times);
    return text + " chance " + std::to_string(fault.per_thousand / 10);
}

// The line that is parsed so.
std::string to_text(const ScriptLine& line) {
    for (const ActRow& row : all_choices()) {
        if (row.act == line.act) return std::string(row.word) + " " + row.choices[line.choice];
    }
    const std::string number = std::to_string(line.number);
    switch (line.act) {
        case Act::wait:
            return "wait " + number;
        case Act::seed:
            return "seed " + number.substr(0, number.find('.'));
        case Act::fault:
            return text_of(line.fault);
        case Act::clear_faults:
            return "fault clear";
        default:
            return line.act == Act::quit ? "quit" : "show";
    }
}

TEST(Script, EveryLineThatIsUnderstoodPrintsBackAsTheSameLine) {
    std::vector<std::string> texts{"show", "quit", "seed 7", "fault clear", "wait 2.500000"};
    for (const ActRow& row : all_choices()) {
        for (const char* choice : row.choices) texts.push_back(std::string(row.word) + " " + choice);
    }
    for (const NamedFault& row : all_faults()) {
        const std::string number = row.argument[0] == '\0' ? "" : " 42";
        texts.push_back(std::string("fault ") + row.name + number + " times 3 chance 100");
        texts.push_back(std::string("fault ") + row.name + number + " always chance 5");
    }
    for (const std::string& text : texts) {
        const auto line = parse_script_line(text, 1, "s");
        ASSERT_TRUE(line.has_value()) << text;
        EXPECT_EQ(to_text(*line), text);
    }
}

TEST(Script, CommentsEmptyLinesAndSpacesSayNothing) {
    const auto lines = parse_script("# a night\n\n  door   open # now\r\n\tquit", "s");
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].line, 3U);
    EXPECT_EQ(to_text(lines[0]), "door open");
    EXPECT_EQ(lines[1].line, 4U);
}

TEST(Script, AWrongLineIsRefusedWithItsNumber) {
    for (const char* wrong : {"opn door", "door", "door ajar", "wait", "wait -1", "wait nan", "wait for ever", "fault",
                              "fault nothing", "fault exception x", "fault no-answer 3", "fault exception 6 times 0",
                              "fault exception 6 chance 101", "seed -1", "show all", "consent", "y n"}) {
        try {
            parse_script(std::string("show\n") + wrong + "\nquit\n", "night.txt");
            ADD_FAILURE() << wrong;
        } catch (const InputError& fault) {
            EXPECT_EQ(fault.fault, InputFault::config);
            EXPECT_TRUE(std::string(fault.what()).starts_with("night.txt:2: ")) << fault.what();
        }
    }
}

// Rows of a Markdown table: the faults with the meaning of their numbers.
std::string print_faults() {
    std::string out = "| fault | number | usual | what happens |\n|---|---|---|---|\n";
    for (const NamedFault& row : all_faults()) {
        const bool has_number = row.argument[0] != '\0';
        out += std::string("| `") + row.name + "` | " + (has_number ? row.argument : "-") + " | " +
               (has_number ? std::to_string(row.usual) : "-") + " | " + row.meaning + " |\n";
    }
    return out;
}

TEST(Script, ThePageListsEveryFaultAndEveryWord) {
    std::ifstream file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "docs" / "user" / "cell-sim.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find(print_faults()), std::string::npos) << "write print_faults() to docs/user/cell-sim.md";
    for (const ActRow& row : all_choices()) {
        EXPECT_NE(text.str().find(std::string("`") + row.word), std::string::npos) << row.word;
        for (const char* choice : row.choices) EXPECT_NE(text.str().find(choice), std::string::npos) << choice;
    }
}

struct Cell {
    explicit Cell(CellSimOptions options) : sim(std::move(options)) { sim.start(); }
    // Until everything is done; false after quit or if it never ends.
    bool run(const std::string& script) {
        ScriptRun run(sim, [this](const std::string& line) { shown.push_back(line); });
        run.add(parse_script(script, "s"));
        for (int n = 0; n < 100000 && !run.is_idle(); ++n) {
            if (!run.step()) return false;
        }
        return run.is_idle();
    }
    CellSim sim;
    std::vector<std::string> shown;
};

TEST(Script, TheSurroundingsAreShownInStatus) {
    const rig::Folder folder;
    Cell cell(rig::quick_cell(folder.path));
    ASSERT_TRUE(cell.run("clock virtual\ndoor open\npanel local\nblock fresh\nshow\n"));
    const Status status = cell.sim.status();
    EXPECT_TRUE(status.has(flag::safety_open));
    EXPECT_TRUE(status.has(flag::local_control));
    EXPECT_TRUE(status.has(flag::block_loaded));
    ASSERT_EQ(cell.shown.size(), 1U);
    EXPECT_EQ(cell.shown[0].find("Stopped, job none"), 0U) << cell.shown[0];
    ASSERT_TRUE(cell.run("door closed\npanel remote\nblock none\nestop press\nwait for aborted\n"));
    EXPECT_EQ(cell.sim.status().state, PackState::aborted);
    EXPECT_EQ(cell.sim.status().alarm_text, "emergency stop");
    EXPECT_FALSE(cell.run("quit\n"));
}

TEST(Script, AWaitOnAVirtualClockEndsWhenItIsStopped) {
    const rig::Folder folder;
    Cell cell(rig::quick_cell(folder.path));
    int asked = 0;
    ScriptRun run(
        cell.sim, [](const std::string&) {}, [&] { return ++asked > 100; });
    run.add(parse_script("clock virtual\nwait 1000000000\ndoor open\n", "s"));
    EXPECT_TRUE(run.step());
    EXPECT_LE(asked, 110);
    EXPECT_FALSE(cell.sim.status().has(flag::safety_open)) << "what follows is not done";
}

TEST(Script, AVirtualClockGoesOnByWaitOnly) {
    const rig::Folder folder;
    Cell cell(rig::quick_cell(folder.path));
    ASSERT_TRUE(cell.run("clock virtual\n"));
    const Status before = cell.sim.status();
    ASSERT_TRUE(cell.run("wait 3600\n"));
    EXPECT_EQ(cell.sim.status().cell_time_ms - before.cell_time_ms, 3600000U);
    const std::int64_t at_ms = cell.sim.steady_ms();
    EXPECT_EQ(cell.sim.steady_ms(), at_ms);
    ASSERT_TRUE(cell.run("clock real\n"));
    EXPECT_GE(cell.sim.steady_ms(), at_ms);
}

TEST(Script, PowerAndTheStore) {
    const rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    options.store_folder = folder.path / "store";
    Cell cell(std::move(options));
    const auto identity = [&] {
        const auto bus = rig::connect(cell.sim);
        return decode<Identity>(bus->read_input(identity_block.base, identity_block.count).registers).value;
    };
    const Identity first = identity();
    EXPECT_EQ(first.boot_count, 1U);
    ASSERT_TRUE(cell.run("power off\n"));
    EXPECT_TRUE(rig::RawSocket(cell.sim.port()).is_closed_within(2));
    ASSERT_TRUE(cell.run("power on\n"));
    EXPECT_EQ(identity().store_id, first.store_id);
    EXPECT_EQ(identity().boot_count, 2U);
    ASSERT_TRUE(cell.run("power off\npower store-back\n"));
    const Identity older = identity();
    EXPECT_NE(older.store_id, first.store_id) << "its mark is not the one written last";
    EXPECT_EQ(older.boot_count, 1U);
    ASSERT_TRUE(cell.run("power off\npower on\npower off\npower all-back\n"));
    EXPECT_EQ(identity().store_id, older.store_id);
    EXPECT_EQ(identity().boot_count, 1U) << "lower than seen before";
    ASSERT_TRUE(cell.run("power off\npower store-lost\n"));
    EXPECT_NE(identity().store_id, first.store_id);
    EXPECT_EQ(identity().boot_count, 1U);
}

}  // namespace
}  // namespace qchopper
