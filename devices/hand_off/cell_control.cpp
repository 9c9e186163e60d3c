// CLAIM, the command, RELEASE, each repeated as the same frame until its acknowledgement is in STATUS: the cell
// executes a frame once, however often it arrives. Everything runs in the caller's thread. O(1) for each poll.

#include "devices/hand_off/cell_control.h"

#include <chrono>
#include <thread>

#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/operator_text.h"
#include "devices/hand_off/random.h"
#include "devices/hand_off/seen_store.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = ControlEnd::Kind;

constexpr double lost_s = 0.25;  // until a frame that may not have arrived is sent again: the cell executes it once

Clock::time_point after(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

bool needs_job(CellCommand command) {
    return command == CellCommand::stop || command == CellCommand::hold || command == CellCommand::unhold;
}

bool is_answered(AckResult result) {
    return result == AckResult::ok || result == AckResult::already || is_refusal(result);
}

class Control {
 public:
    Control(RegisterBus& bus, const Status& status, const ControlOrder& order, const Context& context)
        : bus_(bus), order_(order), context_(context) {
        end_.status = status;
        owner_ = order.past.owner != 0 ? order.past.owner : random_number();
        secret_ = order.past.owner != 0 ? order.past.secret : random_number();
        seq_ = order.past.owner != 0 ? order.past.seq : 0;
    }

    ControlEnd run() {
        command_the_cell();
        const bool may_move = end_.kind == Kind::unknown && has_active_job(end_.status.state);
        end_.why += std::string("; ") + (may_move ? "the cell may be cutting foam" : foam_in(end_.status.state));
        end_.to_do = to_do();
        return end_;
    }

 private:
    void command_the_cell() {
        if (refuse_here()) return;
        const bool is_claim = order_.command == CellCommand::claim;
        if (needs_lease(order_.command) && !claim()) return;
        if (!is_claim) send(order_.command, order_.timings.consent_s);
        if (!is_leased_) return;
        const ControlEnd wanted = end_;
        send(CellCommand::release, order_.timings.leave_s);
        const Status last = end_.status;
        end_ = wanted;
        end_.status = last;
    }

    Sentence to_do() const {
        const std::string& address = order_.address;
        const bool stops = !needs_lease(order_.command);  // Stop, Hold, Abort
        if (end_.kind == Kind::done) return {};
        if (end_.kind == Kind::unknown && stops) {
            return Sentence::with_key(
                "stop_then_ask_cell", {address},
                "If the machine must stop now, press the red button at the cell. Then ask the cell.");
        }
        if (end_.kind == Kind::unknown) {
            return Sentence::with_key("look_then_ask_cell", {address}, "Look at the cell, then ask it.");
        }
        if (is_store_lost_) {
            return Sentence::with_key("look_then_accept_store", {address}, "Look at the cell, then accept its memory.");
        }
        switch (end_.result) {
            case AckResult::local_control:
                return stops ? "Stop the machine by its panel, in danger by the red button: it takes no commands from "
                               "here."
                             : "Use the panel of the cell, or set it to remote.";
            case AckResult::lease_busy:
                return wait_or_take_over(address);
            case AckResult::no_consent:
                return "Ask the operator at the cell, then send it again.";
            case AckResult::safety_open:
                return "Close the door and release the emergency stop, then send it again.";
            default:
                return Sentence::with_key("see_cell", {address}, "See what the cell shows.");
        }
    }

    bool is_cancelled() const { return context_.cancelled != nullptr && context_.cancelled->load(); }

    bool refuse(AckResult result, const std::string& why) {
        end_.kind = Kind::refused;
        end_.result = result;
        end_.why = why;
        return true;
    }

    bool refuse_here() {
        const Status& status = end_.status;
        if (status.has(flag::local_control)) {
            return refuse(AckResult::local_control,
                          "the cell is under local control (LOCAL_CONTROL); nothing was sent");
        }
        if (needs_job(order_.command) && !has_active_job(status.state)) {
            return refuse(AckResult::wrong_state, std::string("no job is active, the cell is in ") +
                                                      name(status.state) + " (WRONG_STATE); nothing was sent");
        }
        if (!needs_lease(order_.command)) return false;
        if (const std::string lost = loss_of_store(); !lost.empty()) {
            is_store_lost_ = true;
            return refuse(AckResult::none, "CELL_STORE_LOST: " + lost + "; nothing was sent");
        }
        return false;
    }

    // What shows that the cell lost its memory, or "".
    std::string loss_of_store() {
        if (order_.past.store_is_lost) return "nobody has accepted the new memory of the cell";
        const std::optional<SeenStore> now = read_store(bus_);
        if (!now) return "its IDENTITY cannot be read";
        if (order_.past.store) {
            if (std::string what = loss_between(*order_.past.store, *now); !what.empty()) return what;
        }
        keep(JournalKind::identity, [&](JournalEvent& event) { event.store = *now; });
        return {};
    }

    template <class Fill>
    void keep(JournalKind kind, const Fill& fill) {
        if (!order_.journal) return;
        JournalEvent event;
        event.kind = kind;
        fill(event);
        order_.journal(event);
    }

    bool claim() {
        constexpr int max_claims = 4;
        for (int claims = 1;; ++claims) {
            epoch_ = std::max(order_.past.epoch, end_.status.epoch_held) + 1;
            seq_ = number_after(end_.status, owner_, seq_);
            bad_frames_ = end_.status.bad_frames;
            send(CellCommand::claim, order_.timings.answer_s);
            if (!has_stale_number_ || claims == max_claims) break;
            seq_ += skipped_numbers;
        }
        is_leased_ = end_.kind == Kind::done;
        if (end_.result == AckResult::lease_busy) {
            end_.why += "; " + dispatcher_name(end_.status.owner_held) + " holds the cell";
        }
        return is_leased_;
    }

    Command command_for(CellCommand command) {
        Command frame;
        frame.command = command;
        frame.epoch = epoch_;
        frame.seq = ++seq_;
        frame.owner = owner_;
        if (needs_job(command)) frame.job_id = end_.status.job_id;
        if (command == CellCommand::abort) frame.job_id.fill(0xFF);
        if (command == CellCommand::claim) {
            frame.arg0 = order_.takeover_code;
            frame.arg1 = secret_;
        }
        if (needs_lease(order_.command)) {
            const JournalKind kind = command == CellCommand::claim ? JournalKind::claim : JournalKind::command;
            keep(kind, [&](JournalEvent& event) {
                event.job_id = frame.job_id;
                event.command = command;
                event.epoch = frame.epoch;
                event.seq = frame.seq;
                event.owner = owner_;
                event.secret = secret_;
            });
        }
        return frame;
    }

    void send(CellCommand command, double patience_s) {
        const Command frame = command_for(command);
        end_.kind = Kind::unknown;
        end_.result = AckResult::none;
        end_.why = "the cell has not acknowledged " + in_words(command) + ", and may have done it";
        const Clock::time_point began = Clock::now();
        Clock::time_point next_frame;
        bool is_pending = false;
        for (;;) {
            const double bound_s = is_pending ? patience_s : std::min(patience_s, order_.timings.answer_s);
            if (seconds_since(began) > bound_s || (is_cancelled() && command != CellCommand::release)) return;
            if (!is_pending && seconds_since(next_frame) > 0) {
                const bool has_arrived = bus_.write_holding(command_block.base, encode(frame)).is_ok();
                next_frame = after(has_arrived ? order_.timings.resend_s : std::min(order_.timings.resend_s, lost_s));
            }
            heartbeat();
            const HandOffInput input = read_status_block(bus_);
            if (input.status) end_.status = *input.status;
            if (input.status && note_answer(frame, is_pending)) return;
            if (is_pending && !is_about(end_.status, frame)) {
                end_.why = "another command came to the cell while " + in_words(command) +
                           " waited for consent; whether that is still asked is not known";
                return;
            }
            has_stale_number_ = command == CellCommand::claim && has_refused_number(bad_frames_, end_.status);
            if (has_stale_number_) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    // Whether the acknowledgement in STATUS is that of a frame. It has room for one, that of the latest command.
    bool is_about(const Status& status, const Command& frame) const {
        return status.ack_owner == owner_ && status.ack_seq == frame.seq && status.ack_command == frame.command;
    }

    // True once the cell has answered.
    bool note_answer(const Command& frame, bool& is_pending) {
        const Status& status = end_.status;
        if (!is_about(status, frame)) return false;
        if (frame.command == CellCommand::claim && !is_answer_to_claim(status, frame.epoch)) return false;
        if (status.ack_result == AckResult::pending && !is_pending) {
            is_pending = true;
            context_.message("waiting for consent at the cell");
        }
        if (!is_answered(status.ack_result)) return false;
        end_.result = status.ack_result;
        end_.kind = is_refusal(status.ack_result) ? Kind::refused : Kind::done;
        end_.why = std::string("the cell ") + (end_.kind == Kind::done ? "has acknowledged " : "has refused ") +
                   name(frame.command) + ": " + describe(status.ack_result) + " (" + name(status.ack_result) + ")";
        return true;
    }

    void heartbeat() {
        if (!is_leased_ || seconds_since(heartbeat_at_) < order_.timings.heartbeat_s) return;
        heartbeat_at_ = Clock::now();
        bus_.write_holding(heartbeat_block.base, encode(Heartbeat{epoch_, owner_, ++counter_}));
    }

    RegisterBus& bus_;
    const ControlOrder& order_;
    const Context& context_;
    ControlEnd end_;
    std::uint32_t owner_ = 0;
    std::uint32_t secret_ = 0;
    std::uint32_t seq_ = 0;
    std::uint32_t epoch_ = 0;
    std::uint16_t counter_ = 0;
    std::uint16_t bad_frames_ = 0;   // BAD_FRAMES of the cell before CLAIM
    bool has_stale_number_ = false;  // the cell took the number of CLAIM for an old one
    bool is_leased_ = false;
    bool is_store_lost_ = false;
    Clock::time_point heartbeat_at_;
};

}  // namespace

bool needs_lease(CellCommand command) {
    return command != CellCommand::stop && command != CellCommand::hold && command != CellCommand::abort;
}

ControlEnd control_cell(RegisterBus& bus, const Status& status, const ControlOrder& order, const Context& context) {
    return Control(bus, status, order, context).run();
}

}  // namespace qchopper
