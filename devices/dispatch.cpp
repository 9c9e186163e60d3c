// A loop: advance() of hand_off.h returns an action, this performs it over the bus, the drop folder or the clock, and
// passes the answer on. Everything runs in the caller's thread; memory is that of the job file and one block.

#include "devices/dispatch.h"

#include <errno.h>
#include <sys/random.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "devices/device_error.h"
#include "devices/drop_folder.h"
#include "devices/first_contact.h"
#include "devices/hand_off.h"

namespace qchopper {
namespace {

using Clock = std::chrono::steady_clock;

void fill_random(std::span<std::uint8_t> bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t got = getrandom(bytes.data() + done, bytes.size() - done, 0);
        if (got > 0) done += static_cast<std::size_t>(got);
        if (got < 0 && errno != EINTR) {
            throw InputError(InputFault::io, "the operating system gives no random numbers; nothing was sent", "");
        }
    }
}

// Never 0.
std::uint32_t random_number() {
    std::array<std::uint8_t, 4> bytes{};
    std::uint32_t number = 0;
    while (number == 0) {
        fill_random(bytes);
        std::memcpy(&number, bytes.data(), bytes.size());
    }
    return number;
}

// UUID version 4 (RFC 9562).
Uuid random_id() {
    Uuid id{};
    fill_random(id);
    id[6] = static_cast<std::uint8_t>((id[6] & 0x0F) | 0x40);
    id[8] = static_cast<std::uint8_t>((id[8] & 0x3F) | 0x80);
    return id;
}

std::uint64_t unix_ms() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

// The job file in the drop folder: written under its staging name, then renamed. A file that was not renamed is
// removed.
class StagedFile {
 public:
    StagedFile() = default;
    ~StagedFile() {
        std::error_code ignored;
        if (!staged_.empty()) std::filesystem::remove(staged_, ignored);
    }
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    void stage(const std::filesystem::path& folder, const std::string& file_name, const Uuid& job_id,
               const Bytes& bytes) {
        use_.emplace(folder);
        staged_ = folder / staging_name(file_name, job_id);
        target_ = folder / file_name;
        write_file(staged_, bytes);
    }
    // Returns the reason if it fails, else "".
    std::string put() {
        std::error_code error;
        std::filesystem::rename(staged_, target_, error);
        if (error) return "cannot put " + target_.string() + " into the drop folder: " + error.message();
        staged_.clear();
        return {};
    }
    bool is_staged() const { return !staged_.empty(); }

 private:
    std::optional<DropFolderUse> use_;
    std::filesystem::path staged_;
    std::filesystem::path target_;
};

class Dispatcher {
 public:
    Dispatcher(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, HandOffPlan plan, const Context& context)
        : bus_(bus), file_(file), plan_(std::move(plan)), context_(context), file_name_(ticket.file_name) {
        const HandOffTimings& timings = plan_.options.timings;
        bus_.leave_when(context_.cancelled, plan_.options.stop_when_cancelled ? timings.answer_s : timings.leave_s);
    }
    ~Dispatcher() { bus_.leave_when(nullptr, 0); }
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;

    JobOutcome run() {
        write_journal("CREATED job=" + to_text(plan_.ticket.job_id) + " sha256=" + to_hex(plan_.ticket.file_sha256));
        report("job " + to_text(plan_.ticket.job_id) + ": " + file_name_);
        HandOff state;
        HandOffInput input;
        for (;;) {
            input.cancelled = is_cancelled();
            HandOffTransition turn = advance(plan_, std::move(state), input, now_s());
            state = std::move(turn.state);
            for (const std::string& line : turn.lines) report(line);
            write_journal(turn.action.journal);
            if (turn.action.kind == HandOffAction::Kind::finish) break;
            input = act(turn.action, state, input.cancelled);
        }
        if (state.fault) throw DeviceError(*state.fault, state.why, state.to_do);
        return outcome(state);
    }

 private:
    using Kind = HandOffAction::Kind;

    double now_s() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
    bool is_cancelled() const { return context_.cancelled != nullptr && context_.cancelled->load(); }

