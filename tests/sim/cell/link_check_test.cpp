// `cell check` finds nothing at the simulated cell, and names the register of each planted deviation.

#include "devices/link_check/link_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "devices/wire/codec.h"
#include "devices/wire/device_error.h"
#include "sim/cell/modbus_pdu.h"
#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

void seal(Registers& block) {
    const std::uint32_t crc = crc32_of_registers(std::span(block).first(block.size() - 2));
    block[block.size() - 2] = static_cast<std::uint16_t>(crc >> 16U);
    block[block.size() - 1] = static_cast<std::uint16_t>(crc & 0xFFFFU);
}

// A controller: the simulated one in virtual time, changed by what is planted.
class PlantedCell : public RegisterBus {
 public:
    PlantedCell() = default;

    BusAnswer read_input(std::uint16_t address, std::uint16_t count) override {
        if (hides_identity && address == identity_block.base) return exception(2);
        BusAnswer answer = call(4, address, count, {});
        if (!answer.is_ok()) return answer;
        if (address == status_block.base && change_status) {
            change_status(answer.registers);
            const std::uint32_t crc = crc32_of_registers(std::span(answer.registers).first(96));
            answer.registers[96] = static_cast<std::uint16_t>(crc >> 16U);
            answer.registers[97] = static_cast<std::uint16_t>(crc & 0xFFFFU);
        }
        if (address == status_block.base && swaps_crc) std::swap(answer.registers[96], answer.registers[97]);
        if (address == result_block.base && change_result) {
            change_result(answer.registers);
            seal(answer.registers);
        }
        return answer;
    }
    BusAnswer read_holding(std::uint16_t address, std::uint16_t count) override { return call(3, address, count, {}); }
    BusAnswer write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) override {
        Registers block(registers.begin(), registers.end());
        if (takes_parts && address == command_block.base && block.size() < command_block.count) {
            BusAnswer taken;
            taken.end = BusEnd::ok;
            return taken;
        }
        if (change_write) change_write(address, block);
        return call(16, address, static_cast<std::uint16_t>(block.size()), block);
    }

    LinkCheck check(bool consents = true) {
        LinkCheckOptions options;
        options.consent = [=](const std::string&) { return consents; };
        options.clock.now_s = [this] { return static_cast<double>(bench.now.steady_ms) / 1000; };
        options.clock.sleep = [this](double seconds) { pass(seconds); };
        options.random = [this] { return number_ = 1664525 * number_ + 1013904223; };
        return check_link(*this, options, {});
    }

    bench::Bench bench;
    std::function<void(Registers&)> change_status;
    std::function<void(Registers&)> change_result;
    std::function<void(std::uint16_t address, Registers&)> change_write;
    std::function<void()> each_step;
    bool swaps_crc = false;
    bool takes_parts = false;
    bool hides_identity = false;

 private:
    static BusAnswer exception(int code) {
        BusAnswer answer;
        answer.end = BusEnd::exception;
        answer.exception = code;
        return answer;
    }

    BusAnswer call(std::uint8_t function, std::uint16_t address, std::uint16_t count, const Registers& registers) {
        Bytes pdu{function, static_cast<std::uint8_t>(address >> 8U), static_cast<std::uint8_t>(address & 0xFFU),
                  static_cast<std::uint8_t>(count >> 8U), static_cast<std::uint8_t>(count & 0xFFU)};
        if (function == 16) {
            pdu.push_back(static_cast<std::uint8_t>(2 * count));
            for (const std::uint16_t one : registers) {
                pdu.push_back(static_cast<std::uint8_t>(one >> 8U));
                pdu.push_back(static_cast<std::uint8_t>(one & 0xFFU));
            }
        }
        const Bytes answer = answer_pdu(1, pdu, bench.cell, bench.now, bench.hooks);
        pass(0.01);
        if ((answer.at(0) & 0x80U) != 0) return exception(answer.at(1));
        BusAnswer out;
        out.end = BusEnd::ok;
        if (function == 16) return out;
        for (std::size_t i = 2; i + 1 < answer.size(); i += 2) {
            out.registers.push_back(static_cast<std::uint16_t>(answer[i] << 8U | answer[i + 1]));
        }
        return out;
    }

    void pass(double seconds) {
        for (int steps = std::max(1, static_cast<int>(100 * seconds)); steps > 0; --steps) {
            if (each_step) each_step();
            bench.pass(10);
            const auto& pending = bench.cell.pending;
            if (!pending || pending->waits != Pending::Waits::file) continue;
            const Bytes& file = bench.cell.job.chunks;
            file_checked(bench.cell, pending->number, {FileCheck::End::ok, file.size(), sha256(file)}, bench.now,
                         bench.hooks);
        }
    }

    std::uint32_t number_ = 7;
};

