// One pass over the bytes for the lines, one over the lines from both ends.

#include "sim/program/krl_parts.h"

#include <algorithm>

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 24;
constexpr std::size_t longest_line = 400;

std::vector<std::string_view> lines_of(const ProgramFile& file) {
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

bool is_name(std::string_view stem) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_of_name = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return !stem.empty() && stem.size() <= longest_name && is_letter(stem.front()) &&
           std::all_of(stem.begin(), stem.end(), is_of_name);
}

bool begins_with(std::string_view line, std::string_view lower) {
    return lower_case(line.substr(0, lower.size())) == lower;
}

// The line after the head.
std::size_t pass_head(const KrlFile& file) {
    std::size_t at = 0;
    const auto need = [&](std::string_view head) {
        if (at >= file.lines.size() || !begins_with(file.lines[at], head)) {
            refuse_line(*file.name, at + 1, "the head \"" + std::string(head) + "\" is missing");
        }
        ++at;
    };
    const bool has_head = !file.lines.empty() && file.lines[0].substr(0, 1) == "&";
    if (file.is_source || has_head) {
        need("&access rvp");
        need("&rel 1");
    }
    while (at < file.lines.size() && begins_with(file.lines[at], "&param ")) ++at;
    while (at < file.lines.size() && is_krl_comment(file.lines[at])) ++at;
    return at;
}

void find_body(KrlFile& file) {
    const std::size_t at = pass_head(file);
    if (at >= file.lines.size()) refuse_line(*file.name, at + 1, "DEF is missing");
    KrlLine line(file.lines[at], *file.name, at + 1);
    line.need_word(file.is_source ? "def" : "defdat");
    if (line.word() != file.stem) line.refuse("the name is not that of the file");
    if (file.is_source) line.need('('), line.need(')');
    if (!file.is_source) line.takes_word("public");
    line.need_end();
    file.first = at + 1;
    const std::string_view closing = file.is_source ? "end" : "enddat";
    file.end = file.lines.size() - 1;
    while (file.end > at && file.lines[file.end].empty()) --file.end;
    if (lower_case(file.lines[file.end]) != closing) {
        refuse_line(*file.name, file.lines.size(), "the file does not end with " + std::string(closing));
    }
}

}  // namespace

KrlFile read_krl_file(const ProgramFile& file) {
    const std::string lower = lower_case(file.name);
    KrlFile read{&file.name, lower.substr(0, lower.find('.')), lower.ends_with(".src"), {}, 0, 0};
    if (lower != read.stem + (read.is_source ? ".src" : ".dat") || !is_name(read.stem)) {
        refuse_line(file.name, 1, "this is no name of a KRL program");
    }
    read.lines = lines_of(file);
    find_body(read);
    return read;
}

}  // namespace qchopper
