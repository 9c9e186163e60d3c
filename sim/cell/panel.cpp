// Each function changes a few members and calls the machine for what follows. O(1).

#include "sim/cell/panel.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "sim/cell/machine_parts.h"

namespace qchopper {
namespace {

constexpr std::uint32_t e_stop_alarm = 1;
constexpr std::uint32_t door_alarm = 2;
constexpr std::uint32_t tool_alarm = 3;
constexpr std::uint32_t spindle_alarm = 4;
constexpr std::uint32_t input_alarm = 5;

bool is_at_rest(PackState state) {
    return state == PackState::idle || state == PackState::stopped || state == PackState::complete ||
           state == PackState::held || state == PackState::suspended || state == PackState::aborted;
}

}  // namespace

void open_door(CellState& cell, bool is_open, CellTime now, const CellHooks& hooks) {
    pass_time(cell, now, hooks);
    cell.surroundings.door_open = is_open;
    cell::log(cell, hooks, is_open ? "the door is open" : "the door is closed");
    if (!is_open) return;
    if (is_at_rest(cell.state)) return cell::drop_preparation(cell, AckResult::safety_open);
    cell::raise_alarm(cell, {door_alarm, 0, "door opened"}, JobResult::aborted, now, hooks);
}

void press_e_stop(CellState& cell, bool is_pressed, CellTime now, const CellHooks& hooks) {
    cell.surroundings.e_stop = is_pressed;
    if (is_pressed) cell::raise_alarm(cell, {e_stop_alarm, 0, "emergency stop"}, JobResult::aborted, now, hooks);
    if (!is_pressed) cell::log(cell, hooks, "the emergency stop is released");
}

void set_tool_broken(CellState& cell, bool is_broken, CellTime now, const CellHooks& hooks) {
    cell.surroundings.tool_broken = is_broken;
    cell::log(cell, hooks, is_broken ? "the tool is broken" : "the tool is sound");
    if (!is_broken || !cell.job.is_active()) return;
    cell::raise_alarm(cell, {tool_alarm, 0, "tool broken"}, JobResult::tool, now, hooks);
}

void lose_spindle_speed(CellState& cell, CellTime now, const CellHooks& hooks) {
    if (!cell.job.is_active()) return;
    cell::raise_alarm(cell, {spindle_alarm, 0, "spindle speed"}, JobResult::tool, now, hooks);
}

void miss_input(CellState& cell, std::uint32_t input, CellTime now, const CellHooks& hooks) {
    if (!cell.job.is_active()) return;
    const std::string name = input > 0 ? "input " + std::to_string(input) : std::string("input");
    cell::raise_alarm(cell, {input_alarm, 0, name + " missing"}, JobResult::aborted, now, hooks);
}

void set_local_control(CellState& cell, bool is_local, const CellHooks& hooks) {
    cell.surroundings.local_control = is_local;
    cell::log(cell, hooks, is_local ? "under control of the panel" : "under control of the dispatcher");
    if (is_local) cell::drop_preparation(cell, AckResult::local_control);
}

void set_block(CellState& cell, BlockOnTable block, const CellHooks& hooks) {
    const bool was_consented = cell.job.state == JobState::prepared;
    cell.surroundings.block = block;
    cell::log(cell, hooks, "the block on the table was changed");
    if (was_consented) cell::drop_preparation(cell, AckResult::no_consent);
}

void perform(CellState& cell, const ScriptLine& line, CellTime now, const CellHooks& hooks) {
    const Act act = line.act;
    if (act == Act::policy) cell.limits.consent = static_cast<Consent>(line.choice);
    if (act == Act::door) open_door(cell, line.choice == 1, now, hooks);
    if (act == Act::e_stop) press_e_stop(cell, line.choice == 1, now, hooks);
    if (act == Act::panel) set_local_control(cell, line.choice == 1, hooks);
    if (act == Act::block) set_block(cell, static_cast<BlockOnTable>(line.choice), hooks);
    if (act == Act::tool) set_tool_broken(cell, line.choice == 1, now, hooks);
    if (act == Act::seed) cell.faults.random = static_cast<std::uint64_t>(line.number);
    if (act == Act::fault) arm(cell, line.fault, now);
    if (act == Act::clear_faults) disarm_all(cell);
}

bool holds(const CellState& cell, std::size_t choice) {
    const bool is_so[] = {cell.pending && cell.pending->waits == Pending::Waits::consent,
                          cell.job.state == JobState::prepared,
                          cell.state == PackState::execute && cell.job.is_active(),
                          cell.state == PackState::held,
                          cell.job.is_finished(),
                          cell.state == PackState::aborted,
                          cell.state == PackState::idle};
    assert(choice < std::size(is_so));
    return is_so[choice];
}

void arm(CellState& cell, const ArmedFault& fault, CellTime now) {
    if (fault.fault >= Fault::power_cut && fault.fault <= Fault::power_cut_all_back) {
        const int store = static_cast<int>(fault.fault) - static_cast<int>(Fault::power_cut);  // the same order
        const auto after = static_cast<std::uint64_t>(std::max<std::int64_t>(1, fault.number));
        cell.power = {cell.steps + after, static_cast<PowerCut::Store>(store), false};
        return;
    }
    switch (fault.fault) {
        case Fault::clock_jump:
            cell.jump_ms += 1000 * fault.number;
            return;
        case Fault::frozen_heartbeat:
            cell.frozen_heartbeat = heartbeat_of(cell, now);
            return;
        case Fault::heartbeat_at:
            cell.heartbeat_offset = static_cast<std::uint16_t>(
                cell.heartbeat_offset + static_cast<std::uint16_t>(fault.number) - heartbeat_of(cell, now));
            return;
        default:
            cell::pass_run(cell, now);
            cell.faults.armed.push_back(fault);
    }
}

void disarm_all(CellState& cell) {
    cell.faults.armed.clear();
    cell.power.at_event = 0;
    cell.frozen_heartbeat.reset();
}

void note_block(CellState& cell, CellTime now) {
    if (cell.job.is_active()) cell::note_carved(cell, now);
}

CellMemory memory_after(PowerCut::Store store, const CellMemory& saved) {
    if (store == PowerCut::Store::stays) return saved;
    CellMemory memory;
    if (store == PowerCut::Store::lost) return memory;
    memory.store_id = saved.store_id;  // the copy that was made when the store was new
    memory.mark = 1;
    memory.store_created_ms = saved.store_created_ms;
    return memory;
}

CellState power_on(const CellState& before, CellMemory memory, std::uint64_t seed, CellTime now,
                   const CellHooks& hooks) {
    CellTime shown = now;
    shown.unix_ms = cell::unix_ms(before, now);
    const CarvedSoFar& carved = before.surroundings.carved;
    const auto cut_off = memory.jobs.find(carved.job);
    if (cut_off != memory.jobs.end() && !is_over(cut_off->second.state)) cut_off->second.last_block = carved.block;
    CellState cell = boot(before.limits, std::move(memory), seed, shown, hooks);
    cell.surroundings = before.surroundings;
    cell.faults = before.faults;
    cell.jump_ms = before.jump_ms;
    cell.store_free_kib = before.store_free_kib;
    return cell;
}

}  // namespace qchopper
