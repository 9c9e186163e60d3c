// One block of each kind, sequences of steps for the simulated cell (cell_steps.h), and a memory.json.

#include <algorithm>

#include "devices/wire/codec.h"
#include "sim/cell/memory.h"
#include "tests/fuzz/cell_steps.h"
#include "tests/fuzz/seeds.h"

namespace qchopper {
namespace {

// Which block, which bit is changed, its registers (fuzz_blocks.cpp).
Encoded block_seed(std::uint8_t which, const std::string& name, const Registers& registers) {
    Bytes bytes{which, 0, 77};
    for (const std::uint16_t word : registers) {
        bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
        bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
    }
    return {"blocks", name, bytes};
}

std::uint8_t of(Step step) {
    return static_cast<std::uint8_t>(step);
}

std::uint8_t of(CellCommand command) {
    const auto* found = std::find(all_commands.begin(), all_commands.end(), command);
    return static_cast<std::uint8_t>(found - all_commands.begin());
}

// One command, with everything right (cell_steps.cpp, chosen_command); `job` 2 is none.
void add(Bytes& steps, CellCommand command, unsigned job = 0) {
    steps.insert(steps.end(), {of(Step::command), of(command), static_cast<std::uint8_t>(job << 2U)});
}

void pass(Bytes& steps, std::uint16_t hundredths) {
    steps.insert(steps.end(), {of(Step::time), static_cast<std::uint8_t>(hundredths >> 8U),
                               static_cast<std::uint8_t>(hundredths & 0xFFU)});
}

// To a prepared job; `choice` goes to the ticket.
Bytes prepared(std::uint8_t choice) {
    Bytes steps;
    add(steps, CellCommand::claim, 2);
    add(steps, CellCommand::reset, 2);
    pass(steps, 30);
    steps.insert(steps.end(), {of(Step::ticket), choice});
    add(steps, CellCommand::store);
    if ((choice & 2U) != 0) {
        for (std::uint16_t at = 0; at < 1000; at = static_cast<std::uint16_t>(at + 200)) {
            steps.insert(steps.end(), {of(Step::chunk), static_cast<std::uint8_t>(at >> 8U),
                                       static_cast<std::uint8_t>(at & 0xFFU), 199, 0});
        }
    }
    add(steps, CellCommand::verify);
    steps.insert(steps.end(), {of(Step::file), 0});
    add(steps, CellCommand::prepare);
    pass(steps, 1);
    return steps;
}

Bytes whole_job(std::uint8_t choice) {
    Bytes steps = prepared(choice);
    add(steps, CellCommand::start);
    add(steps, CellCommand::query);
    for (std::uint8_t n = 1; n < 10; ++n) {
        steps.insert(steps.end(), {of(Step::heartbeat), 0, n});
        pass(steps, 200);
    }
    add(steps, CellCommand::hold);
    pass(steps, 100);
    add(steps, CellCommand::unhold);
    pass(steps, 12000);
    add(steps, CellCommand::claim, 2);
    add(steps, CellCommand::query);
    add(steps, CellCommand::clear_result);
    add(steps, CellCommand::release, 2);
    return steps;
}

Bytes cut_off() {
    Bytes steps = prepared(0);
    add(steps, CellCommand::start);
    pass(steps, 50);
    steps.insert(steps.end(), {of(Step::power_cut), 1});
    add(steps, CellCommand::claim, 2);
    add(steps, CellCommand::clear, 2);
    pass(steps, 50);
    add(steps, CellCommand::query);
    const Bytes again = prepared(0);
    steps.insert(steps.end(), again.begin(), again.end());
    add(steps, CellCommand::start);
    return steps;
}

Bytes reads() {
    Bytes steps;
    std::uint8_t n = 0;
    for (const Block* block : all_blocks()) {
        const std::uint8_t function = block->side == Side::input ? 4 : 3;
        steps.insert(steps.end(),
                     {of(Step::raw), 5, function, static_cast<std::uint8_t>(block->base >> 8U),
                      static_cast<std::uint8_t>(block->base & 0xFFU), 0, static_cast<std::uint8_t>(block->count)});
        steps.insert(steps.end(), {of(Step::zeros), n++});
    }
    return steps;
}

Bytes some_memory() {
    CellMemory memory;
    memory.boot_count = 3;
    memory.epoch_held = 7;
    memory.starts_total = 1;
    JobRecord& record = memory.jobs[Uuid{1, 0xAB}];
    record.state = JobState::ended;
    record.result = JobResult::complete;
    record.starts = 1;
    memory.jobs[Uuid{2, 0xAB}].state = JobState::cancelled;
    const std::string text = to_json(memory);
    return {text.begin(), text.end()};
}

// Stops if the steps do not lead to so many starts.
Encoded pdu_seed(const std::string& name, const Bytes& steps, std::uint32_t starts) {
    Input input(steps.data(), steps.size());
    CellSteps cell;
    cell.run(input);
    demand(cell.starts() == starts);
    return {"pdu", name, steps};
}

void add_frame(Bytes& stream, const Bytes& pdu, std::uint8_t unit = 1) {
    const std::size_t length = pdu.size() + 1;
    stream.insert(stream.end(), {0, 1, 0, 0, static_cast<std::uint8_t>(length >> 8U),
                                 static_cast<std::uint8_t>(length & 0xFFU), unit});
    for (const std::uint8_t byte : pdu) stream.push_back(byte);
}

Bytes write_of(const Block& block, const Registers& registers) {
    Bytes pdu{16, static_cast<std::uint8_t>(block.base >> 8U), static_cast<std::uint8_t>(block.base & 0xFFU),
              0,  static_cast<std::uint8_t>(registers.size()), static_cast<std::uint8_t>(2 * registers.size())};
    for (const std::uint16_t word : registers) {
        pdu.push_back(static_cast<std::uint8_t>(word >> 8U));
        pdu.push_back(static_cast<std::uint8_t>(word & 0xFFU));
    }
    return pdu;
}

// Byte 0 is for fuzz_stream.cpp; then a read of STATUS, a CLAIM, a heartbeat, a chunk, a function that is not served,
// a unit that is not there, and a header that is none.
Bytes stream_seed() {
    Command claim;
    claim.command = CellCommand::claim;
    claim.epoch = claim.seq = 1;
    claim.owner = 2;
    Bytes stream{7};
    add_frame(stream, {4, 0, 0, 0, 100});
    add_frame(stream, write_of(command_block, encode(claim)));
    add_frame(stream, write_of(heartbeat_block, encode(Heartbeat{1, 2, 3})));
    add_frame(stream, write_of(chunk_block, encode(Chunk{0, {1, 2, 3}, 9})));
    add_frame(stream, {43, 14, 1, 0});
    add_frame(stream, {3, 0, 0, 0, 60}, 99);
    stream.insert(stream.end(), {0, 1, 0, 7, 0, 6, 1, 4});
    return stream;
}

}  // namespace

std::vector<Encoded> link_seeds() {
    Status status;
    status.alarm_text = "Tool broke";
    WireTicket ticket;
    ticket.file_name = "a.qjob";
    Command command;
    command.command = CellCommand::start;
    ResultRecord result;
    result.starts = 1;
    return {block_seed(0, "status", encode(status)),
            block_seed(1, "result", encode(result)),
            block_seed(2, "command", encode(command)),
            block_seed(3, "ticket", encode(ticket)),
            block_seed(4, "heartbeat", encode(Heartbeat{1, 2, 3})),
            block_seed(5, "chunk", encode(Chunk{0, {1, 2, 3}, 9})),
            block_seed(6, "identity", encode(Identity{map_version, Uuid{1, 2}, 3, 5, 4, 1700000000000})),
            pdu_seed("folder-job", whole_job(0), 1),
            pdu_seed("chunk-job", whole_job(2), 1),
            pdu_seed("holding-job", whole_job(4), 1),
            pdu_seed("cut-off", cut_off(), 1),
            pdu_seed("reads", reads(), 0),
            {"stream", "all-kinds", stream_seed()},
            {"memory", "two-jobs", some_memory()}};
}

}  // namespace qchopper
