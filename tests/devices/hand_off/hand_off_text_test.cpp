// What the operator reads at the end of a hand-off: what happened, whether foam is being cut, and what to do; and that
// the sentences hold where they are said.

#include "devices/hand_off/hand_off.h"

#include "devices/hand_off/operator_text.h"
#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

constexpr const char* address = "10.0.0.7:502";

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

bool says(const ScriptedCell& cell, const std::string& words) {
    return std::any_of(cell.lines.begin(), cell.lines.end(), [&](const std::string& line) { return has(line, words); });
}

HandOffPlan real_plan() {
    HandOffPlan plan = a_plan();
    plan.options.want_simulated = false;
    plan.options.address = address;
    return plan;
}

ScriptedCell real_cell(const HandOffPlan& plan = real_plan()) {
    ScriptedCell cell(plan);
    cell.status.flags = 0;
    return cell;
}

// The end of any hand-off.
void expect_helpful(const ScriptedCell& cell, const std::string& what) {
    const HandOff& h = cell.state;
    ASSERT_EQ(h.step, HandOffStep::finished) << what;
    const bool is_over = cell.status.job_id == job && cell.status.job_state >= JobState::ended;
    const std::string foam = h.start_outcome == StartOutcome::not_started ? "the cell cuts no foam for this job"
                             : h.start_outcome == StartOutcome::unknown   ? "the cell may be cutting foam"
                             : is_over                                    ? "the cell no longer cuts foam"
                                                                          : "foam";
    EXPECT_TRUE(has(h.why, foam)) << what << ": " << h.why;
    EXPECT_FALSE(h.why.starts_with("; ")) << what << ": nothing of what happened\n" << h.why;
    const bool is_complete = is_over && h.start_outcome == StartOutcome::started;
    EXPECT_TRUE(is_complete || !h.to_do.empty()) << what << ": " << h.why;
    if (h.start_outcome == StartOutcome::unknown) {
        EXPECT_EQ(h.to_do.key, "look_first") << what;
        ASSERT_EQ(h.to_do.values.size(), 2U) << what;
        EXPECT_EQ(h.to_do.values[0].text, "10.0.0.7:502") << what;
        EXPECT_FALSE(h.to_do.values[1].empty()) << what;
    }
    for (const char* jargon : {"repeatedly", "the effect of the last request", "nothing was started"}) {
        EXPECT_FALSE(has(h.why, jargon)) << what << ": " << h.why;
        EXPECT_FALSE(says(cell, jargon)) << what;
    }
}

TEST(HandOffWords, EveryEndSaysWhatHappenedWhetherFoamIsCutAndWhatToDo) {
    int ends = 0;
    const auto run = [&](const std::string& what, const std::function<void(ScriptedCell&)>& spoil) {
        for (const bool adopts : {false, true}) {
            ScriptedCell cell = real_cell();
            cell.plan.adopts = adopts;
            spoil(cell);
            while (cell.step()) {
                if (cell.now_s > 300 && cell.status.job_state == JobState::running) {
                    cell.status.job_state = JobState::ended;
                    cell.status.job_result = JobResult::complete;
                    cell.status.state = PackState::complete;
                }
            }
            expect_helpful(cell, what + (adopts ? ", adopted" : ""));
            ++ends;
        }
    };
    for (const CellCommand command : all_commands) {
        for (const AckResult answer :
             {AckResult::none, AckResult::pending, AckResult::lease_busy, AckResult::stale_epoch, AckResult::not_owner,
              AckResult::wrong_state, AckResult::local_control, AckResult::no_consent, AckResult::tool,
              AckResult::busy_other_job, AckResult::token_expired, AckResult::internal}) {
            run(std::string(name(command)) + " answered " + name(answer), [=](ScriptedCell& cell) {
                cell.grant = [=](const Command& c) { return c.command == command ? answer : AckResult::ok; };
            });
        }
        for (const int exception : {2, 4, 6}) {
            run(std::string("exception to ") + name(command), [=](ScriptedCell& cell) {
                cell.refuse = [=](const HandOffAction& action) { return writes(action, command) ? exception : 0; };
            });
        }
        run(std::string("link lost for good at ") + name(command), [=](ScriptedCell& cell) {
            cell.lose = [=, is_lost = false](const HandOffAction& action) mutable {
                is_lost = is_lost || writes(action, command);
                return is_lost && action.kind != Kind::wait;
            };
        });
        run(std::string("link lost at each ") + name(command), [=](ScriptedCell& cell) {
            cell.lose = [=](const HandOffAction& action) { return writes(action, command); };
        });
        run(std::string("frozen at ") + name(command), [=](ScriptedCell& cell) {
            cell.lose = [=, &cell](const HandOffAction& action) {
                if (writes(action, command) && cell.freeze_s == 0) cell.freeze_s = cell.now_s;
                if (cell.now_s > 300) cell.freeze_s = 0;
                return false;
            };
        });
    }
    run("another cell", [](ScriptedCell& cell) { cell.status.cell_id = 9; });
    run("no answer",
        [](ScriptedCell& cell) { cell.lose = [](const HandOffAction& a) { return a.kind != Kind::wait; }; });
    run("carved before", [](ScriptedCell& cell) { cell.milled_before = ResultRecord{}; });
    EXPECT_GT(ends, 600);
}

