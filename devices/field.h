// What describes the register map: fields, and the blocks that they make up.

#pragma once

#include <cstdint>
#include <span>

namespace qchopper {

enum class FieldType : std::uint8_t { u16, u32, u64, i32, text, bytes, words };

// One field of a block. `address` counts from the start of the whole map, `count` is in registers.
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
    std::uint16_t base;
    std::uint16_t count;
    bool whole;  // written by exactly one request that covers it, or not at all
    std::span<const Field> fields;
    const char* meaning;
    constexpr bool contains(std::uint32_t address, std::uint32_t words) const {
        return address >= base && address + words <= static_cast<std::uint32_t>(base) + count;
    }
};

}  // namespace qchopper
