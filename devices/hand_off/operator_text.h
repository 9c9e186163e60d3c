// What an operator is told of a cell in words: whether foam is being cut, what a command asks for, what to run.

#pragma once

#include <cstdint>
#include <string>

#include "devices/wire/packml.h"

namespace qchopper {

// Whether foam is being cut in this state, as a clause: "the cell is cutting foam".
const char* foam_in(PackState state);

// What a command asks of the cell: "CLAIM (take this computer as its dispatcher)". The commands of PackML have their
// names only, which say it.
std::string in_words(CellCommand command);

// "dispatcher 0x1234ABCD", by its OWNER number.
std::string dispatcher_name(std::uint32_t owner);

// "qchopper cell status --to HOST:PORT" for `words` "status"; without an address if that is empty.
std::string cell_command(const std::string& address, const std::string& words);

}  // namespace qchopper
