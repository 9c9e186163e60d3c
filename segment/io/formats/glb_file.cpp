// The header and the first chunk of a GLB as the glTF 2.0 specification (Khronos Group, 2021) defines them. with_json
// copies the file once.

#include "segment/io/formats/glb_file.h"

#include <cstdint>

#include "base/error.h"

namespace qchopper {
namespace {

std::uint32_t u32_at(const Bytes& bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

}  // namespace

bool is_glb(const Bytes& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

JsonChunk find_json(const Bytes& bytes, const std::string& name) {
    if (!is_glb(bytes)) return {0, bytes.size(), bytes.size(), false};
    constexpr std::size_t header = 20;               // bytes, of the file and of its first chunk
    constexpr std::uint32_t json_type = 0x4e4f534a;  // "JSON"
    const auto refuse = [&](const std::string& why) {
        throw InputError(InputFault::mesh, name + " is not a valid GLB file: " + why, "export or copy the file again");
    };
    if (bytes.size() < header) refuse("it ends within its header");
    if (u32_at(bytes, 4) != 2) refuse("only version 2 is read");
    const std::uint32_t length = u32_at(bytes, 8);
    if (length > bytes.size() || length < header) {
        refuse("it should have " + std::to_string(length) + " bytes, but has " + std::to_string(bytes.size()));
    }
    const std::size_t json_size = u32_at(bytes, 12);
    if (u32_at(bytes, 16) != json_type || json_size > length - header) refuse("its first chunk is not complete JSON");
    return {header, header + json_size, length, true};
}

Bytes with_json(const Bytes& bytes, const JsonChunk& old, std::string json) {
    while (json.size() % 4 != 0) json += ' ';
    Bytes made(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(old.begin));
    made.insert(made.end(), json.begin(), json.end());
    made.insert(made.end(), bytes.begin() + static_cast<std::ptrdiff_t>(old.end),
                bytes.begin() + static_cast<std::ptrdiff_t>(old.end_of_file));
    const auto put = [&](std::size_t at, std::size_t value) {
        for (std::size_t i = 0; i < 4; ++i) made[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
    };
    put(8, made.size());
    put(12, json.size());
    return made;
}

}  // namespace qchopper
