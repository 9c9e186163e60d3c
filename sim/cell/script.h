// The language of scripts and of the commands on standard input of a simulated cell: what a person at the cell does,
// what goes wrong, and when. One line is one command; docs/user/cell-sim.md has the grammar.
//
// A line is words, numbers among them; "#" begins a comment, an empty line says nothing. Every command and every fault
// is read back as the line that was written (tests/sim/cell/script_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cell/faults.h"

namespace qchopper {

enum class Act : std::uint8_t {
    consent,
    policy,
    door,
    e_stop,
    panel,
    block,
    tool,
    power,
    clock,
    wait_for,
    wait,
    seed,
    fault,
    clear_faults,
    show,
    quit
};

// The words behind the first of those commands that choose among a few; `choice` is the place of the word.
struct ActRow {
    Act act;
    const char* word;
    std::vector<const char*> choices;
};
std::span<const ActRow> all_choices();

struct ScriptLine {
    std::size_t line = 0;  // from 1
    Act act = Act::show;
    std::size_t choice = 0;
    double number = 0;  // of wait and seed
    ArmedFault fault;   // of fault
};

// Nothing for an empty line. Throws InputError (config): `name`, the line and what is wrong with it.
std::optional<ScriptLine> parse_script_line(std::string_view text, std::size_t line, const std::string& name);
// All lines of a text.
std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name);

}  // namespace qchopper
