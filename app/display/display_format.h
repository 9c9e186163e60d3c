// What is sent to the browser: QCD1, a display mesh, and QCS1, a state per face of one.
// docs/developer/formats/display-mesh.md has the grammar.
//
// One form per value: what is read and written again is the same bytes (tests/app/display/display_format_test.cpp,
// tests/fuzz/fuzz_display.cpp). Both are sent packed by gzip (base/files/gzip.h). O(bytes); decoding takes memory of at
// most five times the bytes, whatever they are.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/display/display_mesh.h"
#include "base/files/file.h"

namespace qchopper {

// Precondition: is_valid(mesh), at most 2^32 - 1 index bytes.
Bytes encode_display_mesh(const DisplayMesh& mesh);
// is_valid() holds for the result. Throws InputError (mesh) for all that encode_display_mesh does not write.
DisplayMesh decode_display_mesh(std::span<const std::uint8_t> bytes);

// Of what encode_display_mesh or encode_display_states made: 32 hex digits, the first half of the SHA-256.
std::string display_id(std::span<const std::uint8_t> encoded);

struct DisplayStates {
    std::string mesh;                 // its id
    std::vector<std::uint8_t> faces;  // one per triangle of the mesh: surface_states() (app/pictures)
    bool operator==(const DisplayStates&) const = default;
};

// Preconditions: the id is one of display_id, states are at most base_state.
Bytes encode_display_states(const DisplayStates& states);
// Throws InputError (mesh) for all that encode_display_states does not write.
DisplayStates decode_display_states(std::span<const std::uint8_t> bytes);

}  // namespace qchopper
