// One read of STATUS. O(1).

#include "app/dispatch/contact_cell.h"

#include "app/dispatch/state_folder.h"
#include "base/error.h"
#include "cam/cell/cell.h"
#include "devices/hand_off/first_contact.h"
#include "devices/wire/device_error.h"

namespace qchopper {

Status first_status(ModbusTcpBus& bus, const std::string& where, const Context& context) {
    bus.connect();
    const std::optional<Status> status = read_first_status(bus, where, context);
    if (!status) throw Cancelled();
    return *status;
}

std::unique_ptr<ContactedCell> contact_cell(const CellChoice& choice, const Context& context) {
    std::optional<Cell> cell;
    if (choice.cell_file) cell = read_cell(*choice.cell_file);
    const std::optional<std::string> to = choice.to ? choice.to : cell ? cell->link.to : std::nullopt;
    if (!to)
        throw InputError(
            InputFault::use, "no cell address is known",
            Sentence::with_key("give_address_or_cell", {}, "give its address, or a cell file that has one"));
    auto contacted = std::make_unique<ContactedCell>(*to);
    contacted->status = first_status(contacted->bus, *to, context);
    const Status& status = contacted->status;
    const bool is_simulated = status.has(flag::simulated);
    if (cell && status.cell_id != cell->id && !(is_simulated && status.cell_id == any_cell_id)) {
        throw DeviceError(DeviceFault::refused,
                          "this is cell " + std::to_string(status.cell_id) + ", not cell " + std::to_string(cell->id) +
                              "; nothing was sent",
                          "Check the address, or the cell id in the cell file.");
    }
    contacted->journal_cell = journal_cell(status.cell_id, is_simulated, contacted->bus.peer());
    contacted->journal_folder = journal_folder(contacted->journal_cell);
    return contacted;
}

}  // namespace qchopper
