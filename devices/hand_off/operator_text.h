// What an operator is told of a cell in words: whether foam is being cut, what a command asks for, what to run.

#pragma once

#include <cstdint>
#include <string>

#include "base/sentence.h"
#include "devices/wire/blocks.h"
#include "devices/wire/packml.h"

namespace qchopper {

// Whether foam is being cut in this state, as a clause: "the cell is cutting foam".
const char* foam_in(PackState state);

// What a command asks of the cell: "CLAIM (take this computer as its dispatcher)". The commands of PackML have their
// names only, which say it.
std::string in_words(CellCommand command);

// Where the program of a running job is: "chunk 3, line 412, tool 2 at X 10.00 Y -4.50 Z 120.00 mm, 12 min left".
// Without a chunk where the cell names none; the time only where the cell knows it.
std::string program_place(const Status& status);

// "dispatcher 0x1234ABCD", by its OWNER number.
std::string dispatcher_name(std::uint32_t owner);

// What to do where a file was carved before.
Sentence carve_again();

// What to do while another dispatcher has the lease of the cell at this address, which may be empty.
Sentence wait_or_take_over(const std::string& address);

}  // namespace qchopper
