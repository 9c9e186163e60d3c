// One copy of the text. O(bytes).

#include "segment/io/to_utf8.h"

namespace qchopper {

std::optional<Bytes> to_utf8(const Bytes& bytes) {
    if (bytes.size() >= 3 && bytes[0] == 0xef && bytes[1] == 0xbb && bytes[2] == 0xbf) {
        return Bytes(bytes.begin() + 3, bytes.end());
    }
    const bool is_big = bytes.size() >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff;
    const bool is_little = bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe;
    if (!is_big && !is_little) return {};
    Bytes text;
    text.reserve(bytes.size() / 2);
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
        const std::uint8_t low = bytes[is_big ? i + 1 : i];
        const std::uint8_t high = bytes[is_big ? i : i + 1];
        text.push_back(high == 0 && low < 128 ? low : '?');
    }
    if (bytes.size() % 2 == 1) text.push_back('?');  // half a character: the file was cut short
    return text;
}

}  // namespace qchopper
