// One pass over the text; UTF-8 is checked as RFC 3629 defines it. O(characters).

#include "segment/picture/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace qchopper {
namespace {

// The length of the UTF-8 character at `i`; 0 if there is none or XML does not allow it.
std::size_t character_length(const std::string& text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    const unsigned first = byte(i);
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    std::uint32_t code = first & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(i + k) & 0xC0U) != 0x80) return 0;
        code = (code << 6U) | (byte(i + k) & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool is_control = code < 0xA0;
    const bool is_no_character = (code & 0xFFFEU) == 0xFFFE;
    return code < least[length] || code > 0x10FFFF || is_surrogate || is_control || is_no_character ? 0 : length;
}

}  // namespace

std::string svg_number(double value, int decimals) {
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    std::string result(text.data(), end.ptr);
    if (result.find_first_not_of("-0.") == std::string::npos && result.front() == '-') result.erase(0, 1);  // -0
    return result;
}

std::string svg_colour(Rgb colour) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t c : {colour.r, colour.g, colour.b}) {
        text += digits[c / 16];
        text += digits[c % 16];
    }
    return text;
}

std::string svg_text(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        if (length == 0)
            result += '?';
        else if (text[i] == '&')
            result += "&amp;";
        else if (text[i] == '<')
            result += "&lt;";
        else if (text[i] == '>')
            result += "&gt;";
        else if (text[i] == '"')
            result += "&quot;";
        else
            result += text.substr(i, length);
        i += std::max<std::size_t>(length, 1);
    }
    return result;
}

}  // namespace qchopper
