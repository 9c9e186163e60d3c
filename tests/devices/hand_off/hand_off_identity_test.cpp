// A cell that lost its memory, and a file that was carved before.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

bool has(const std::vector<JournalEvent>& events, JournalKind kind) {
    return std::any_of(events.begin(), events.end(), [kind](const JournalEvent& event) { return event.kind == kind; });
}

HandOffPlan plan_after(const SeenStore& store) {
    HandOffPlan plan = a_plan();
    plan.options.past.store = store;
    return plan;
}

void expect_store_lost(const ScriptedCell& cell, StartOutcome start_outcome) {
    EXPECT_EQ(cell.state.start_outcome, start_outcome);
    EXPECT_TRUE(cell.state.store_is_lost);
    EXPECT_NE(cell.state.why.find("CELL_STORE_LOST"), std::string::npos) << cell.state.why;
    EXPECT_NE(cell.state.to_do.text.find("accept its memory"), std::string::npos) << cell.state.to_do.text;
    EXPECT_TRUE(has(cell.events, JournalKind::store_lost));
    EXPECT_EQ(cell.events.back().kind, JournalKind::closed);
    EXPECT_EQ(cell.events.back().start_outcome, start_outcome);
}

TEST(HandOffIdentity, AnotherStoreThanTheJournalHasSeenGetsNoCommand) {
    const SeenStore sames[] = {{{42}, 0x0101, 1, 0, 0}, {{42}, 0x0101, 1, 0, 0}};
    ScriptedCell same(plan_after(sames[0]));
    end_the_job(same);
    EXPECT_EQ(same.state.start_outcome, StartOutcome::started);
    for (const SeenStore& before : {SeenStore{{41}, 0x0101, 1, 0, 0}, SeenStore{{42}, 0x0101, 2, 0, 0},
                                    SeenStore{{42}, 0x0101, 1, 1, 0}, SeenStore{{42}, 0x0101, 1, 0, 1}}) {
        ScriptedCell cell(plan_after(before));
        cell.run();
        expect_store_lost(cell, StartOutcome::not_started);
        EXPECT_TRUE(cell.written.empty());
    }
}

TEST(HandOffIdentity, AStoreThatNobodyAcceptedGetsNoCommand) {
    HandOffPlan plan = plan_after({{42}, 0x0101, 1, 0, 0});
    plan.options.past.store_is_lost = true;
    ScriptedCell cell(plan);
    cell.run();
    expect_store_lost(cell, StartOutcome::not_started);
    EXPECT_TRUE(cell.written.empty());
}

TEST(Fault, F24_ACellThatComesBackWithAnEmptyStoreIsUnknownOnceStartMayHaveArrived) {
    for (const CellCommand last : {CellCommand::claim, CellCommand::store, CellCommand::prepare, CellCommand::start}) {
        ScriptedCell cell;
        bool is_emptied = false;
        cell.lose = [&](const HandOffAction& action) {
            if (is_emptied || !writes(action, last)) return false;
            is_emptied = true;
            cell.store_id = Uuid{43};
            cell.status = Status{};
            cell.status.cell_id = any_cell_id;
            cell.status.flags = flag::simulated;
            cell.status.state = PackState::stopped;
            cell.status.boot_count = 1;
            cell.result = {};
            return true;
        };
        while (!is_emptied && cell.step()) {
        }
        cell.written.clear();
        cell.run();
        expect_store_lost(cell, last == CellCommand::start ? StartOutcome::unknown : StartOutcome::not_started);
        EXPECT_TRUE(cell.written.empty()) << name(last);
    }
}

// An older copy of all that the cell remembers, of which no number is lower than seen before.
void put_back_and_raise_again(ScriptedCell& cell) {
    cell.grants = {{4711, 1}};
    cell.status.job_id = {};
    cell.status.job_state = JobState::none;
    cell.status.state = PackState::stopped;
    cell.status.owner_held = 0;
    cell.result = {};
}

TEST(Fault, F24_AnOlderMemoryThatAnotherPcRaisedAgainIsALostOne) {
    ScriptedCell cell;
    lose_first_start(cell, [&](const Command& start) {
        EXPECT_EQ(start.epoch, 1U);
        put_back_and_raise_again(cell);
    });
    cell.run();
    expect_store_lost(cell, StartOutcome::unknown);
    EXPECT_NE(cell.state.why.find("CLAIM"), std::string::npos) << cell.state.why;
    EXPECT_EQ(cell.count(CellCommand::start), 0);
}

TEST(Fault, F24_TheNextDispatcherFindsTheOlderMemoryByTheNumberOfTheLastClaim) {
    HandOffPlan plan = plan_after({{42}, 0x0101, 1, 5, 0});
    plan.options.past.grant = 66;
    for (const std::uint32_t number : {66U, 4711U}) {
        ScriptedCell cell(plan);
        cell.status.epoch_held = 5;
        cell.grants[number] = 5;
        if (number == 66) {
            end_the_job(cell);
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
            continue;
        }
        cell.run();
        expect_store_lost(cell, StartOutcome::not_started);
        EXPECT_EQ(cell.order(), "CLAIM QUERY ") << "nothing is stored or started";
        EXPECT_FALSE(has(cell.events, JournalKind::granted)) << "the old number still is to be asked for";
    }
}

