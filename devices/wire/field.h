// The description of the register map: fields, and the blocks that consist of them.
//
// Addresses and counts are in 16-bit registers; addresses are 0-based. The fields of a block follow each other without
// gap or overlap (tests/devices/wire/registers_test.cpp).

#pragma once

#include <cstdint>
#include <span>

namespace qchopper {

enum class FieldType : std::uint8_t { u16, u32, u64, i32, text, bytes, words };

// One field of a block. `address` is that in the map, not the offset in the block.
struct Field {
    std::uint16_t address;
    std::uint16_t count;
    FieldType type;
    const char* name;
    const char* meaning;
};

enum class Side : std::uint8_t { input, holding };  // input: the cell publishes; holding: the PC writes

struct Block {
    const char* name;
    Side side;
    std::uint16_t base;   // address of the first register
    std::uint16_t count;  // registers
    bool whole;           // written by exactly one request that covers it, or not at all
    std::span<const Field> fields;
    const char* meaning;
    constexpr bool contains(std::uint32_t address, std::uint32_t registers) const {
        return address >= base && address + registers <= static_cast<std::uint32_t>(base) + count;
    }
};

}  // namespace qchopper
