// Decodes one step after the other from the input, performs it, and checks the invariants. O(bytes), at most 300 steps.

#include "tests/fuzz/cell_steps.h"

#include <algorithm>

#include "sim/cell/modbus_pdu.h"
#include "sim/cell/panel.h"
#include "tests/sim/cell/good_ticket.h"

namespace qchopper {
namespace {

constexpr std::uint32_t owners[] = {0x11111111, 0x22222222, 0};
constexpr Uuid jobs[] = {Uuid{0xA, 1}, Uuid{0xB, 1}, Uuid{}, bench::any_job};

void add_word(Bytes& bytes, std::size_t word) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
}

}  // namespace

CellSteps::CellSteps() {
    hooks_.save = [this](const CellMemory& memory) {
        if (can_save_) disk_ = memory;
        return can_save_;
    };
    cell_ = boot({}, {}, 42, now_, hooks_);
    cell_.store_free_kib = 1000000;
}

void CellSteps::run(Input& input) {
    for (std::size_t n = 0; n < max_steps && !input.is_empty(); ++n) {
        const bool was_active = cell_.job.is_active();
        step(input);
        restart_after_cut();
        demand_one_start(was_active);
        if (n % 16 == 0) demand_status();
    }
    demand_status();
}

void CellSteps::step(Input& input) {
    switch (static_cast<Step>(input.u8() % static_cast<unsigned>(Step::count))) {
        case Step::raw:
            answer(input.bytes(input.u8()));
            return;
        case Step::command:
            return write(command_block.base, encode(chosen_command(input)));
        case Step::ticket:
            return write_ticket(input);
        case Step::heartbeat: {
            const std::uint32_t owner = owners[input.u8() % 3];
            return write(heartbeat_block.base, encode(Heartbeat{cell_.memory.epoch_held, owner, input.u8()}));
        }
        case Step::chunk:
            return write_chunk(input);
        case Step::time: {
            const unsigned ms = 10U * input.u16();
            now_.steady_ms += ms;
            now_.unix_ms += ms;
            return pass_time(cell_, now_, hooks_);
        }
        case Step::file:
            return check_file(input);
        case Step::consent: {
            const bool yes = (input.u8() & 1U) != 0;
            if (cell_.pending) consent_given(cell_, cell_.pending->number, yes, now_, hooks_);
            return;
        }
        case Step::zeros: {
            const auto blocks = all_blocks();
            const Block& block = *blocks[input.u8() % blocks.size()];
            if (block.side == Side::holding) write_zeros(block);
            return;
        }
        case Step::power_cut:
            cell_ = boot({}, disk_, 42 + input.u8(), now_, hooks_);
            cell_.store_free_kib = 1000000;
            return;
        case Step::disk:
            can_save_ = (input.u8() & 1U) != 0;
            return;
        case Step::panel:
            return act_on_panel(input);
        case Step::fault:
            return arm_fault(input);
        case Step::count:
            return;
    }
}

Bytes CellSteps::answer(const Bytes& pdu) {
    const Bytes bytes = answer_pdu(1, pdu, cell_, now_, hooks_);
    demand(bytes.size() >= 2 && bytes.size() <= 253);
    const std::uint8_t function = pdu.empty() ? 0 : pdu[0];
    const bool is_exception = bytes[0] == (function | 0x80U) && bytes.size() == 2;
    demand(is_exception || bytes[0] == function);
    ++requests_;
    return bytes;
}

void CellSteps::write(std::uint16_t address, const Registers& registers) {
    Bytes pdu{16};
    add_word(pdu, address);
    add_word(pdu, registers.size());
    pdu.push_back(static_cast<std::uint8_t>(2 * registers.size()));
    for (const std::uint16_t word : registers) add_word(pdu, word);
    answer(pdu);
}

// One byte chooses between right and wrong epoch, sequence number, job and token, so that mutations find right ones.
Command CellSteps::chosen_command(Input& input) {
    Command command;
    command.command = all_commands[input.u8() % all_commands.size()];
    const unsigned choice = input.u8();
    const std::uint32_t held = cell_.memory.epoch_held;
    const bool is_claim = command.command == CellCommand::claim;
    command.epoch = is_claim == ((choice & 1U) == 0) ? held + 1 : held;
    seq_ += (choice & 2U) == 0 ? 1 : 0;  // or the same again
    command.seq = seq_;
    command.job_id = jobs[choice >> 2U & 3U];
    command.owner = owners[(choice >> 4U & 3U) % 3];
    command.token = (choice & 64U) == 0 ? cell_.job.token : input.u16();
    if ((choice & 128U) == 0) {
        command.file_sha256 = bench::good_digest();
        command.arg1 = command.owner;  // the secret of a claim
    } else {
        command.arg0 = input.u8() == 0 ? cell_.job.receipt : input.u8();
        command.arg1 = input.u8();
    }
    return command;
}

