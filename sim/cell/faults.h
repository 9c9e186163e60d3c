// The faults that a simulated cell can be told to have, by name, and what they do to its answers.
//
// The table is the one place of the names: scripts, `cell-sim --list-faults` and docs/user/cell-sim.md are made from
// it. A fault is armed for a number of times and, if its chance is below 1, drawn from a seed: the same seed and the
// same calls give the same faults (tests/sim/cell/faults_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file.h"
#include "devices/wire/registers.h"

namespace qchopper {

enum class Fault : std::uint8_t {
    close_before_effect,
    close_before_answer,
    no_answer,
    answer_late,
    answer_bytewise,
    answer_truncated,
    wrong_transaction,
    wrong_protocol,
    wrong_unit,
    wrong_length,
    wrong_function,
    wrong_echo,
    exception,
    flip_status,
    torn_status,
    swap_words,
    flip_written,
    zero_holding,
    frozen_heartbeat,
    heartbeat_at,
    power_cut,
    power_cut_store_lost,
    power_cut_store_back,
    power_cut_all_back,
    disk_full,
    store_full,
    no_consent,
    door_after_consent,
    tool_fault,
    e_stop_at,
    spindle_loses_speed,
    signal_falls,
    clock_jump,
    count
};

struct NamedFault {
    Fault fault;
    const char* name;
    const char* argument;  // what its number means; empty: it has none
    std::int64_t usual;    // the number if none is given
    const char* meaning;
};
std::span<const NamedFault> all_faults();
// nullptr if no fault has that name.
const NamedFault* fault_named(std::string_view name);

struct ArmedFault {
    Fault fault = Fault::no_answer;
    std::int64_t number = 0;
    std::uint32_t times = 1;            // still to come; 0: for ever
    std::uint16_t per_thousand = 1000;  // chance at each occasion
};

struct Faults {
    std::vector<ArmedFault> armed;
    std::uint64_t random = 1;  // state of the generator of chances and of places
};

// The number of the fault if it is armed and drawn at this occasion; it is then used up once.
std::optional<std::int64_t> take(Faults& faults, Fault which);
// The same without using it up: its number while it is armed.
std::optional<std::int64_t> armed(const Faults& faults, Fault which);

// Of the registers of a whole input block before they are cut and sent. `flip_status` with a number below 0 draws the
// bit.
void spoil_read(Faults& faults, const Block& block, std::vector<std::uint16_t>& registers);
// Of the registers that came for a holding block: one bit of them.
void spoil_written(Faults& faults, std::vector<std::uint16_t>& registers);

// What is sent in place of one answer, in this order.
struct Delivery {
    std::int64_t after_ms = 0;  // since the delivery before
    Bytes bytes;
    bool then_close = false;
};
// `frame` is MBAP header and PDU of the right answer.
std::vector<Delivery> deliver(Faults& faults, Bytes frame);

}  // namespace qchopper