TEST(HandOffWords, ALinkThatIsLostAgainAndAgainIsNamedWithItsNumber) {
    ScriptedCell cell = real_cell();
    cell.lose = [](const HandOffAction& action) { return writes(action, CellCommand::store); };
    cell.run();
    EXPECT_TRUE(has(cell.state.why, "was interrupted 4 times")) << cell.state.why;
    EXPECT_TRUE(has(cell.state.why, "the link to the cell was lost")) << cell.state.why;
}

TEST(HandOffWords, ACommandWithoutAcknowledgementIsNamedByWhatItAsks) {
    ScriptedCell cell = real_cell();
    cell.grant = [](const Command& c) { return c.command == CellCommand::claim ? AckResult::none : AckResult::ok; };
    cell.run();
    EXPECT_TRUE(has(cell.state.why, "CLAIM (take this computer as its dispatcher)")) << cell.state.why;
    EXPECT_TRUE(has(cell.state.why, "for 10 s")) << cell.state.why;
    EXPECT_TRUE(has(cell.state.to_do.text, "panel")) << cell.state.to_do.text;
}

TEST(HandOffWords, ACellThatFreezesAfterTheEndOfTheJobIsNotWaitedForWithoutEnd) {
    for (const JobState end : {JobState::ended, JobState::aborted}) {
        ScriptedCell cell = real_cell();
        cell.run_to(HandOffStep::run);
        cell.step();
        cell.status.job_state = end;
        cell.status.job_result = end == JobState::ended ? JobResult::complete : JobResult::aborted;
        cell.status.state = end == JobState::ended ? PackState::complete : PackState::aborted;
        cell.freeze_s = cell.now_s;
        const double began_s = cell.now_s;
        cell.run();
        EXPECT_LT(cell.now_s - began_s, 35);
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
        EXPECT_FALSE(says(cell, "CELL FROZEN")) << "the job has ended";
        EXPECT_TRUE(has(cell.state.why, "the job has ended")) << cell.state.why;
        EXPECT_TRUE(has(cell.state.why, "no longer cuts foam")) << cell.state.why;
        EXPECT_TRUE(has(cell.state.to_do.text, "controller")) << cell.state.to_do.text;
    }
}

TEST(HandOffWords, ACellThatFreezesWhileTheJobRunsIsFollowed) {
    ScriptedCell cell = real_cell();
    cell.run_to(HandOffStep::run);
    cell.step();
    cell.freeze_s = cell.now_s;
    const double began_s = cell.now_s;
    while (cell.now_s < began_s + 100) ASSERT_TRUE(cell.step()) << cell.state.why;
    EXPECT_TRUE(says(cell, "CELL FROZEN")) << "it may not notice what happens";
    EXPECT_TRUE(says(cell, "the cell may still be cutting foam"));
    cell.freeze_s = 0;
    end_the_job(cell);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
}

