// A job of an earlier dispatcher taken up; another dispatcher that takes the cell over; requests of other programs.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

HandOffPlan adopting(bool may_have_arrived) {
    HandOffPlan plan = a_plan();
    plan.adopts = true;
    plan.options.past.epoch = 5;
    plan.options.past.seq = 50;
    plan.options.past.is_stored = true;
    plan.options.past.start_sent = may_have_arrived;
    return plan;
}

void hold(ScriptedCell& cell, JobState state) {
    cell.status.job_id = job;
    cell.status.job_state = state;
    cell.status.state = state == JobState::running ? PackState::execute : PackState::idle;
    cell.status.epoch_held = 5;
}

TEST(HandOffAdopt, AJobThatWasNotStartedIsCancelled) {
    for (const JobState state : {JobState::stored, JobState::prepared}) {
        ScriptedCell cell(adopting(true));
        hold(cell, state);
        cell.run();
        EXPECT_EQ(cell.order(), "CLAIM QUERY CANCEL RELEASE ");
        EXPECT_EQ(cell.commands[0].epoch, 6U);
        EXPECT_EQ(cell.commands[0].seq, 51U);
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
        EXPECT_TRUE(std::any_of(cell.events.begin(), cell.events.end(),
                                [](const JournalEvent& event) { return event.kind == JournalKind::start_void; }));
    }
}

TEST(HandOffAdopt, ARunningJobIsFollowedToItsEnd) {
    ScriptedCell cell(adopting(true));
    hold(cell, JobState::running);
    end_the_job(cell);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_EQ(cell.count(CellCommand::start), 0);
    ASSERT_TRUE(cell.state.result.has_value());
    EXPECT_EQ(cell.state.result->result, JobResult::complete);
}

TEST(HandOffAdopt, WithoutAnAnswerItStaysUnknown) {
    for (const bool may_have_arrived : {true, false}) {
        ScriptedCell cell(adopting(may_have_arrived));
        cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
        cell.run();
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown) << "the journal may have lost the row of START";
        EXPECT_EQ(cell.events.back().start_outcome, StartOutcome::unknown);
    }
}

// Whatever ends the hand-off before QUERY has answered after a CLAIM that was granted.
TEST(HandOffAdopt, NotStartedIsSaidOnlyAfterTheFence) {
    using Spoil = std::function<void(ScriptedCell&)>;
    const auto answers = [](CellCommand to, AckResult answer) {
        return [=](ScriptedCell& cell) {
            cell.grant = [=](const Command& c) { return c.command == to ? answer : AckResult::ok; };
        };
    };
    const std::vector<std::pair<const char*, Spoil>> spoils{
        {"nothing", [](ScriptedCell&) {}},
        {"CLAIM is not acknowledged", answers(CellCommand::claim, AckResult::none)},
        {"another dispatcher holds the lease", answers(CellCommand::claim, AckResult::lease_busy)},
        {"CLAIM is refused", answers(CellCommand::claim, AckResult::epoch_jump)},
        {"QUERY is not acknowledged", answers(CellCommand::query, AckResult::none)},
        {"QUERY is refused", answers(CellCommand::query, AckResult::local_control)},
        {"exception at CLAIM",
         [](ScriptedCell& cell) {
             cell.refuse = [](const HandOffAction& action) { return writes(action, CellCommand::claim) ? 4 : 0; };
         }},
        {"no RESULT",
         [](ScriptedCell& cell) {
             cell.refuse = [](const HandOffAction& action) { return action.kind == Kind::read_result ? 2 : 0; };
         }},
        {"the RESULT of another query",
         [](ScriptedCell& cell) { cell.change_result = [](ResultRecord& result) { result.query_owner = 1; }; }},
        {"another cell", [](ScriptedCell& cell) { cell.status.cell_id = 9; }},
        {"a real cell", [](ScriptedCell& cell) { cell.status.flags = 0; }},
        {"another memory",
         [](ScriptedCell& cell) {
             cell.plan.options.past.store = SeenStore{{41}, 0x0101, 1, 5, 0};
         }},
        {"a frozen cell", [](ScriptedCell& cell) { cell.freeze_s = cell.now_s; }},
        {"a request to stop at once", [](ScriptedCell& cell) { cell.cancelled = true; }},
        {"a request to stop, no answer", [](ScriptedCell& cell) {
             cell.cancelled = true;
             cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
         }}};
    for (const auto& [what, spoil] : spoils) {
        HandOffPlan plan = adopting(false);
        plan.options.past.is_stored = false;  // as if the journal ended with the row that made the job
        ScriptedCell cell(plan);
        hold(cell, JobState::stored);
        spoil(cell);
        bool has_claimed = false;
        bool is_asked = false;
        while (cell.step()) {
            has_claimed = has_claimed || cell.state.is_owner;
            is_asked = is_asked || (has_claimed && cell.input.result && cell.input.result->query_owner == 77);
        }
        EXPECT_FALSE(cell.state.is_started) << what;
        EXPECT_EQ(cell.state.start_outcome, is_asked ? StartOutcome::not_started : StartOutcome::unknown)
            << what << ": " << cell.state.why;
        EXPECT_EQ(cell.events.back().start_outcome, cell.state.start_outcome) << what;
        EXPECT_TRUE(!cell.cancelled || cell.now_s < 102.1) << what << cell.now_s;
    }
}

