// Reads numbers that lie at even distances in a buffer of a glTF file, in any component type of the format.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace qchopper {

// The values are the codes of the format.
enum class GltfComponent { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// Nothing for a number that is no such code.
std::optional<GltfComponent> gltf_component(int code);

// Elements of a fixed number of components. As numbers_in() returns them, every element lies in `bytes`.
struct GltfNumbers {
    std::span<const std::uint8_t> bytes;  // from the first element to the end of the view
    std::size_t stride = 1;               // bytes from one element to the next, never 0
    GltfComponent component = GltfComponent::f32;

    // Preconditions of both: `i` is below the count and `component_of_it` below the number of components that were
    // given to numbers_in().

    // The bytes of a number as an unsigned integer, little-endian.
    std::uint32_t whole(std::size_t i, std::size_t component_of_it = 0) const;
    // The value; normalized integers become fractions, 1 for the largest of the type (KHR_mesh_quantization).
    double real(std::size_t i, std::size_t component_of_it, bool is_normalized) const;
};

// A buffer view. All numbers come from the file unchecked; lengths are in bytes.
struct GltfView {
    std::span<const std::uint8_t> buffer;
    std::size_t offset = 0;
    std::size_t length = 0;
    std::size_t stride = 0;  // 0: one element follows the other
};

// `count` elements of `components` numbers each, from `offset` bytes into the view on. Nothing if an element lies
// outside the view, or the view outside the buffer.
std::optional<GltfNumbers> numbers_in(const GltfView& view, std::size_t offset, GltfComponent component,
                                      std::size_t components, std::size_t count);

}  // namespace qchopper
