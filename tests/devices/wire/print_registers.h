// Prints the register map of a cell as Markdown, from the tables that the program uses.

#pragma once

#include <string>

namespace qchopper {

// The text of docs/developer/formats/registers.md.
std::string print_registers();

}  // namespace qchopper
