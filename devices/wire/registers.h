// The register map of a cell, version 1.1: every block and every field, as tables.
//
// Addresses are 0-based, as in the PDU; the encoding is that of register_writer.h. Every block fits one request.
// docs/developer/formats/registers.md is printed from these tables (tests/devices/wire/registers_test.cpp).

#pragma once

#include <cstdint>
#include <span>

#include "devices/wire/codes.h"
#include "devices/wire/field.h"
#include "devices/wire/packml.h"

namespace qchopper {

constexpr std::uint16_t max_chunk_bytes = 232;
constexpr std::uint16_t chunk_head = 5;  // registers of CHUNK before the data

extern const Block status_block;
extern const Block result_block;
extern const Block identity_block;
extern const Block command_block;
extern const Block ticket_block;
extern const Block signature_block;
extern const Block chunk_block;  // written with 5 + ceil(LEN/2) registers
extern const Block heartbeat_block;
std::span<const Block* const> all_blocks();

// nullptr if the block has no field of that name.
const Field* field_named(const Block& block, const char* field_name);
// Precondition: the block has that field.
std::uint16_t address_of(const Block& block, const char* field_name);

}  // namespace qchopper