// The cell has had the numbers to 80 of this owner; the journal does not know the last `rows` of them.
HandOffPlan behind_by(std::uint32_t rows) {
    HandOffPlan plan = adopting(false);
    plan.options.past.seq = 80 - rows;
    plan.options.past.is_stored = false;
    return plan;
}

void has_had(ScriptedCell& cell, CellCommand last, std::uint32_t epoch) {
    Command command;
    command.command = last;
    command.owner = cell.plan.owner;
    command.seq = 80;
    command.epoch = epoch;
    cell.last_of_owner[command.owner] = command;
    cell.acknowledge(command);
    cell.status.epoch_held = epoch;
}

TEST(HandOffAdopt, AJournalThatLostItsLastRowsLearnsThatTheJobHasRun) {
    for (const std::uint32_t rows : {1U, 2U, 30U}) {
        for (const bool is_shown : {true, false}) {
            ScriptedCell cell(behind_by(rows));
            has_had(cell, CellCommand::release, 6);
            if (!is_shown) cell.status.ack_owner = 4711;  // another client has asked since
            cell.change_result = [](ResultRecord& result) {
                result.state = JobState::ended;
                result.result = JobResult::complete;
                result.starts = 1;
            };
            cell.run();
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::started) << rows << " " << cell.state.why;
            ASSERT_TRUE(cell.state.result.has_value()) << rows;
            EXPECT_EQ(cell.state.result->starts, 1U);
            ASSERT_FALSE(cell.commands.empty());
            EXPECT_EQ(cell.commands.front().command, CellCommand::claim);
            for (const Command& command : cell.commands) EXPECT_GT(command.seq, 80U) << "none that the cell has had";
        }
    }
}

// The acknowledgement of an earlier CLAIM comes into STATUS again, under the number of the present one: a frame that
// was repeated. The START of then may still be on its way.
TEST(HandOffAdopt, TheAcknowledgementOfAnEarlierClaimIsNoFence) {
    ScriptedCell cell(behind_by(1));
    has_had(cell, CellCommand::claim, 6);
    const Status shown = cell.status;
    cell.status.ack_owner = 4711;
    hold(cell, JobState::prepared);
    cell.status.epoch_held = 6;
    cell.lose = [&](const HandOffAction& action) {
        if (writes(action, CellCommand::claim) && action.command.seq == 80) cell.status.ack_owner = shown.ack_owner;
        return false;
    };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started) << cell.state.why;
    EXPECT_GT(cell.status.epoch_held, 6U) << "NOT STARTED without a CLAIM that makes the START before void";
    EXPECT_EQ(cell.count(CellCommand::claim), 1);
}

TEST(HandOff, ANewJobStartsThoughTheJournalLostItsLastRows) {
    HandOffPlan plan = behind_by(30);
    plan.adopts = false;
    ScriptedCell cell(plan);
    has_had(cell, CellCommand::release, 6);
    cell.status.ack_owner = 4711;
    end_the_job(cell);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started) << cell.state.why;
    EXPECT_EQ(cell.count(CellCommand::start), 1);
}