TEST(HandOffWords, ALostLinkSaysWhetherFoamIsCutInTheMeantime) {
    for (const bool is_running : {false, true}) {
        ScriptedCell cell = real_cell();
        cell.run_to(is_running ? HandOffStep::run : HandOffStep::prepare);
        bool is_lost = false;
        cell.lose = [&](const HandOffAction& action) {
            const bool now = !is_lost && action.kind == Kind::read_status;
            is_lost = is_lost || now;
            return now;
        };
        while (!is_lost && cell.step()) {
        }
        cell.step();
        EXPECT_TRUE(says(cell, is_running ? "trying again; the cell may still be cutting foam"
                                          : "trying again; the cell cuts no foam for this job"));
    }
}

// Nobody consented, as against a machine that did not do its work in time.
TEST(HandOffWords, PatienceThatEndsNamesWhoWasWaitedFor) {
    for (const CellCommand command : {CellCommand::prepare, CellCommand::verify}) {
        ScriptedCell cell = real_cell();
        cell.grant = [=](const Command& c) { return c.command == command ? AckResult::pending : AckResult::ok; };
        cell.run();
        EXPECT_EQ(has(cell.state.why, "nobody at the cell consented"), command == CellCommand::prepare)
            << cell.state.why;
        EXPECT_EQ(has(cell.state.why, "VERIFY"), command == CellCommand::verify) << cell.state.why;
    }
}

TEST(HandOffWords, AFolderThatCannotTakeTheFileEndsTheHandOffBeforeTheCellIsClaimed) {
    HandOffPlan plan = real_plan();
    plan.ticket.transfer = Transfer::drop_folder;
    ScriptedCell cell = real_cell(plan);
    while (cell.step()) {
        if (cell.action.kind == Kind::stage_file) cell.input.why = "there is no drop folder /mnt/cell";
    }
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_TRUE(has(cell.state.why, "there is no drop folder /mnt/cell")) << cell.state.why;
    EXPECT_TRUE(has(cell.state.to_do.text, "drop folder")) << cell.state.to_do.text;
    EXPECT_EQ(cell.order(), "");
    EXPECT_EQ(cell.events.back().kind, JournalKind::closed) << "the job does not stay open";
}

TEST(OperatorWords, FoamIsCutInTheStatesInWhichTheMachineMills) {
    for (std::uint16_t number = 0; number <= last_pack_state; ++number) {
        const auto state = static_cast<PackState>(number);
        const std::string clause = foam_in(state);
        // What goes on to Execute or comes from it by itself moves; a state without an active job does not.
        const bool goes_to_execute = after_done(state) == PackState::execute;
        const bool carves = state == PackState::execute || after_done(PackState::execute) == state || goes_to_execute;
        EXPECT_EQ(clause == "the cell is cutting foam", carves) << name(state);
        const bool comes_to_a_stop = after_done(state) == PackState::stopped ||
                                     after_done(state) == PackState::aborted || after_done(state) == PackState::held ||
                                     after_done(state) == PackState::suspended;
        EXPECT_TRUE(!has_active_job(state) || !comes_to_a_stop || has(clause, "coming to a stop")) << name(state);
        if (!has_active_job(state) && state != PackState::undefined && state != PackState::aborting) {
            EXPECT_EQ(clause, "the cell cuts no foam") << name(state);
        }
    }
}

TEST(OperatorWords, CommandsAndDispatchersAreNamed) {
    EXPECT_EQ(in_words(CellCommand::stop), "Stop");
    EXPECT_EQ(dispatcher_name(0xAB), "dispatcher 0x000000AB");
}

TEST(OperatorWords, WhereTheProgramIsIsToldByChunkAndLine) {
    Status status;
    status.block_no = 3'000'412;
    status.tool_no = 2;
    status.tip = {1000, -450, 12000};
    status.remaining_s = 720;
    EXPECT_EQ(program_place(status), "chunk 3, line 412, tool 2 at X 10.00 Y -4.50 Z 120.00 mm, 12 min left");
    status.block_no = 57;
    status.remaining_s = Status::unknown_s;
    EXPECT_EQ(program_place(status), "block 57, tool 2 at X 10.00 Y -4.50 Z 120.00 mm");
}

}  // namespace
}  // namespace qchopper
