// The key with the id of the ticket, then Ed25519. O(keys).

#include "sim/cell/signature_check.h"

#include <algorithm>

#include "devices/wire/ticket_signature.h"

namespace qchopper {

std::optional<CommandAnswer> wrong_signature(const Registers& ticket, const Registers& signature,
                                             const CellLimits& limits, const CellHooks& hooks) {
    const Decoded<WireTicket> named = decode<WireTicket>(ticket);
    const Decoded<TicketSignature> given = decode<TicketSignature>(signature);
    if (!given.is_ok()) {  // all zero, or never written
        const bool may_be_unsigned = !limits.require_signature && named.value.key_id == 0;
        if (may_be_unsigned) return std::nullopt;
        return CommandAnswer{AckResult::bad_signature, signature_detail::unsigned_ticket};
    }
    if (!hooks.trusted_keys) {
        if (limits.require_signature) return CommandAnswer{AckResult::unknown_key};
        return std::nullopt;
    }
    const std::vector<CellKey> keys = hooks.trusted_keys();
    const auto key =
        std::ranges::find_if(keys, [&](const CellKey& k) { return key_id_of(k.key) == named.value.key_id; });
    if (key == keys.end()) return CommandAnswer{AckResult::unknown_key};
    if (key->is_revoked) return CommandAnswer{AckResult::unknown_key, signature_detail::revoked_key};
    if (is_signed_by(key->key, signed_bytes(ticket), given.value.signature)) return std::nullopt;
    return CommandAnswer{AckResult::bad_signature};
}

}  // namespace qchopper
