// Decodes UTF-8 by the table of well-formed sequences (The Unicode Standard 15.0, table 3-7). Quotes by the rules of
// POSIX: nothing is special in single quotes, and a single quote is written outside of them.

#include "base/printable.h"

#include <algorithm>

namespace qchopper {
namespace {

bool acts_on_a_terminal(std::uint32_t code) {
    const auto within = [code](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
    return code < 0x20 || within(0x7F, 0x9F) || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
           within(0x2066, 0x2069);
}

bool is_plain(char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return is_letter || std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
}

}  // namespace

Utf8Character first_character(std::string_view text) {
    const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t lead = at(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (bytes == 0 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((at(i) & 0xC0U) != 0x80) return {};
        code = code << 6U | (at(i) & 0x3FU);
    }
    const bool is_overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    return is_overlong || is_surrogate || code > 0x10FFFF ? Utf8Character{} : Utf8Character{code, bytes};
}

std::string printable(std::string_view text) {
    constexpr const char* digits = "0123456789abcdef";
    std::string shown;
    while (!text.empty()) {
        const Utf8Character next = first_character(text);
        const std::size_t bytes = next.bytes == 0 ? 1 : next.bytes;
        if (next.bytes != 0 && !acts_on_a_terminal(next.code)) {
            shown += text.substr(0, bytes);
        } else {
            for (const char c : text.substr(0, bytes)) {
                const auto byte = static_cast<std::uint8_t>(c);
                shown += {'\\', 'x', digits[byte >> 4U], digits[byte & 0xFU]};
            }
        }
        text.remove_prefix(bytes);
    }
    return shown;
}

std::string printable_lines(std::string_view text) {
    std::string shown;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        shown += printable(text.substr(0, end)) + "\n";
        text.remove_prefix(end + 1);
    }
    return shown + printable(text);
}

std::string shell_word(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::string text = name.starts_with('-') ? "./" + name : name;  // else it would be read as an option
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace qchopper
