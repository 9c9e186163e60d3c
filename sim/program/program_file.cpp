// One pass over the bytes.

#include "sim/program/program_file.h"

#include <algorithm>

#include "sim/program/program_line.h"

namespace qchopper {

std::vector<std::string_view> program_lines_of(const ProgramFile& file) {
    constexpr std::size_t longest_line = 400;
    std::vector<std::string_view> lines;
    std::string_view rest = file.text;
    while (!rest.empty()) {
        const std::size_t number = lines.size() + 1;
        const std::size_t length = rest.find('\n');
        if (length == std::string_view::npos || length == 0 || rest[length - 1] != '\r') {
            refuse_line(file.name, number, "the line does not end with CR LF");
        }
        const std::string_view line = rest.substr(0, length - 1);
        const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
        if (!std::all_of(line.begin(), line.end(), is_plain)) {
            refuse_line(file.name, number, "a character is not printable ASCII");
        }
        if (line.size() > longest_line) refuse_line(file.name, number, "the line is too long");
        lines.push_back(line);
        rest.remove_prefix(length + 1);
    }
    return lines;
}

bool is_program_name(std::string_view stem, std::size_t longest) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_of_name = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return !stem.empty() && stem.size() <= longest && is_letter(stem.front()) &&
           std::all_of(stem.begin(), stem.end(), is_of_name);
}

}  // namespace qchopper