std::string deviations_of(const LinkCheck& check) {
    std::string text;
    for (const CheckedRule& rule : check.rules) {
        if (!rule.holds) text += rule.block + " " + rule.field + " " + rule.rule + ": " + rule.seen + "\n";
    }
    for (const std::string& why : check.not_checked) text += why + "\n";
    return text;
}

TEST(LinkCheck, FindsNothingAtTheSimulatedCellAndStartsNothing) {
    PlantedCell cell;
    const LinkCheck check = cell.check();
    EXPECT_TRUE(check.holds()) << deviations_of(check);
    EXPECT_TRUE(check.not_checked.empty()) << deviations_of(check);
    EXPECT_GT(check.rules.size(), 100U);
    EXPECT_EQ(cell.bench.cell.memory.starts_total, 0U);
    EXPECT_EQ(cell.bench.status().owner_held, 0U);
    EXPECT_EQ(cell.bench.status().job_state, JobState::none);
    const LinkCheck again = cell.check();
    EXPECT_TRUE(again.holds()) << deviations_of(again);
}

TEST(LinkCheck, WithoutAgreementNothingIsSentThatCouldMoveAnything) {
    PlantedCell cell;
    std::string sent;
    cell.change_write = [&](std::uint16_t address, const Registers& block) {
        if (address == command_block.base) sent += std::to_string(block[address_of(command_block, "CMD")]) + " ";
    };
    const LinkCheck check = cell.check(false);
    EXPECT_TRUE(check.holds()) << deviations_of(check);
    EXPECT_FALSE(check.not_checked.empty());
    for (const char* what : {" 1 ", " 2 ", " 9 ", " 104 "}) {
        EXPECT_EQ((" " + sent).find(what), std::string::npos) << sent;
    }
    EXPECT_EQ(cell.bench.cell.state, PackState::stopped);
}

TEST(LinkCheck, StartIsNeverSent) {
    PlantedCell cell;
    cell.change_write = [&](std::uint16_t address, const Registers& block) {
        if (address != command_block.base) return;
        EXPECT_NE(block[address_of(command_block, "CMD")], 2);
    };
    cell.check();
}

TEST(LinkCheck, ACellInUseIsLeftAlone) {
    PlantedCell cell;
    cell.bench.to_stored();
    EXPECT_THROW(cell.check(), DeviceError);
    EXPECT_EQ(cell.bench.cell.ack.seq, cell.bench.seq);
}

struct Deviation {
    const char* what;
    const char* block;
    const char* field;
    void (*plant)(PlantedCell&);
};

std::uint16_t& at(Registers& status, const char* field) {
    return status[address_of(status_block, field)];
}
CellState& state(PlantedCell& cell) {
    return cell.bench.cell;
}