TEST(Fault, F34_ATakeoverWhileStartIsUnderWayIsAnsweredByQuery) {
    for (const bool has_arrived : {true, false}) {
        ScriptedCell cell;
        bool is_taken = false;
        lose_first_start(cell, [&](const Command& start) {
            if (has_arrived) cell.execute(start);
            if (!has_arrived) cell.status.job_state = JobState::stored;
            cell.status.owner_held = 0xABCD;
            is_taken = true;
        });
        cell.grant = [&](const Command& c) {
            return is_taken && c.command == CellCommand::claim ? AckResult::lease_busy : AckResult::ok;
        };
        while (!(is_taken && cell.state.step == HandOffStep::run) && cell.step()) {
        }
        if (has_arrived) {
            EXPECT_EQ(cell.state.step, HandOffStep::run);
            EXPECT_TRUE(cell.state.is_started);
            cell.status.job_state = JobState::ended;
            cell.result.result = JobResult::complete;
        }
        cell.run();
        EXPECT_EQ(cell.state.start_outcome, has_arrived ? StartOutcome::started : StartOutcome::not_started);
        EXPECT_EQ(cell.count(CellCommand::start), has_arrived ? 1 : 0);
        EXPECT_EQ(cell.count(CellCommand::clear_result), 0);  // no lease
    }
}

TEST(Fault, F33_ABusyLeaseNamesItsOwner) {
    ScriptedCell cell;
    cell.status.owner_held = 0xABCD;
    cell.grant = [](const Command&) { return AckResult::lease_busy; };
    cell.run();
    EXPECT_EQ(cell.state.fault, DeviceFault::busy);
    EXPECT_NE(cell.state.why.find("0x0000ABCD"), std::string::npos) << cell.state.why;
    EXPECT_NE(cell.state.why.find("LEASE_BUSY"), std::string::npos) << cell.state.why;
}

TEST(HandOffRequest, UnholdIsPassedOnWhileTheJobRuns) {
    for (const AckResult answer : {AckResult::ok, AckResult::no_consent, AckResult::none}) {
        ScriptedCell cell;
        cell.run_to(HandOffStep::run);
        cell.step();
        cell.grant = [&](const Command& c) { return c.command == CellCommand::unhold ? answer : AckResult::ok; };
        cell.request = CellCommand::unhold;
        while (!cell.request_answer && cell.step()) {
        }
        ASSERT_TRUE(cell.request_answer);
        EXPECT_EQ(cell.request_answer->end, answer == AckResult::ok           ? CommandEnd::done
                                            : answer == AckResult::no_consent ? CommandEnd::refused
                                                                              : CommandEnd::unknown);
        EXPECT_NE(cell.request_answer->why.find(answer == AckResult::ok           ? ""
                                                : answer == AckResult::no_consent ? "NO_CONSENT"
                                                                                  : "ask the cell"),
                  std::string::npos)
            << cell.request_answer->why;
        EXPECT_GE(cell.count(CellCommand::unhold), 1);
        EXPECT_EQ(cell.state.step, HandOffStep::run);  // the job is followed as before
        cell.grant = nullptr;
        end_the_job(cell);
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    }
}

TEST(HandOffRequest, AtOtherStepsAndUnderLocalControlItIsRefused) {
    ScriptedCell early;
    early.run_to(HandOffStep::prepare);
    early.request = CellCommand::unhold;
    while (!early.request_answer && early.step()) {
    }
    ASSERT_TRUE(early.request_answer);
    EXPECT_EQ(early.request_answer->end, CommandEnd::refused);
    EXPECT_EQ(early.count(CellCommand::unhold), 0);

    ScriptedCell local;
    local.run_to(HandOffStep::run);
    local.status.flags |= flag::local_control;
    for (int n = 0; n < 5; ++n) local.step();
    local.request = CellCommand::unhold;
    while (!local.request_answer && local.step()) {
    }
    ASSERT_TRUE(local.request_answer);
    EXPECT_EQ(local.request_answer->end, CommandEnd::refused);
    EXPECT_NE(local.request_answer->why.find("LOCAL_CONTROL"), std::string::npos) << local.request_answer->why;
    EXPECT_EQ(local.count(CellCommand::unhold), 0);
}

}  // namespace
}  // namespace qchopper
