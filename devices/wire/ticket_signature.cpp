// Ed25519 over 213 bytes. O(1).

#include "devices/wire/ticket_signature.h"

#include <cassert>

#include "base/sha256.h"
#include "devices/wire/codec.h"

namespace qchopper {

std::uint32_t key_id_of(const Ed25519PublicKey& key) {
    const Sha256 digest = sha256(key.bytes);
    std::uint32_t id = 0;
    for (std::size_t i = 0; i < 4; ++i) id = id << 8U | digest.bytes[i];
    return id;
}

std::vector<std::uint8_t> signed_bytes(std::span<const std::uint16_t> ticket) {
    assert(ticket.size() == ticket_block.count);
    constexpr std::size_t checksum = 2;  // registers
    std::vector<std::uint8_t> bytes(ticket_signature_head.begin(), ticket_signature_head.end());
    const std::vector<std::uint8_t> wire = bytes_of(ticket.first(ticket.size() - checksum));
    bytes.insert(bytes.end(), wire.begin(), wire.end());
    return bytes;
}

Registers sign_ticket(const Ed25519PrivateKey& key, std::span<const std::uint16_t> ticket) {
    return encode(TicketSignature{key.sign(signed_bytes(ticket))});
}

}  // namespace qchopper
