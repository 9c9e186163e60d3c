// Which cell is meant, and its STATUS, read before anything is sent.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/context.h"
#include "devices/journal/journal.h"
#include "devices/wire/blocks.h"
#include "devices/wire/modbus_tcp.h"

namespace qchopper {

// By its address, or by the file that names it; the address comes first.
struct CellChoice {
    std::optional<std::string> to;  // HOST:PORT
    std::optional<std::filesystem::path> cell_file;
};

// A cell that has answered, and where this computer keeps the journal of it.
struct ContactedCell {
    explicit ContactedCell(const std::string& to) : endpoint(to), bus(parse_tcp_address(to)) {}
    std::string endpoint;
    ModbusTcpBus bus;
    Status status;
    JournalCell journal_cell;
    std::filesystem::path journal_folder;
};

// STATUS of the cell at `where`. Throws DeviceError, and Cancelled if a stop was requested.
Status first_status(ModbusTcpBus& bus, const std::string& where, const Context& context);

// Throws InputError (use) if no address is known, what read_cell and first_status throw, and DeviceError (refused) if
// the cell is not the one of the file. A simulated cell without an id of its own is taken for any.
std::unique_ptr<ContactedCell> contact_cell(const CellChoice& choice, const Context& context);

}  // namespace qchopper
