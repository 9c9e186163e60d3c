// O(log connections) for each request.

#include "sim/cell/drafts.h"

#include "sim/cell/modbus_pdu.h"

namespace qchopper {

void Drafts::begin(std::uint64_t connection, CellState& cell) {
    last_ = {cell.ticket_draft, cell.signature_draft};
    const auto own = own_.find(connection);
    if (own == own_.end()) return;
    cell.ticket_draft = own->second.ticket;
    cell.signature_draft = own->second.signature;
}

void Drafts::end(std::uint64_t connection, std::span<const std::uint8_t> pdu, CellState& cell) {
    if (writes_block(pdu, ticket_block) || writes_block(pdu, signature_block)) {
        own_[connection] = {cell.ticket_draft, cell.signature_draft};
    } else {
        cell.ticket_draft = last_.ticket;
        cell.signature_draft = last_.signature;
    }
}

void Drafts::forget(std::uint64_t connection) {
    own_.erase(connection);
}

}  // namespace qchopper
