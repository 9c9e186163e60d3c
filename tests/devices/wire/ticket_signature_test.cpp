// What is signed of a ticket, against bytes put together by hand.

#include "devices/wire/ticket_signature.h"

#include <gtest/gtest.h>

#include "base/hex.h"
#include "base/sha256.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

// The first test vector of RFC 8032, section 7.1.
Ed25519PrivateKey known_key() {
    return Ed25519PrivateKey(*from_hex<32>("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60"));
}

Registers ticket_of(const Ed25519PublicKey& key) {
    WireTicket ticket;
    ticket.job_id = {0xA, 1, 2, 3};
    ticket.file_sha256.bytes.fill(0x5A);
    ticket.file_size = 1000;
    ticket.file_name = "piece-1.qjob";
    ticket.cell_id = 7;
    ticket.key_id = key_id_of(key);
    return encode(ticket);
}

TEST(TicketSignature, TheKeyIdIsTheBeginningOfTheDigestOfThePublicKey) {
    const Ed25519PublicKey key = known_key().public_key();
    EXPECT_EQ(key_id_of(key), 0x21FE31DFU);  // printf "%s" PUBLIC | xxd -r -p | sha256sum
    EXPECT_EQ(to_hex(sha256(key.bytes)).substr(0, 8), "21fe31df");
    const Registers ticket = ticket_of(key);
    EXPECT_EQ(ticket[95], 0x21FE);
    EXPECT_EQ(ticket[96], 0x31DF);
}

TEST(TicketSignature, SignedAreTheHeadAnd196BytesInWireOrder) {
    Registers ticket(100);
    for (std::size_t i = 0; i < ticket.size(); ++i) ticket[i] = static_cast<std::uint16_t>(0x0100 * i + 7);
    const std::vector<std::uint8_t> bytes = signed_bytes(ticket);
    ASSERT_EQ(bytes.size(), 17U + 196U);
    EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 17), "QCHOPPER-TICKET-1");
    for (std::size_t i = 0; i < 98; ++i) {
        EXPECT_EQ(bytes[17 + 2 * i], ticket[i] >> 8U);
        EXPECT_EQ(bytes[18 + 2 * i], ticket[i] & 0xFFU);
    }
}

TEST(TicketSignature, EveryBitOfTheTicketButItsChecksumIsSigned) {
    const Ed25519PrivateKey key = known_key();
    Registers ticket = ticket_of(key.public_key());
    const Registers block = sign_ticket(key, ticket);
    ASSERT_EQ(block.size(), signature_block.count);
    const auto signature = decode<TicketSignature>(block);
    ASSERT_TRUE(signature.is_ok());
    EXPECT_TRUE(is_signed_by(key.public_key(), signed_bytes(ticket), signature.value.signature));
    for (std::size_t bit = 0; bit < 16 * ticket.size(); ++bit) {
        ticket[bit / 16] ^= static_cast<std::uint16_t>(1U << (bit % 16));
        const bool is_checksum = bit / 16 >= 98;
        EXPECT_EQ(is_signed_by(key.public_key(), signed_bytes(ticket), signature.value.signature), is_checksum) << bit;
        ticket[bit / 16] ^= static_cast<std::uint16_t>(1U << (bit % 16));
    }
}

TEST(TicketSignature, ZerosAreNoSignature) {
    EXPECT_EQ(decode<TicketSignature>(Registers(32, 0)).fault, BlockFault::empty);
    EXPECT_EQ(decode<TicketSignature>(Registers(31, 1)).fault, BlockFault::length);
}

}  // namespace
}  // namespace qchopper