    void write_journal(const std::string& row) const {
        if (!row.empty() && plan_.options.journal) plan_.options.journal(row);
    }

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
            case Kind::write_command:
                return write(command_block.base, encode(action.command));
            case Kind::write_ticket:
                return write(ticket_block.base, encode(plan_.ticket));
            case Kind::write_signature:
                return write(signature_block.base, Registers(signature_block.count, 0));
            case Kind::heartbeat:
                return write(heartbeat_block.base, encode(action.heartbeat));
            case Kind::write_chunk:
                return write_chunk(action.offset, state.epoch);
            case Kind::stage_file:
                staged_.stage(plan_.options.drop_folder, file_name_, plan_.ticket.job_id, file_);
                return {};
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

    HandOffInput write_chunk(std::uint32_t offset, std::uint32_t epoch) {
        Chunk chunk;
        chunk.offset = offset;
        const std::size_t end = std::min<std::size_t>(file_.size(), std::size_t{offset} + max_chunk_bytes);
        chunk.data.assign(file_.begin() + offset, file_.begin() + static_cast<std::ptrdiff_t>(end));
        chunk.crc = chunk_crc(epoch, plan_.owner, plan_.ticket.job_id, offset, chunk.data);
        return write(chunk_block.base, encode(chunk));
    }

    HandOffInput put_file() {
        HandOffInput input;
        try {
            // After a lost link this is the second time, and the cell may have removed the first file.
            if (!staged_.is_staged()) staged_.stage(plan_.options.drop_folder, file_name_, plan_.ticket.job_id, file_);
            input.why = staged_.put();
        } catch (const InputError& error) {
            input.why = error.what();
        }
        return input;
    }

    HandOffInput read_status() {
        HandOffInput input = read_status_block(bus_);
        if (input.status && input.status->job_id == plan_.ticket.job_id &&
            input.status->job_state == JobState::running) {
            context_.progress("0.01 % of the job", input.status->progress, 10000);
        }
        return input;
    }

    // Ends early at a request to stop that the hand-off has not been passed yet.
    void wait(double until_s, bool stop_requested) const {
        constexpr double slice_s = 0.02;
        while (now_s() < until_s && (stop_requested || !is_cancelled())) {
            std::this_thread::sleep_for(std::chrono::duration<double>(std::min(slice_s, until_s - now_s())));
        }
    }

    JobOutcome outcome(const HandOff& state) {
        JobOutcome out;
        out.verdict = state.verdict;
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
        out.elapsed_s = state.elapsed_s;
        out.refusal = state.refusal;
        out.cancelled = state.is_cancelled;
        if (state.status) out.cell_id = state.status->cell_id;
        if (state.status) out.simulated = state.status->has(flag::simulated);
        out.took_s = now_s();
        out.why = state.why;
        out.to_do = state.to_do;
        out.log = log_;
        return out;
    }

    RegisterBus& bus_;
    const Bytes& file_;  // of the caller
    HandOffPlan plan_;
    const Context& context_;
    std::string file_name_;
    StagedFile staged_;
    std::vector<std::string> log_;
    Clock::time_point began_ = Clock::now();
};

void check_file(const JobTicket& ticket, const Bytes& file) {
    if (!file.empty() && file.size() == ticket.file_size && sha256(file) == ticket.file_sha256) return;
    throw InputError(InputFault::use,
                     ticket.file_name + " is not the file that its ticket names (size or SHA-256); nothing was sent",
                     "Prepare the project again.");
}

}  // namespace

const char* describe(StartVerdict verdict) {
    constexpr const char* texts[] = {"STARTED", "NOT STARTED",
                                     "UNKNOWN: ask the cell"};  // in the order of StartVerdict
    return texts[static_cast<std::size_t>(verdict)];
}

JobOutcome dispatch_job(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, const DispatchOptions& options,
                        const Context& context) {
    TicketOrder order;
    order.job_id = options.job_id ? *options.job_id : random_id();
    order.created_ms = unix_ms();
    order.cell_id = options.cell_id;
    order.simulated = options.want_simulated;
    order.rehearse = options.rehearse;
    order.transfer = options.drop_folder.empty() ? Transfer::chunks : Transfer::drop_folder;
    order.on_link_loss = options.on_link_loss;
    check_file(ticket, file);
    HandOffPlan plan{wire_ticket(ticket, order), random_number(), random_number(), options};
    return Dispatcher(bus, ticket, file, std::move(plan), context).run();
}

}  // namespace qchopper