TEST(HandOffIdentity, TheNumberOfAClaimIsKeptBeforeTheFirstCommandThatNeedsIt) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::start);
    const auto granted = std::find_if(cell.events.begin(), cell.events.end(),
                                      [](const JournalEvent& event) { return event.kind == JournalKind::granted; });
    ASSERT_NE(granted, cell.events.end());
    EXPECT_EQ(granted->grant, 50001U);
    EXPECT_EQ(granted->epoch, 1U);
    EXPECT_EQ(granted->owner, 77U);
    const auto is_store = [](const JournalEvent& event) {
        return event.kind == JournalKind::command && event.command == CellCommand::store;
    };
    EXPECT_LT(granted, std::find_if(cell.events.begin(), cell.events.end(), is_store));
}

// Also after the end of the job, when its result is known: the next job must not be sent to this memory.
TEST(Fault, F24_ACellThatNoLongerKnowsAJobThatHasStartedHasLostItsMemory) {
    for (const bool has_ended : {false, true}) {
        ScriptedCell cell;
        cell.checks_store = 0;
        cell.run_to(HandOffStep::run);
        if (has_ended) cell.status.job_state = JobState::ended;
        bool is_back = false;
        cell.lose = [&](const HandOffAction& action) {
            if (is_back || action.kind != Kind::read_status) return false;
            is_back = true;
            ++cell.status.boot_count;
            cell.status.job_id = {};
            cell.status.job_state = JobState::none;
            cell.status.state = PackState::stopped;
            cell.result = {};
            return true;
        };
        cell.run();
        expect_store_lost(cell, StartOutcome::started);
    }
}

TEST(Fault, F24_ARestartAroundStartIsUnknownIfTheCellCannotCheckItsStore) {
    for (const std::uint16_t checks_store : {0, 1}) {
        ScriptedCell cell;
        cell.checks_store = checks_store;
        lose_first_start(cell, [&](const Command&) {
            ++cell.status.boot_count;
            cell.status.job_id = {};
            cell.status.job_state = JobState::none;
            cell.status.state = PackState::stopped;
            cell.result = {};
        });
        if (checks_store == 1) {
            end_the_job(cell);
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::started) << cell.state.why;
            continue;
        }
        cell.run();
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown) << cell.state.why;
        EXPECT_NE(cell.state.to_do.text.find("accept its memory"), std::string::npos) << cell.state.to_do.text;
        EXPECT_EQ(cell.count(CellCommand::start), 0);
    }
}

TEST(Fault, F24_ACellEmptiedWhileTheJobRunsIsStillStarted) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::run);
    cell.status.starts_total = 0;
    cell.written.clear();
    cell.run();
    expect_store_lost(cell, StartOutcome::started);
    EXPECT_TRUE(cell.written.empty());
}

TEST(HandOffIdentity, ACellThatRefusesItsIdentityGetsNoCommand) {
    ScriptedCell cell;
    cell.refuse = [](const HandOffAction& action) { return action.kind == Kind::read_identity ? 2 : 0; };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_TRUE(cell.written.empty());
    EXPECT_NE(cell.state.why.find("IDENTITY"), std::string::npos) << cell.state.why;
}

TEST(HandOffIdentity, AfterALostLinkIdentityIsReadBeforeTheNextCommand) {
    ScriptedCell cell;
    bool was_lost = false;
    cell.lose = [&](const HandOffAction& action) {
        const bool now = !was_lost && writes(action, CellCommand::verify);
        was_lost = was_lost || now;
        return now;
    };
    bool is_seen = false;
    while (cell.state.step != HandOffStep::run && cell.step()) {
        if (!was_lost) continue;
        is_seen = is_seen || cell.action.kind == Kind::read_identity;
        if (cell.action.kind == Kind::write_command && !writes(cell.action, CellCommand::verify)) {
            EXPECT_TRUE(is_seen);
        }
    }
    EXPECT_TRUE(is_seen);
    EXPECT_EQ(cell.state.step, HandOffStep::run);
}

ResultRecord carved() {
    ResultRecord before;
    before.job_id = other_job;
    before.state = JobState::ended;
    before.result = JobResult::complete;
    before.starts = 1;
    before.file_sha256.bytes.fill(7);
    return before;
}

TEST(HandOffIdentity, AFileThatWasMilledBeforeIsMilledOnlyWithAgain) {
    ScriptedCell refused;
    refused.milled_before = carved();
    refused.run();
    EXPECT_EQ(refused.state.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(refused.order(), "CLAIM QUERY QUERY_FILE RELEASE ");
    EXPECT_NE(refused.state.why.find(to_text(other_job)), std::string::npos) << refused.state.why;
    EXPECT_EQ(refused.state.to_do.key, "carve_again");
    EXPECT_TRUE(refused.state.milled_before.has_value());

    HandOffPlan plan = a_plan();
    plan.options.again = true;
    ScriptedCell again(plan);
    again.milled_before = carved();
    end_the_job(again);
    EXPECT_EQ(again.state.start_outcome, StartOutcome::started);
    EXPECT_EQ(again.count(CellCommand::prepare), 1);
}

}  // namespace
}  // namespace qchopper
