// The hand-off against the machine itself, in time that is counted and not waited for, with everything going wrong at
// random: writes lost before or after they took effect, answers lost, frames delivered late or twice, power cuts.
//
// Invariant: at most one start; STARTED only if there was one; NOT STARTED only if there was none and none can come any
// more.

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "devices/hand_off/hand_off.h"
#include "sim/cell/modbus_pdu.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

using Kind = HandOffAction::Kind;

constexpr std::uint8_t unit = 1;

struct Odds {
    int lost_before = 0;  // of 1000 requests
    int lost_after = 0;
    int late = 0;  // a lost write that arrives later, on a dead connection
    int twice = 0;
    int power_cut = 0;
    int stop = 0;  // the caller asks to stop
};

class Trial {
 public:
    Trial(std::uint32_t seed, Odds odds) : odds_(odds), random_(seed) {
        limits_.speed = 10;
        hooks_.save = [this](const CellMemory& memory) {
            stored_ = memory;
            return true;
        };
        hooks_.read_marks = [this] { return marks_; };
        hooks_.write_marks = [this](const SaveMarks& marks) {
            marks_ = marks;
            return true;
        };
        boot_cell();
        JobTicket ticket;
        ticket.about.piece_no = ticket.about.piece_count = 1;
        ticket.about.box = {{0, 0, 0}, {10, 10, 10}};
        ticket.about.stock = {10, 10, 10};
        ticket.about.tool_diameter = 6;
        ticket.about.estimated_time_s = 30;
        ticket.file_name = "a.qjob";
        ticket.file_size = 10;
        ticket.file_sha256.bytes.fill(3);
        WireTicket order;
        order.job_id = Uuid{5, 5, 5};
        order.cell_id = any_cell_id;
        order.made_for = 1;
        plan_.ticket = wire_ticket(ticket, order);
        plan_.owner = seed + 1;
        plan_.secret = seed + 2;
    }

    HandOff run() {
        HandOff state;
        HandOffInput input;
        for (int n = 0; n < 20000; ++n) {
            HandOffTransition turn = advance(plan_, std::move(state), input, seconds());
            state = std::move(turn.state);
            for (const std::string& line : turn.lines) log += line + "\n";
            if (turn.action.kind == Kind::finish) {
                ended_s = seconds();
                return state;
            }
            input = act(turn.action);
            if (!stopped_s && happens(odds_.stop)) stopped_s = seconds();
            input.cancelled = stopped_s.has_value();
            if (happens(odds_.power_cut)) {
                log += "  (power cut)\n";
                boot_cell();
            }
        }
        ADD_FAILURE() << "no end\n" << log;
        return state;
    }

    // Whatever is still on its way arrives now, and the world goes on for a while.
    void let_everything_arrive() {
        for (const Bytes& pdu : late_) answer_pdu(unit, pdu, cell_, time_, hooks_);
        late_.clear();
        for (int n = 0; n < 100; ++n) pass(0.5);
    }

    std::uint32_t starts() const { return cell_.memory.starts_total; }
    std::optional<double> stopped_s;  // when the caller asked to stop
    double ended_s = 0;
    std::string log;

 private:
    double seconds() const { return static_cast<double>(time_.steady_ms) / 1000; }
    bool happens(int odds) { return static_cast<int>(random_() % 1000) < odds; }

    void boot_cell() {
        cell_ = boot(limits_, stored_, random_(), time_, hooks_);
        cell_.store_free_kib = 1000;
    }

    void pass(double by_s) {
        time_.steady_ms += static_cast<std::int64_t>(1000 * by_s);
        pass_time(cell_, time_, hooks_);
        // The file is there and right.
        if (cell_.pending && cell_.pending->waits == Pending::Waits::file) {
            const FileCheck check{FileCheck::End::ok, plan_.ticket.file_size, plan_.ticket.file_sha256};
            file_checked(cell_, cell_.pending->number, check, time_, hooks_);
        }
        if (!late_.empty() && happens(100)) {
            const std::size_t which = random_() % late_.size();
            answer_pdu(unit, late_[which], cell_, time_, hooks_);
            if (happens(500)) late_.erase(late_.begin() + static_cast<std::ptrdiff_t>(which));
        }
    }

    static HandOffInput lost() {
        HandOffInput input;
        input.end = BusEnd::lost;
        input.why = "cut";
        return input;
    }

    HandOffInput request(const Bytes& pdu, bool is_write, Registers* registers = nullptr) {
        pass(0.003);
        if (happens(odds_.lost_before)) {
            if (is_write && happens(odds_.late)) late_.push_back(pdu);
            pass(1);
            return lost();
        }
        if (is_write && happens(odds_.twice)) late_.push_back(pdu);
        const Bytes answer = answer_pdu(unit, pdu, cell_, time_, hooks_);
        if (happens(odds_.lost_after)) {
            pass(1);
            return lost();
        }
        EXPECT_EQ(answer[0], pdu[0]);
        for (std::size_t i = 2; registers != nullptr && i + 1 < answer.size(); i += 2) {
            registers->push_back(static_cast<std::uint16_t>(answer[i] << 8 | answer[i + 1]));
        }
        return {};
    }

