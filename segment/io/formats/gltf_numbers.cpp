// Assembles each number from its bytes, so that the host's byte order and alignment do not matter. O(1) per number.

#include "segment/io/formats/gltf_numbers.h"

#include <algorithm>
#include <bit>

namespace qchopper {
namespace {

// Bytes of one number.
std::size_t size_of(GltfComponent component) {
    if (component == GltfComponent::i8 || component == GltfComponent::u8) return 1;
    return component == GltfComponent::i16 || component == GltfComponent::u16 ? 2 : 4;
}

}  // namespace

std::optional<GltfComponent> gltf_component(int code) {
    if (code < 5120 || code > 5126 || code == 5124) return {};
    return static_cast<GltfComponent>(code);
}

std::uint32_t GltfNumbers::whole(std::size_t i, std::size_t component_of_it) const {
    const std::size_t size = size_of(component);
    const std::uint8_t* const at = bytes.data() + i * stride + component_of_it * size;
    std::uint32_t value = 0;
    for (std::size_t b = size; b-- > 0;) value = value << 8 | at[b];
    return value;
}

double GltfNumbers::real(std::size_t i, std::size_t component_of_it, bool is_normalized) const {
    const std::uint32_t raw = whole(i, component_of_it);
    const auto scaled = [&](double value, double most) { return is_normalized ? std::max(value / most, -1.0) : value; };
    switch (component) {
        case GltfComponent::i8:
            return scaled(static_cast<std::int8_t>(raw), 127);
        case GltfComponent::u8:
            return scaled(raw, 255);
        case GltfComponent::i16:
            return scaled(static_cast<std::int16_t>(raw), 32767);
        case GltfComponent::u16:
            return scaled(raw, 65535);
        case GltfComponent::u32:
            return raw;
        case GltfComponent::f32:
            break;
    }
    return std::bit_cast<float>(raw);
}

// No product of numbers from the file is formed before they are bounded: it could overflow.
std::optional<GltfNumbers> numbers_in(const GltfView& view, std::size_t offset, GltfComponent component,
                                      std::size_t components, std::size_t count) {
    const std::size_t size = components * size_of(component);
    const std::size_t stride = view.stride == 0 ? size : view.stride;
    if (view.offset > view.buffer.size() || view.length > view.buffer.size() - view.offset) return {};
    if (offset > view.length) return {};
    const std::size_t space = view.length - offset;
    if (count > 0 && (space < size || (space - size) / stride < count - 1)) return {};
    return GltfNumbers{view.buffer.subspan(view.offset + offset, space), stride, component};
}

}  // namespace qchopper
