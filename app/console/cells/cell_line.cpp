// A read of STATUS twice a second; while there is no connection, a try every two seconds. The connection for Hold is
// tried every second, so that a Hold finds it open. A command has a connection of its own: Resume and Clear wait for
// the person at the cell, and neither the reading nor a Stop may wait for them.

#include "app/console/cells/cell_line.h"

#include "app/console/worker/json_text.h"
#include "app/dispatch/cell_commands.h"
#include "app/report/cell/cell_control_report.h"
#include "devices/hand_off/first_contact.h"
#include "devices/wire/device_error.h"
#include "devices/wire/program_block.h"

namespace qchopper {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

namespace {

constexpr auto read_interval = 500ms;
constexpr auto keep_interval = 1000ms;
constexpr auto retry_interval = 2000ms;

WorkerAnswer answer_to(const DeviceError& error) {
    constexpr unsigned statuses[] = {502, 502, 423, 409};  // in the order of DeviceFault
    return error_answer(statuses[static_cast<std::size_t>(error.fault)], error.what(),
                        "Whether the cell has got the command is not known.", error.to_do);
}

}  // namespace

std::string to_json(const CellView& view) {
    return one_line(json_values::to_document(view, -1));
}

void take_status(const Status& status, CellView& view) {
    view.kind = status.has(flag::simulated) ? CellKind::simulated : CellKind::real;
    view.state = status.state;
    view.asks = status.ack_command == CellCommand::prepare && status.ack_result == AckResult::pending;
    const bool has_job = status.job_id != Uuid{};
    view.job = has_job ? std::optional(to_text(status.job_id)) : std::nullopt;
    view.job_state = status.job_state;
    const bool runs = has_job && has_started(status.job_state) && !is_over(status.job_state);
    constexpr double whole = 10'000;
    view.progress = runs ? std::optional(status.progress / whole) : std::nullopt;
    view.elapsed_s = runs ? std::optional<double>(status.elapsed_s) : std::nullopt;
    view.remaining_s = runs ? std::optional<double>(status.remaining_s) : std::nullopt;
    const bool has_place = runs && chunk_of_block(status.block_no) > 0;
    view.program_chunk = has_place ? std::optional(chunk_of_block(status.block_no)) : std::nullopt;
    view.program_line = has_place ? std::optional(line_of_block(status.block_no)) : std::nullopt;
    view.tool = has_place ? std::optional(status.tool_no) : std::nullopt;
    view.link = CellLinkState::connected;
}

CellLine::CellLine(std::string id, std::string address, std::string name,
                   std::optional<std::filesystem::path> cell_file, std::function<void(const CellView&)> on_change)
    : address_(std::move(address)), cell_file_(std::move(cell_file)), on_change_(std::move(on_change)) {
    view_.id = std::move(id);
    view_.name = std::move(name);
    view_.address = address_;
    watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
    keeper_ = std::jthread([this](const std::stop_token& stop) { keep_hold_open(stop); });
}

CellLine::~CellLine() {
    watcher_.request_stop();
    keeper_.request_stop();
    watcher_.join();
    keeper_.join();
}

CellView CellLine::view() const {
    const std::lock_guard lock(showing_);
    CellView view = view_;
    if (read_at_) view.read_ms_ago = std::chrono::duration<double, std::milli>(Clock::now() - *read_at_).count();
    return view;
}

CellLine::Contact CellLine::contact() const {
    return contact_cell({address_, cell_file_}, {});
}

void CellLine::read(Contact& over) const {
    if (over == nullptr) {
        over = contact();
        return;
    }
    const HandOffInput input = read_status_block(over->bus);
    if (!input.status) {
        over.reset();
        throw DeviceError(DeviceFault::unreachable, "the cell at " + address_ + " does not answer", "");
    }
    over->status = *input.status;
}

void CellLine::look() {
    read(reader_);
    const std::lock_guard showing(showing_);
    take_status(reader_->status, view_);
    read_at_ = Clock::now();
}

void CellLine::wait(const std::stop_token& stop, std::chrono::milliseconds time) {
    std::unique_lock lock(waiting_);
    ended_.wait_for(lock, stop, time, [] { return false; });
}

void CellLine::watch(const std::stop_token& stop) {
    std::string shown;
    Clock::time_point shown_at;
    while (!stop.stop_requested()) {
        std::chrono::milliseconds pause = read_interval;
        try {
            look();
        } catch (const std::runtime_error&) {  // DeviceError, InputError: the page shows what was read last, and when
            pause = retry_interval;
            const std::lock_guard showing(showing_);
            if (view_.link == CellLinkState::connected) view_.link = CellLinkState::lost;
        }
        CellView now = view();
        const CellView sent = now;
        now.read_ms_ago.reset();
        const std::string text = to_json(now);
        if (text != shown || Clock::now() - shown_at > retry_interval) {
            shown = text;
            shown_at = Clock::now();
            on_change_(sent);
        }
        wait(stop, pause);
    }
}

void CellLine::keep_hold_open(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        std::chrono::milliseconds pause = keep_interval;
        try {
            const std::lock_guard lock(holding_);
            read(holder_);
        } catch (const std::runtime_error&) {
            pause = retry_interval;
        }
        wait(stop, pause);
    }
}

// A connection that was open and is not any more is made again, once.
WorkerAnswer CellLine::send(Contact& over, const std::string& action, const std::optional<std::string>& job) {
    try {
        const bool was_open = over != nullptr;
        try {
            read(over);
        } catch (const DeviceError&) {
            if (!was_open) throw;
            read(over);
        }
        const Uuid now = over->status.job_id;
        const std::string in_cell = now == Uuid{} ? std::string() : to_text(now);
        if (job && *job != in_cell) {
            return error_answer(409, "another job is in the cell than the one that you saw", "Nothing was sent.",
                                "look at the cell, then choose again");
        }
        return {200, text_of(document(send_command(*over, action, 0, {})))};
    } catch (const DeviceError& e) {
        over.reset();
        return answer_to(e);
    } catch (const InputError& e) {
        return answer_to(e);
    }
}

WorkerAnswer CellLine::hold() {
    const std::lock_guard lock(holding_);
    return send(holder_, "hold", {});
}

WorkerAnswer CellLine::command(const std::string& action, const std::string& job) {
    Contact own;
    return send(own, action, job);
}

}  // namespace qchopper