    HandOffInput write(const Block& block, const Registers& registers) {
        return request(rig::write_request(block.base, registers), true);
    }

    HandOffInput act(const HandOffAction& action) {
        Registers registers;
        HandOffInput input;
        switch (action.kind) {
            case Kind::read_status:
                input = request(rig::read_request(4, status_block.base, status_block.count), false, &registers);
                if (input.end == BusEnd::ok) input.status = decode<Status>(registers).value;
                return input;
            case Kind::read_result:
                input = request(rig::read_request(4, result_block.base, result_block.count), false, &registers);
                if (input.end == BusEnd::ok && decode<ResultRecord>(registers).is_ok())
                    input.result = decode<ResultRecord>(registers).value;
                return input;
            case Kind::read_identity:
                input = request(rig::read_request(4, identity_block.base, identity_block.count), false, &registers);
                if (input.end == BusEnd::ok) input.identity = decode<Identity>(registers).value;
                return input;
            case Kind::write_command:
                return write(command_block, encode(action.command));
            case Kind::write_ticket:
                return write(ticket_block, encode(plan_.ticket));
            case Kind::write_signature:
                return write(signature_block, Registers(signature_block.count, 0));
            case Kind::heartbeat:
                return write(heartbeat_block, encode(action.heartbeat));
            case Kind::wait:
                while (seconds() < action.until_s) pass(0.05);
                return {};
            default:
                return {};
        }
    }

    Odds odds_;
    std::mt19937 random_;
    HandOffPlan plan_;
    CellLimits limits_;
    CellMemory stored_;
    SaveMarks marks_;
    CellHooks hooks_;
    CellTime time_{100000, 1700000000000};
    CellState cell_;
    std::vector<Bytes> late_;
};

struct Tally {
    int started = 0;
    int not_started = 0;
    int unknown = 0;
};

Tally try_many(std::uint32_t seeds, Odds odds) {
    Tally tally;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Trial trial(seed, odds);
        const HandOff end = trial.run();
        const std::uint32_t starts_at_end = trial.starts();
        trial.let_everything_arrive();
        const std::uint32_t starts = trial.starts();
        EXPECT_LE(starts, 1U) << seed << "\n" << trial.log;
        tally.started += end.start_outcome == StartOutcome::started ? 1 : 0;
        tally.not_started += end.start_outcome == StartOutcome::not_started ? 1 : 0;
        tally.unknown += end.start_outcome == StartOutcome::unknown ? 1 : 0;
        if (end.start_outcome == StartOutcome::started) {
            EXPECT_EQ(starts_at_end, 1U) << seed << "\n" << trial.log;
        }
        if (end.start_outcome == StartOutcome::not_started) {
            EXPECT_EQ(starts, 0U) << seed << "\n" << trial.log;
        }
        if (trial.stopped_s) {
            // The last call under way, of a second here, is not cut short by this link.
            EXPECT_LE(trial.ended_s - *trial.stopped_s, 2 + 1.1) << seed << "\n" << trial.log;
        }
        if (testing::Test::HasFailure()) break;
    }
    return tally;
}

TEST(HandOffFaults, WithoutFaultsEveryJobStarts) {
    const Tally tally = try_many(20, {});
    EXPECT_EQ(tally.started, 20);
}

TEST(HandOffFaults, WithALossyLinkTheReportIsTrue) {
    const Tally tally = try_many(1500, {30, 30, 500, 30, 0});
    EXPECT_GT(tally.started, 500);
}

TEST(HandOffFaults, WithAVeryBadLinkTheReportIsStillTrue) {
    const Tally tally = try_many(1500, {80, 80, 800, 200, 0});
    EXPECT_GT(tally.not_started + tally.unknown, 50);
    EXPECT_GT(tally.started, 50);
}

TEST(HandOffFaults, WithPowerCutsTheReportIsTrue) {
    const Tally tally = try_many(1500, {30, 30, 500, 30, 15});
    EXPECT_GT(tally.started, 100);
}

TEST(HandOffFaults, AskedToStopAtAnyMomentTheReportIsTrueAndComesInTime) {
    for (const Odds odds : {Odds{0, 0, 0, 0, 0, 10}, Odds{60, 60, 500, 60, 10, 10}}) {
        const Tally tally = try_many(1500, odds);
        EXPECT_GT(tally.started, 100);
        EXPECT_GT(tally.not_started, 100);
    }
}

}  // namespace
}  // namespace qchopper
