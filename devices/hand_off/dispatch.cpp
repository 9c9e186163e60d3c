// A loop: advance() of hand_off.h returns an action, this performs it over the bus, the drop folder or the clock, and
// passes the answer on. Everything runs in the caller's thread; memory is that of the job file and one block. O(1) for
// each turn, O(bytes) for the file.

#include "devices/hand_off/dispatch.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "base/error.h"
#include "base/files/file.h"
#include "devices/hand_off/drop_folder.h"
#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/hand_off.h"
#include "devices/hand_off/operator_text.h"
#include "devices/hand_off/random.h"
#include "devices/journal/journal.h"
#include "devices/wire/device_error.h"
#include "devices/wire/program_block.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;

std::string lower(std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

// Names of points: "start_intent" for the row before START, "start_sent" for its frame.
std::string name_of(const JournalEvent& event) {
    if (event.kind == JournalKind::command) return lower(name(event.command)) + "_intent";
    return event.kind == JournalKind::claim ? "claim_intent" : lower(name(event.kind));
}

std::string name_of(const HandOffAction& action) {
    constexpr const char* names[] = {"read_status",   "read_result",  "read_identity",
                                     "write_command", "write_ticket", "write_signature",
                                     "write_chunk",   "heartbeat",    "stage_file",
                                     "put_file",      "wait",         "finish"};  // in the order of Kind
    if (action.kind == HandOffAction::Kind::write_command) return lower(name(action.command.command)) + "_sent";
    return names[static_cast<std::size_t>(action.kind)];
}

class Dispatcher {
 public:
    Dispatcher(RegisterBus& bus, const Bytes& file, const HandOffPlan& plan, const Context& context)
        : bus_(bus), file_(file), plan_(plan), context_(context), file_name_(plan.ticket.file_name) {
        const HandOffTimings& timings = plan_.options.timings;
        bus_.leave_when(context_.cancelled, plan_.options.stop_when_cancelled ? timings.answer_s : timings.leave_s);
    }
    ~Dispatcher() { bus_.leave_when(nullptr, 0); }
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;

    // `first`: CREATED or RESUMED.
    JobOutcome run(const JournalEvent& first) {
        keep(first);
        report("job " + to_text(plan_.ticket.job_id) + ": " + file_name_);
        HandOff state;
        HandOffInput input;
        for (;;) {
            input.cancelled = is_cancelled() || journal_fault_;
            input.cancelled_for_s = bus_.leaving_for_s();
            input.request = requested();
            HandOffTransition turn = next(state, input);
            state = std::move(turn.state);
            for (const std::string& line : turn.lines) report(line);
            if (turn.request_answer && plan_.options.answer_request) {
                plan_.options.answer_request(*turn.request_answer);
            }
            if (turn.action.kind == HandOffAction::Kind::finish) break;
            input = act(turn.action, state, input.cancelled);
            pass("after_" + name_of(turn.action));
        }
        if (state.start_outcome == StartOutcome::not_started && journal_fault_) std::rethrow_exception(journal_fault_);
        if (state.fault) throw DeviceError(*state.fault, state.why, state.to_do);
        return outcome(state);
    }

 private:
    using Kind = HandOffAction::Kind;

    double now_s() const { return clock_s() - began_s_; }
    double clock_s() const {
        if (plan_.options.clock.now_s) return plan_.options.clock.now_s();
        return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    }
    void sleep(double seconds) const {
        if (plan_.options.clock.sleep) return plan_.options.clock.sleep(seconds);
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
    bool is_cancelled() const { return context_.cancelled != nullptr && context_.cancelled->load(); }

    // One turn, with its events kept in the journal. If they cannot be kept, nothing is started: the turn is taken back
    // and the caller's request to stop put in its place. What has started already is followed without a journal.
    HandOffTransition next(const HandOff& state, HandOffInput& input) {
        HandOffTransition turn = advance(plan_, state, input, now_s());
        const bool is_start =
            turn.action.kind == Kind::write_command && turn.action.command.command == CellCommand::start;
        try {
            if (journal_fault_ && is_start && !state.start_sent) std::rethrow_exception(journal_fault_);
            for (const JournalEvent& event : turn.journal) keep(event);
        } catch (const InputError& error) {
            report(error.what());
            journal_fault_ = std::current_exception();
            if (state.start_sent || state.is_started) return turn;
            input.cancelled = true;
            input.request = CellCommand::none;
            turn = advance(plan_, state, input, now_s());
        }
        return turn;
    }

    void keep(const JournalEvent& event) {
        if (!plan_.options.journal || journal_fault_) return;
        const std::string point = name_of(event);
        pass("before_" + point);
        plan_.options.journal(event);
        pass("after_" + point);
    }

    void pass(const std::string& point) const {
        if (plan_.options.at_point) plan_.options.at_point(point);
    }

    CellCommand requested() const { return plan_.options.request ? plan_.options.request() : CellCommand::none; }

    void report(const std::string& line) {
        char time[32];
        std::snprintf(time, sizeof time, "%8.2f s  ", now_s());
        log_.push_back(time + line);
        context_.message(line);
    }

    // `stop_requested`: the hand-off has been passed the request to stop.
    HandOffInput act(const HandOffAction& action, const HandOff& state, bool stop_requested) {
        switch (action.kind) {
            case Kind::read_status:
                return read_status();
            case Kind::read_result:
                return read_result_block(bus_);
            case Kind::read_identity:
                return read_identity_block(bus_);
            case Kind::write_command:
                return write(command_block.base, encode(action.command));
            case Kind::write_ticket:
                return write(ticket_block.base, encode(plan_.ticket));
            case Kind::write_signature:
                return write(signature_block.base, signature());
            case Kind::heartbeat:
                return write(heartbeat_block.base, encode(action.heartbeat));
            case Kind::write_chunk:
                return write_chunk(action.offset, state.epoch);
            case Kind::stage_file:
                return stage_file();
            case Kind::put_file:
                return put_file();
            case Kind::wait:
                wait(action.until_s, stop_requested);
                return {};
            case Kind::finish:
                break;
        }
        return {};
    }

    HandOffInput write(std::uint16_t base, const Registers& block) {
        return input_from(bus_.write_holding(base, block));
    }

    // All zero: the ticket is not signed.
    Registers signature() const {
        const std::optional<Ed25519PrivateKey>& key = plan_.options.signing_key;
        return key ? sign_ticket(*key, encode(plan_.ticket)) : Registers(signature_block.count, 0);
    }

    HandOffInput write_chunk(std::uint32_t offset, std::uint32_t epoch) {
        Chunk chunk;
        chunk.offset = offset;
        const std::size_t end = std::min<std::size_t>(file_.size(), std::size_t{offset} + max_chunk_bytes);
        chunk.data.assign(file_.begin() + offset, file_.begin() + static_cast<std::ptrdiff_t>(end));
        chunk.crc = chunk_crc(epoch, plan_.owner, plan_.ticket.job_id, offset, chunk.data);
        return write(chunk_block.base, encode(chunk));
    }

    HandOffInput stage_file() {
        HandOffInput input;
        input.why = staged_.stage(plan_.options.drop_folder, file_name_, plan_.ticket.job_id, file_);
        return input;
    }

    HandOffInput put_file() {
        HandOffInput input;
        // After a lost link this is the second time, and the cell may have removed the first file.
        if (!staged_.is_staged()) input = stage_file();
        if (input.why.empty()) input.why = staged_.put();
        return input;
    }

    HandOffInput read_status() {
        HandOffInput input = read_status_block(bus_);
        if (input.status && input.status->job_id == plan_.ticket.job_id &&
            input.status->job_state == JobState::running) {
            context_.progress("% of the job", input.status->progress / 100U, 100);
            show_chunk(*input.status);
        }
        return input;
    }

    // One line for each chunk in which the program is seen.
    void show_chunk(const Status& status) {
        const std::uint32_t chunk = chunk_of_block(status.block_no);
        if (chunk == 0 || chunk == shown_chunk_) return;
        shown_chunk_ = chunk;
        context_.message(program_place(status));
    }

    // Ends early at a request to stop that the hand-off has not been passed yet.
    void wait(double until_s, bool stop_requested) const {
        constexpr double slice_s = 0.02;
        while (now_s() < until_s && (stop_requested || !is_cancelled())) sleep(std::min(slice_s, until_s - now_s()));
    }

    JobOutcome outcome(const HandOff& state) {
        JobOutcome out;
        static_cast<HandOffEnd&>(out) = state;
        out.job_id = plan_.ticket.job_id;
        if (state.status && state.status->job_id == out.job_id) {
            out.job_state = state.status->job_state;
            out.job_result = state.status->job_result;
        }
        if (state.result) {
            out.job_state = state.result->state;
            out.job_result = state.result->result;
            out.starts = state.result->starts;
            out.starts_known = true;
        }
        out.milled_before = state.milled_before.has_value();
        out.milled_complete = out.milled_before && state.milled_before->result == JobResult::complete;
        if (state.status) out.cell_id = state.status->cell_id;
        if (state.status) out.simulated = state.status->has(flag::simulated);
        out.took_s = now_s();
        out.log = log_;
        return out;
    }

    RegisterBus& bus_;
    const Bytes& file_;  // of the caller; empty if the job is only followed
    HandOffPlan plan_;
    const Context& context_;
    std::string file_name_;
    StagedFile staged_;
    std::vector<std::string> log_;
    std::uint32_t shown_chunk_ = 0;     // of the program
    std::exception_ptr journal_fault_;  // of the first event that could not be kept
    double began_s_ = clock_s();        // the last member: it needs the options
};

void check_file(const JobTicket& ticket, const Bytes& file) {
    if (!file.empty() && file.size() == ticket.file_size && sha256(file) == ticket.file_sha256) return;
    throw InputError(InputFault::use,
                     ticket.file_name + " is not the file that its ticket names (size or SHA-256); nothing was sent",
                     "Prepare the project again.");
}

Uuid new_job_id(const DispatchOptions& options) {
    if (options.job_id) return *options.job_id;
    if (!options.random) return random_id();
    Uuid id{};
    for (std::uint8_t& byte : id) byte = static_cast<std::uint8_t>(options.random());
    return id;
}

HandOffPlan plan_of(const WireTicket& ticket, const DispatchOptions& options) {
    HandOffPlan plan{ticket, options.past.owner, options.past.secret, options};
    if (plan.owner == 0) {
        plan.owner = options.random ? options.random() : random_number();
        plan.secret = options.random ? options.random() : random_number();
        plan.options.past.seq = 0;
    }
    return plan;
}

}  // namespace

JobOutcome dispatch_job(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, const DispatchOptions& options,
                        const Context& context) {
    WireTicket order;
    order.job_id = new_job_id(options);
    order.created_ms = unix_ms();
    order.cell_id = options.cell_id;
    order.made_for = options.want_simulated ? 1 : 0;
    order.requirements = options.rehearse ? 1 : 0;
    order.transfer = options.drop_folder.empty() ? Transfer::chunks : Transfer::drop_folder;
    order.on_link_loss = options.on_link_loss;
    if (options.signing_key) order.key_id = key_id_of(options.signing_key->public_key());
    check_file(ticket, file);
    const HandOffPlan plan = plan_of(wire_ticket(ticket, order), options);
    JournalEvent created;
    created.kind = JournalKind::created;
    created.job_id = order.job_id;
    created.file_sha256 = ticket.file_sha256;
    created.ticket = encode(plan.ticket);
    return Dispatcher(bus, file, plan, context).run(created);
}

JobOutcome adopt_job(RegisterBus& bus, const WireTicket& ticket, const DispatchOptions& options,
                     const Context& context) {
    HandOffPlan plan = plan_of(ticket, options);
    plan.adopts = true;
    JournalEvent resumed;
    resumed.kind = JournalKind::resumed;
    resumed.job_id = ticket.job_id;
    return Dispatcher(bus, {}, plan, context).run(resumed);
}

}  // namespace qchopper
