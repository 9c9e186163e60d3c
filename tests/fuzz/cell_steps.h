// Drives a simulated cell by the bytes of an input: requests as they are, requests with right checksums, time, answers
// of the operator, power cuts. Used by fuzz_pdu.cpp and link_seeds.cpp.
//
// Checks that every answer is well formed, that a status can be decoded, that no job id is started twice, also across
// power cuts, and that a running job is in the saved memory. Stops the program (demand.h) where one does not hold.

#pragma once

#include <map>

#include "sim/cell/machine.h"
#include "tests/fuzz/demand.h"

namespace qchopper {

enum class Step : std::uint8_t {
    raw,        // length, PDU
    command,    // the choices of chosen_command
    ticket,     // number of changes, each index and two bytes of a word; its checksum is right
    heartbeat,  // owner, counter
    chunk,      // offset (2), length, right or not
    time,       // hundredths of a second (2)
    file,       // how the file was found
    consent,    // yes or no
    zeros,      // which block
    power_cut,
    disk,   // can it be written from now on
    panel,  // what a person does
    fault,  // which, its number
    count
};

class CellSteps {
 public:
    CellSteps();
    CellSteps(const CellSteps&) = delete;
    CellSteps& operator=(const CellSteps&) = delete;
    void run(Input& input);
    std::uint32_t starts() const { return cell_.memory.starts_total; }
    std::size_t requests() const { return requests_; }  // answered so far

    static constexpr std::size_t max_steps = 300;

 private:
    void step(Input& input);
    Bytes answer(const Bytes& pdu);
    void write(std::uint16_t address, const Registers& registers);
    Command chosen_command(Input& input);
    void write_ticket(Input& input);
    void write_chunk(Input& input);
    void write_zeros(const Block& block);
    void check_file(Input& input);
    void act_on_panel(Input& input);
    void arm_fault(Input& input);
    void restart_after_cut();
    void demand_status();
    void demand_one_start(bool was_active);

    CellTime now_{1000000, 1700000000000};
    CellHooks hooks_;
    CellMemory disk_;
    bool can_save_ = true;
    CellState cell_;
    std::map<Uuid, int> started_;
    std::uint32_t seq_ = 0;
    std::size_t requests_ = 0;
};

}  // namespace qchopper
