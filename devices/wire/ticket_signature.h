// Signs a ticket and says what is signed: its registers as they go over the wire.
//
// The job file is not signed itself: the ticket holds its SHA-256 (tests/devices/wire/ticket_signature_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "devices/wire/bus.h"
#include "devices/wire/ed25519.h"

namespace qchopper {

// What every signature over a ticket begins with, so that no signature over something else is one over a ticket.
constexpr std::string_view ticket_signature_head = "QCHOPPER-TICKET-1";

// KEY_ID: the first four bytes of the SHA-256 of the public key. It names a key, and proves nothing.
std::uint32_t key_id_of(const Ed25519PublicKey& key);

// The head and the bytes of 100..197, all of TICKET but its checksum. Precondition: `ticket` has the size of TICKET.
std::vector<std::uint8_t> signed_bytes(std::span<const std::uint16_t> ticket);

// SIGNATURE for these registers of TICKET, whose KEY_ID is that of `key`.
Registers sign_ticket(const Ed25519PrivateKey& key, std::span<const std::uint16_t> ticket);

}  // namespace qchopper
