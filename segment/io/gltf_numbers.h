// Numbers that lie in a buffer of a glTF file at even distances, in any of its component types.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace qchopper {

enum class GltfComponent { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// Nothing for a number that stands for none.
std::optional<GltfComponent> gltf_component(int code);
std::size_t size_of(GltfComponent component);

struct GltfNumbers {
    std::span<const std::uint8_t> bytes;  // from the first number to the end of the last
    std::size_t stride = 1;               // never 0
    GltfComponent component = GltfComponent::f32;

    // The number as it lies there, little-endian.
    std::uint32_t whole(std::size_t i, std::size_t component_of_it = 0) const;
    // Whole numbers stand for themselves or, normalized, for fractions of the largest (KHR_mesh_quantization).
    double real(std::size_t i, std::size_t component_of_it, bool is_normalized) const;
};

// What a buffer view says about its part of a buffer. Every number comes from the file.
struct GltfView {
    std::span<const std::uint8_t> buffer;
    std::size_t offset = 0;
    std::size_t length = 0;
    std::size_t stride = 0;  // 0: one element after the other
};

// `count` elements of `components` numbers each; nothing if not all of them lie in the view, or it not in the buffer.
std::optional<GltfNumbers> numbers_in(const GltfView& view, std::size_t offset, GltfComponent component,
                                      std::size_t components, std::size_t count);

}  // namespace qchopper