const Deviation deviations[] = {
    {"the heartbeat stands still", "STATUS", "CELL_HB",
     [](PlantedCell& c) { c.change_status = [](Registers& s) { at(s, "CELL_HB") = 7; }; }},
    {"b11 is never set", "STATUS", "FLAGS",
     [](PlantedCell& c) {
         c.change_status = [](Registers& s) { at(s, "FLAGS") &= static_cast<std::uint16_t>(~flag::lease_held); };
     }},
    {"CRC with its low word first", "STATUS", "STATUS_CRC", [](PlantedCell& c) { c.swaps_crc = true; }},
    {"EPOCH_HELD with its low word first", "STATUS", "EPOCH_HELD",
     [](PlantedCell& c) {
         c.change_status = [](Registers& s) {
             const std::uint16_t place = address_of(status_block, "EPOCH_HELD");
             std::swap(s[place], s[place + 1U]);
         };
     }},
    {"a part of COMMAND is taken", "COMMAND", "MAGIC", [](PlantedCell& c) { c.takes_parts = true; }},
    {"the CRC of COMMAND is not compared", "STATUS", "BAD_FRAMES",
     [](PlantedCell& c) {
         c.change_write = [](std::uint16_t address, Registers& block) {
             const bool is_command = address == command_block.base && block.size() == command_block.count;
             if (is_command && block[0] == cell_magic) seal(block);
         };
     }},
    {"a repeated frame draws another grant", "STATUS", "ACK_DETAIL",
     [](PlantedCell& c) {
         c.change_status = [n = 0](Registers& s) mutable {
             at(s, "ACK_DETAIL") = static_cast<std::uint16_t>(at(s, "ACK_DETAIL") + ++n);
         };
     }},
    {"every CLAIM is granted", "STATUS", "OWNER_HELD",
     [](PlantedCell& c) {
         c.change_write = [&c](std::uint16_t address, Registers& block) {
             if (address == command_block.base && block[address_of(command_block, "CMD")] == 100) {
                 state(c).lease.reset();
             }
         };
     }},
    {"a lease never ends", "STATUS", "OWNER_HELD",
     [](PlantedCell& c) {
         c.each_step = [&c] {
             if (state(c).lease) state(c).lease->until_ms = c.bench.now.steady_ms + 4000;
         };
     }},
    {"QUERY_OWNER stays 0", "RESULT", "QUERY_OWNER",
     [](PlantedCell& c) { c.change_result = [](Registers& r) { r[44] = r[45] = 0; }; }},
    {"there is no IDENTITY", "IDENTITY", "MAGIC", [](PlantedCell& c) { c.hides_identity = true; }},
    {"reserved registers are not looked at", "STATUS", "ACK_RESULT",
     [](PlantedCell& c) {
         c.change_write = [](std::uint16_t address, Registers& block) {
             if (address != command_block.base || block.size() != command_block.count) return;
             if (std::exchange(block[address_of(command_block, "CMD_FLAGS")], 0) != 0) seal(block);
         };
     }},
    {"XFER_NEXT does not go on", "STATUS", "XFER_NEXT",
     [](PlantedCell& c) { c.change_status = [](Registers& s) { s[address_of(status_block, "XFER_NEXT") + 1U] = 0; }; }},
    {"a cancelled job is forgotten", "RESULT", "JOB_STATE",
     [](PlantedCell& c) { c.each_step = [&c] { state(c).memory.jobs.clear(); }; }},
    {"a CLAIM keeps the prepared job", "STATUS", "TOKEN",
     [](PlantedCell& c) {
         c.change_status = [kept = std::uint16_t{0}](Registers& s) mutable {
             const std::uint16_t place = address_of(status_block, "TOKEN");
             if (s[place] != 0) kept = s[place];
             if (at(s, "JOB_STATE") == 1) s[place] = kept;
         };
     }},
};

TEST(LinkCheck, NamesTheRegisterOfEachPlantedDeviation) {
    for (const Deviation& deviation : deviations) {
        PlantedCell cell;
        deviation.plant(cell);
        const LinkCheck check = cell.check();
        EXPECT_FALSE(check.holds()) << deviation.what;
        const bool is_named = std::ranges::any_of(check.rules, [&](const CheckedRule& rule) {
            return !rule.holds && rule.block == deviation.block && rule.field == deviation.field && !rule.seen.empty();
        });
        EXPECT_TRUE(is_named) << deviation.what << ":\n" << deviations_of(check);
    }
}

}  // namespace
}  // namespace qchopper