void CellSteps::write_ticket(Input& input) {
    const unsigned choice = input.u8();
    WireTicket ticket = bench::good_ticket(jobs[choice & 1U]);
    if ((choice & 2U) != 0) ticket.transfer = Transfer::chunks;
    if ((choice & 4U) != 0) ticket.on_link_loss = LinkLoss::hold;
    Registers registers = encode(ticket);
    const unsigned changes = choice >> 4U;
    registers.resize(registers.size() - 2);  // the checksum
    for (unsigned n = 0; n < changes; ++n) {
        const std::size_t at = input.u8() % registers.size();
        registers[at] = input.u16();
    }
    const std::uint32_t crc = crc32_of_registers(registers);
    registers.push_back(static_cast<std::uint16_t>(crc >> 16U));
    registers.push_back(static_cast<std::uint16_t>(crc & 0xFFFFU));
    write(ticket_block.base, registers);
}

void CellSteps::write_chunk(Input& input) {
    Chunk chunk;
    chunk.offset = input.u16();
    const unsigned length = input.u8();
    chunk.data.assign(1 + length % max_chunk_bytes, static_cast<std::uint8_t>(length));
    chunk.crc = (input.u8() & 1U) != 0 ? 0
                                       : chunk_crc(cell_.memory.epoch_held, cell_.lease ? cell_.lease->owner : 0,
                                                   cell_.job.ticket.job_id, chunk.offset, chunk.data);
    write(chunk_block.base, encode(chunk));
}

// A new or cleared client writes blocks of zeros: they must change nothing.
void CellSteps::write_zeros(const Block& block) {
    pass_time(cell_, now_, hooks_);
    const CellState before = cell_;
    write(block.base, Registers(block.count, 0));
    demand(cell_.state == before.state && cell_.mode == before.mode);
    demand(cell_.memory == before.memory);
    demand(cell_.job.state == before.job.state && cell_.job.token == before.job.token);
    demand(cell_.ack.seq == before.ack.seq && cell_.bad_frames == before.bad_frames);
    demand(cell_.lease.has_value() == before.lease.has_value());
    if (&block == &ticket_block) demand(cell_.ticket_draft.empty());
}

void CellSteps::act_on_panel(Input& input) {
    const std::span<const ActRow> rows = all_choices();
    const ActRow& row = rows[input.u8() % rows.size()];
    // The others are not of the machine, or would leave no question to answer.
    constexpr Act acts[] = {Act::door, Act::e_stop, Act::panel, Act::block, Act::tool};
    if (std::find(std::begin(acts), std::end(acts), row.act) == std::end(acts)) return;
    perform(cell_, {0, row.act, input.u8() % row.choices.size(), 0, {}}, now_, hooks_);
}

// Faults of the answers are not among them: answers are checked here.
void CellSteps::arm_fault(Input& input) {
    constexpr Fault faults[] = {Fault::power_cut,  Fault::power_cut_store_lost, Fault::power_cut_store_back,
                                Fault::disk_full,  Fault::store_full,           Fault::no_consent,
                                Fault::tool_fault, Fault::door_after_consent,   Fault::e_stop_at,
                                Fault::clock_jump};
    const Fault fault = faults[input.u8() % std::size(faults)];
    arm(cell_, {fault, input.u8()}, now_);
}

// An id may start again only if the store was lost.
void CellSteps::restart_after_cut() {
    if (!cell_.power.lost) return;
    if (cell_.power.store != PowerCut::Store::stays) started_.clear();
    disk_ = memory_after(cell_.power.store, disk_);
    cell_ = power_on(cell_, disk_, cell_.random, now_, hooks_);
}

void CellSteps::check_file(Input& input) {
    const unsigned how = input.u8() % 8;
    if (!cell_.pending) return;
    FileCheck check{FileCheck::End::ok, cell_.job.ticket.file_size, cell_.job.ticket.file_sha256};
    if (how == 5) check.end = FileCheck::End::missing;
    if (how == 6) check.end = FileCheck::End::io_error;
    if (how == 7) check.size += 1;
    if (how == 4) check.sha256.bytes[0] ^= 1U;
    file_checked(cell_, cell_.pending->number, check, now_, hooks_);
}

void CellSteps::demand_status() {
    const Bytes bytes = answer({4, 0, 0, 0, static_cast<std::uint8_t>(status_block.count)});
    demand(bytes.size() == 2U + 2U * status_block.count);
    Registers registers;
    for (std::size_t i = 2; i < bytes.size(); i += 2) {
        registers.push_back(static_cast<std::uint16_t>(bytes[i] << 8U | bytes[i + 1]));
    }
    demand(decode<Status>(registers).is_ok());
}

void CellSteps::demand_one_start(bool was_active) {
    for (const auto& [id, record] : cell_.memory.jobs) demand(record.starts <= 1);
    if (!cell_.job.is_active()) return;
    const Uuid& id = cell_.job.ticket.job_id;
    if (!was_active) demand(++started_[id] == 1);
    demand(disk_.jobs.contains(id) && disk_.jobs.at(id).starts == 1);
}

}  // namespace qchopper
