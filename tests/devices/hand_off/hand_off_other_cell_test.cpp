// Another cell that answers in the middle of a hand-off, and an IDENTITY that never comes whole.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

// What turns the cell into another one, and a word of it.
struct Change {
    void (*apply)(Status&);
    const char* word;
};
constexpr Change changes[] = {
    {[](Status& s) { s.cell_id = 9; }, "CELL_ID 9"},
    {[](Status& s) { s.flags = static_cast<std::uint16_t>(s.flags & ~flag::simulated); }, "real"}};

TEST(HandOffOtherCell, ThatAnswersBeforeStartGetsNoStart) {
    for (const Change& change : changes) {
        for (const CellCommand last :
             {CellCommand::claim, CellCommand::store, CellCommand::verify, CellCommand::prepare}) {
            ScriptedCell cell;
            cell.grant = [&](const Command& command) {
                if (command.command == last) change.apply(cell.status);
                return AckResult::ok;
            };
            cell.run();
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started) << name(last);
            EXPECT_EQ(cell.commands.back().command, last) << "nothing more is sent: " << cell.order();
            EXPECT_NE(cell.state.why.find("another cell answers now"), std::string::npos) << cell.state.why;
            EXPECT_NE(cell.state.why.find(change.word), std::string::npos) << cell.state.why;
            EXPECT_FALSE(cell.state.to_do.empty());
        }
    }
}

TEST(HandOffOtherCell, ThatAnswersAfterStartLeavesTheVerdictToTheFirst) {
    for (const Change& change : changes) {
        ScriptedCell lost;  // START may have arrived
        lose_first_start(lost, [&](const Command&) { change.apply(lost.status); });
        lost.run();
        EXPECT_EQ(lost.state.start_outcome, StartOutcome::unknown) << lost.state.why;
        EXPECT_EQ(lost.count(CellCommand::claim), 1) << "the other cell is not claimed";
        ScriptedCell running;
        running.run_to(HandOffStep::run);
        while (running.step() && !running.state.is_started) {
        }
        change.apply(running.status);
        running.run();
        EXPECT_EQ(running.state.start_outcome, StartOutcome::started) << running.state.why;
        EXPECT_EQ(running.commands.back().command, CellCommand::start);
    }
}

// The answer to the read of IDENTITY is damaged from then on.
void damage_identity(ScriptedCell& cell) {
    cell.lose = [](const HandOffAction& action) { return action.kind == Kind::read_identity; };
}

bool step_with_damage(ScriptedCell& cell) {
    const bool goes_on = cell.step();
    if (cell.action.kind == Kind::read_identity && cell.input.end == BusEnd::lost) cell.input.fault = BlockFault::crc;
    return goes_on;
}

TEST(HandOffBadIdentity, EndsAfterAFewTriesWithAnErrorOfTheProtocol) {
    ScriptedCell cell;
    damage_identity(cell);
    int reads = 0;
    while (step_with_damage(cell) && cell.now_s < 10'000) reads += cell.action.kind == Kind::read_identity ? 1 : 0;
    EXPECT_EQ(cell.action.kind, Kind::finish) << "it is tried for ever";
    EXPECT_LE(reads, 5);
    EXPECT_EQ(cell.state.fault, DeviceFault::protocol);
    EXPECT_NE(cell.state.why.find("IDENTITY cannot be read: it is damaged (checksum)"), std::string::npos)
        << cell.state.why;
    EXPECT_TRUE(cell.written.empty());
}

TEST(HandOffBadIdentity, AfterALostStartIsUnknown) {
    ScriptedCell cell;
    bool is_lost = false;
    cell.lose = [&](const HandOffAction& action) {
        const bool is_start = writes(action, CellCommand::start);
        is_lost = is_lost || is_start;
        return is_start || (is_lost && action.kind == Kind::read_identity);
    };
    while (step_with_damage(cell) && cell.now_s < 10'000) {
    }
    EXPECT_EQ(cell.action.kind, Kind::finish);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown);
    EXPECT_FALSE(cell.state.fault.has_value()) << "an outcome, not an error";
}

TEST(HandOffBadIdentity, OnceIsReadAgain) {
    ScriptedCell cell;
    int reads = 0;
    cell.lose = [&](const HandOffAction& action) { return action.kind == Kind::read_identity && ++reads <= 2; };
    while (cell.state.step != HandOffStep::run && step_with_damage(cell)) {
    }
    EXPECT_EQ(cell.state.step, HandOffStep::run);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
}

}  // namespace
}  // namespace qchopper
