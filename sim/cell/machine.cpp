// Power on, heartbeats, chunks and STATUS of the simulated controller. O(jobs in the memory) for power on, O(1)
// otherwise (a chunk: O(its bytes)).

#include "sim/cell/machine.h"

#include <algorithm>
#include <cmath>

#include "sim/cell/machine_parts.h"
#include "sim/cell/random.h"

namespace qchopper {
namespace cell {

namespace {

// One event: at the one named by cell.power, power is cut.
void count_step(CellState& cell) {
    ++cell.steps;
    if (cell.power.at_event != 0 && cell.steps >= cell.power.at_event) cell.power.lost = true;
}

}  // namespace

void log(CellState& cell, const CellHooks& hooks, const std::string& line) {
    ++cell.events;
    count_step(cell);
    if (hooks.log) hooks.log(line);
}

bool save(CellState& cell, CellMemory& memory, const CellHooks& hooks) {
    count_step(cell);  // cut before the write
    if (cell.power.lost || take(cell.faults, Fault::disk_full)) return false;
    memory.mark = next_random(cell.random) | 1U;
    if (cell.checks_store && !hooks.write_marks({cell.saved_mark, memory.mark})) return false;
    if (hooks.save && !hooks.save(memory)) return false;
    cell.saved_mark = memory.mark;
    count_step(cell);  // cut after it
    // Before the caller goes on: from now on the store before this write is an older one.
    const bool is_cut = cell.power.lost;
    if (cell.checks_store && !is_cut && !hooks.write_marks({memory.mark, memory.mark})) cell.warning = true;
    return true;
}

std::uint64_t unix_ms(const CellState& cell, CellTime now) {
    return now.unix_ms + static_cast<std::uint64_t>(cell.jump_ms);
}

bool holds_lease(const CellState& cell, std::uint32_t owner, std::uint32_t epoch) {
    return cell.lease && cell.lease->owner == owner && cell.memory.epoch_held == epoch;
}

std::uint32_t random_number(CellState& cell) {
    std::uint32_t number = 0;
    while (number == 0) number = static_cast<std::uint32_t>(next_random(cell.random) >> 32);
    return number;
}

}  // namespace cell

namespace {

void draw_store_id(CellState& cell, CellTime now) {
    RegisterWriter drawn;
    while (drawn.registers().size() < sizeof(Uuid) / 2) drawn.u32(cell::random_number(cell));
    RegisterReader(drawn.registers()).bytes(cell.memory.store_id);
    cell.memory.store_created_ms = now.unix_ms;
}

bool is_last_written(const CellMemory& memory, const SaveMarks& marks) {
    return memory.mark != 0 && (memory.mark == marks.last || memory.mark == marks.next);
}

}  // namespace

CellState boot(const CellLimits& limits, CellMemory memory, std::uint64_t seed, CellTime now, const CellHooks& hooks) {
    CellState cell;
    cell.limits = limits;
    cell.memory = std::move(memory);
    cell.random = seed;
    cell.booted = now;
    cell.state_since_ms = now.steady_ms;
    cell.checks_store = hooks.read_marks && hooks.write_marks;
    cell.saved_mark = cell.memory.mark;
    const bool is_new = cell.memory.store_id == Uuid{};
    const bool is_older = !is_new && cell.checks_store && !is_last_written(cell.memory, hooks.read_marks());
    if (is_older) cell::log(cell, hooks, "the store is not the one that was written last: it gets another STORE_ID");
    if (is_new || is_older) draw_store_id(cell, now);
    ++cell.memory.boot_count;
    for (auto& [id, record] : cell.memory.jobs) {
        if (record.state != JobState::running && record.state != JobState::interrupted) continue;
        record.state = JobState::aborted;
        record.result = JobResult::power_loss;
        record.end_time_ms = now.unix_ms;
        cell.state = cell.state_before = PackState::aborted;
        cell.warning = true;
        cell::log(cell, hooks, "job " + to_text(id) + " was cut off by a power cut; it is aborted for good");
    }
    if (!cell::save(cell, cell.memory, hooks)) cell.warning = true;
    return cell;
}

void receive_heartbeat(CellState& cell, std::span<const std::uint16_t> block, CellTime now) {
    const Decoded<Heartbeat> heartbeat = decode<Heartbeat>(block);
    if (!heartbeat.is_ok() || !cell::holds_lease(cell, heartbeat.value.owner, heartbeat.value.epoch)) return;
    Lease& lease = *cell.lease;
    if (now.steady_ms >= lease.until_ms || lease.counter == heartbeat.value.counter) return;
    lease.counter = heartbeat.value.counter;
    lease.heartbeat_ms = now.steady_ms;
    lease.until_ms = now.steady_ms + cell::lease_ms;
    cell.watchdog_expired = false;
}

void receive_chunk(CellState& cell, const Chunk& chunk) {
    CellJob& job = cell.job;
    const auto answer = [&]() -> AckResult {
        if (!cell.lease) return AckResult::not_owner;
        if (!job.is_waiting() || job.ticket.transfer != Transfer::chunks) return AckResult::no_ticket;
        const std::uint32_t crc =
            chunk_crc(cell.memory.epoch_held, cell.lease->owner, job.ticket.job_id, chunk.offset, chunk.data);
        if (crc != chunk.crc) return AckResult::chunk_crc;
        if (std::uint64_t{chunk.offset} + chunk.data.size() > job.ticket.file_size) return AckResult::file_size;
        if (chunk.offset > job.chunks.size()) return AckResult::wrong_offset;
        if (chunk.offset < job.chunks.size()) {
            const bool is_within = chunk.offset + chunk.data.size() <= job.chunks.size();
            const bool is_same =
                is_within && std::equal(chunk.data.begin(), chunk.data.end(),
                                        job.chunks.begin() + static_cast<std::ptrdiff_t>(chunk.offset));
            return is_same ? AckResult::already : AckResult::wrong_offset;
        }
        job.chunks.insert(job.chunks.end(), chunk.data.begin(), chunk.data.end());
        return AckResult::ok;
    };
    cell.transfer_result = answer();
}

namespace {

std::uint16_t flags_of(const CellState& cell) {
    unsigned flags = flag::simulated;
    const auto set = [&flags](bool is_so, std::uint16_t bit) { flags |= is_so ? bit : 0U; };
    const bool is_free = cell.job.state == JobState::none;
    set(cell.state == PackState::idle && is_free && cell.mode == UnitMode::production, flag::ready_for_ticket);
    set(cell.job.state == JobState::prepared, flag::prepared);
    set(cell.consent_present, flag::consent_present | flag::block_loaded);
    set(cell.surroundings.block == BlockOnTable::fresh, flag::block_loaded);
    set(cell.job.is_active(), flag::job_active);
    set(cell.job.is_finished(), flag::result_waiting);
    set(cell.warning || (!is_free && cell.job.signature.empty()), flag::warning);
    set(cell.alarm.code != 0, flag::fault);
    set(!cell.surroundings.is_safe(), flag::safety_open);
    set(cell.surroundings.local_control, flag::local_control);
    set(cell.watchdog_expired, flag::watchdog_expired);
    set(cell.lease.has_value(), flag::lease_held);
    set(cell.store_free_kib == 0, flag::store_full);
    set(cell.mode == UnitMode::rehearsal, flag::rehearsal_running);
    return static_cast<std::uint16_t>(flags);
}

void show_job(const CellState& cell, CellTime now, Status& s) {
    const CellJob& job = cell.job;
    if (job.state == JobState::none) return;
    const double run_s = cell::run_so_far_s(cell, now);
    const double whole_s = cell::whole_run_s(cell);
    const double share = whole_s > 0 ? std::min(1.0, run_s / whole_s) : job.state == JobState::ended ? 1.0 : 0.0;
    s.job_id = job.ticket.job_id;
    s.token = job.token;
    s.job_state = job.state;
    s.job_result = job.result;
    s.progress = static_cast<std::uint16_t>(std::floor(10000 * share));
    s.elapsed_s = static_cast<std::uint32_t>(run_s);
    s.remaining_s = static_cast<std::uint32_t>(std::ceil(std::max(0.0, whole_s - run_s)));
    s.block_no = cell::block_now(cell, now);
    s.transfer_state = job.transfer;
    s.transfer_next = static_cast<std::uint32_t>(job.chunks.size());
    s.file_sha256 = job.stored_sha256;
    if (!job.is_active()) return;
    s.tool_no = job.ticket.tool_no;
    s.feed_override = 10000;
    s.spindle_rpm = cell.state == PackState::execute ? job.ticket.spindle_max_rpm : std::uint16_t{0};
    if (job.program.run) {
        const RunPlace place = place_at(*job.program.run, run_s);
        s.tool_no = place.tool;
        for (int axis = 0; axis < 3; ++axis) {
            s.tip[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::lround(100 * place.tip[axis]));
        }
        return;
    }
    // Without a program the tip moves in a straight line through the box of the piece.
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from = job.ticket.box_min[axis];
        const double to = job.ticket.box_max[axis];
        s.tip[axis] = static_cast<std::int32_t>(std::lround(from + share * (to - from)));
    }
}

void show_alarm(const CellState& cell, Status& s) {
    if (cell.alarm.code == 0) return;
    s.alarms = 1;
    s.alarm_code = cell.alarm.code;
    s.alarm_block = cell.alarm.block;
    s.alarm_text = cell.alarm.text;
}

}  // namespace

