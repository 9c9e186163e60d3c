// Quoting by the rules of POSIX: nothing is special in single quotes, and a single quote is written outside of them.

#include "base/shell_word.h"

#include <algorithm>
#include <string_view>

namespace qchopper {
namespace {

bool is_plain(char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return is_letter || std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
}

}  // namespace

std::string shell_word(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::string text = name.starts_with('-') ? "./" + name : name;  // else it would be read as an option
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace qchopper
