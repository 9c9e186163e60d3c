// One pass over the text. O(characters).

#include "segment/picture/svg.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/hex.h"
#include "base/printable.h"

namespace qchopper {
namespace {

// The length of the UTF-8 character at `i`; 0 if there is none or XML does not allow it.
std::size_t character_length(const std::string& text, std::size_t i) {
    const Utf8Character next = first_character(std::string_view(text).substr(i));
    const bool is_control = next.code < 0x20 || (next.code >= 0x7F && next.code < 0xA0);
    const bool is_no_character = (next.code & 0xFFFEU) == 0xFFFE;
    return is_control || is_no_character ? 0 : next.bytes;
}

}  // namespace

std::string svg_colour(Rgb colour) {
    return "#" + to_hex(std::array{colour.r, colour.g, colour.b});
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