std::uint16_t heartbeat_of(const CellState& cell, CellTime now) {
    return static_cast<std::uint16_t>((now.steady_ms - cell.booted.steady_ms) / 500 + cell.heartbeat_offset);
}

Status status_of(const CellState& cell, CellTime now) {
    Status s;
    s.snapshot = static_cast<std::uint16_t>(now.steady_ms);
    s.heartbeat = cell.frozen_heartbeat.value_or(heartbeat_of(cell, now));
    s.boot_count = cell.memory.boot_count;
    s.unit_mode = cell.mode;
    s.state = cell.state;
    s.state_before = cell.state_before;
    s.flags = flags_of(cell);
    s.epoch_held = cell.memory.epoch_held;
    if (cell.lease) {
        s.owner_held = cell.lease->owner;
        s.lease_left_ds =
            static_cast<std::uint16_t>(std::max<std::int64_t>(0, cell.lease->until_ms - now.steady_ms) / 100);
    }
    s.cell_id = cell.limits.cell_id;
    s.ack_seq = cell.ack.seq;
    s.ack_command = cell.ack.command;
    s.ack_result = cell.ack.result;
    s.ack_detail = cell.ack.detail;
    s.ack_owner = cell.ack.owner;
    s.transfer_result = cell.transfer_result;
    s.store_free_kib = cell.store_free_kib;
    s.event_no = cell.events;
    s.starts_total = cell.memory.starts_total;
    s.cell_time_ms = cell::unix_ms(cell, now);
    show_alarm(cell, s);
    s.bad_frames = cell.bad_frames;
    s.bad_reason = cell.bad_reason;
    show_job(cell, now, s);
    return s;
}

Identity identity_of(const CellState& cell) {
    const CellMemory& memory = cell.memory;
    return {map_version,
            memory.store_id,
            memory.boot_count,
            memory.epoch_held,
            memory.starts_total,
            memory.store_created_ms,
            static_cast<std::uint16_t>(cell.checks_store)};
}

}  // namespace qchopper
