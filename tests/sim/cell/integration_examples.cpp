// The frames are encoded by devices/wire; the bytes of the page are what the cell is sent in the test.

#include "tests/sim/cell/integration_examples.h"

#include <cstdio>

#include "devices/wire/codec.h"
#include "devices/wire/modbus_frame.h"

namespace qchopper {
namespace {

constexpr std::uint32_t owner = 0x11223344;
constexpr std::uint32_t secret = 0x55667788;
constexpr Uuid job_id{0x10, 0x32, 0x54, 0x76, 0x98, 0xBA, 0x4C, 0xDE, 0x8F, 0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD};

const Bytes& job_file() {
    static const Bytes file{'j', 'o', 'b', ' ', 'f', 'i', 'l', 'e', '\n'};
    return file;
}

WireTicket ticket() {
    WireTicket t;
    t.job_id = job_id;
    t.file_sha256 = sha256(job_file());
    t.file_size = static_cast<std::uint32_t>(job_file().size());
    t.transfer = Transfer::chunks;
    t.file_name = "A.qjob";
    t.box_min = {-1000, -1000, 0};
    t.box_max = {1000, 1000, 2000};
    t.stock = {3000, 3000, 3000};
    t.material = 1;
    t.tool_no = 1;
    t.tool_diameter_um = 6000;
    t.estimated_time_s = 1;
    t.piece_no = t.piece_count = 1;
    t.project_id = {1, 2, 3, 4};
    t.created_ms = 1795824000000;
    t.cell_id = any_cell_id;
    t.made_for = 1;
    return t;
}

class Writer {
 public:
    void read(const std::string& title, const Block& block) {
        const ModbusRequest request{++transaction_, 1, ModbusFunction::read_input, block.base, block.count, {}};
        Bytes answer = begin(static_cast<std::uint16_t>(3 + 2 * block.count));
        answer.insert(answer.end(), {1, 4, static_cast<std::uint8_t>(2 * block.count)});
        requests.push_back({title, frame_of(request), answer});
    }
    void write(const std::string& title, const Block& block, const Registers& registers,
               AckResult wanted = AckResult::none) {
        const ModbusRequest request{
            ++transaction_, 1, ModbusFunction::write_holding, block.base, static_cast<std::uint16_t>(registers.size()),
            registers};
        const Bytes frame = frame_of(request);
        Bytes answer = begin(6);
        answer.insert(answer.end(), frame.begin() + 6, frame.begin() + 12);  // unit, function, address, count
        requests.push_back({title, frame, answer, wanted});
    }
    void command(const std::string& title, CellCommand what, AckResult wanted, bool names_job,
                 std::uint32_t token = 0) {
        Command c;
        c.epoch = 1;
        c.owner = owner;
        c.seq = ++seq_;
        c.command = what;
        c.token = token;
        if (what == CellCommand::claim) c.arg1 = secret;
        if (names_job) c.job_id = job_id;
        if (names_job || what == CellCommand::query_file) c.file_sha256 = ticket().file_sha256;
        write(title, command_block, encode(c), wanted);
    }
    std::vector<WorkedRequest> requests;

 private:
    Bytes begin(std::uint16_t length) const {
        return {static_cast<std::uint8_t>(transaction_ >> 8U), static_cast<std::uint8_t>(transaction_ & 0xFFU), 0, 0,
                static_cast<std::uint8_t>(length >> 8U),       static_cast<std::uint8_t>(length & 0xFFU)};
    }
    std::uint16_t transaction_ = 0;
    std::uint32_t seq_ = 0;
};

std::string hex_lines(const char* mark, const Bytes& bytes, bool goes_on) {
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        char byte[4];
        std::snprintf(byte, sizeof byte, "%02X", bytes[i]);
        if (i % 24 == 0) text += (i == 0 ? std::string(mark) : "\n ");
        if (i == 7) text += " |";
        text += std::string(" ") + byte;
    }
    return text + (goes_on ? " ..\n" : "\n");
}

}  // namespace

std::vector<WorkedRequest> worked_requests() {
    Writer w;
    const WireTicket t = ticket();
    Chunk chunk{0, job_file(), 0};
    chunk.crc = chunk_crc(1, owner, job_id, 0, chunk.data);
    using enum AckResult;
    w.read("Read STATUS", status_block);
    w.read("Read IDENTITY", identity_block);
    w.command("CLAIM: epoch 1, owner 0x11223344, secret 0x55667788", CellCommand::claim, ok, false);
    w.write("HEARTBEAT, the first one", heartbeat_block, encode(Heartbeat{1, owner, 1}));
    w.command("QUERY: does the cell know the job?", CellCommand::query, unknown_job, true);
    w.read("Read RESULT", result_block);
    w.command("QUERY_FILE: was this file carved before?", CellCommand::query_file, unknown_job, false);
    w.command("Reset, from Stopped to Idle", CellCommand::reset, ok, false);
    w.write("TICKET", ticket_block, encode(t));
    w.write("SIGNATURE: unsigned", signature_block, Registers(signature_block.count));
    w.command("STORE", CellCommand::store, ok, true);
    w.write("CHUNK: the 9 bytes of the file", chunk_block, encode(chunk));
    w.command("VERIFY", CellCommand::verify, ok, true);
    w.command("PREPARE; the operator consents", CellCommand::prepare, ok, true);
    w.command("Start, with the TOKEN of STATUS, here 0x12345678", CellCommand::start, ok, true, example_token);
    w.command("QUERY, after the end of the job", CellCommand::query, ok, true);
    w.command("CLEAR_RESULT", CellCommand::clear_result, ok, true);
    w.command("Reset, from Complete to Idle", CellCommand::reset, ok, false);
    w.command("RELEASE", CellCommand::release, ok, false);
    return w.requests;
}

std::string print_examples() {
    std::string text = "\n";
    for (const WorkedRequest& one : worked_requests()) {
        text += "**" + one.title + "**";
        if (one.wanted != AckResult::none) text += std::string(". ACK_RESULT then: ") + name(one.wanted);
        text += "\n\n```\n" + hex_lines(">", one.request, false);
        text += hex_lines("<", one.answer, one.answer.at(7) == 4) + "```\n\n";
    }
    return text;
}

}  // namespace qchopper
