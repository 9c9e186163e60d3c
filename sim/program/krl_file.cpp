// One pass over the bytes for the lines, one over the lines from both ends.

#include "sim/program/krl_parts.h"
#include "sim/program/program_file.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 24;

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
    ProgramLine line(file.lines[at], *file.name, at + 1);
    line.need_word(file.is_source ? "def" : "defdat");
    if (line.word() != file.stem) line.refuse("the name is not that of the file");
    if (file.is_source) line.need('('), line.need(')');
    if (!file.is_source) file.is_public = line.takes_word("public");
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

bool is_krl_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(' ');
    return first == std::string_view::npos || line[first] == ';';
}

KrlFile read_krl_file(const ProgramFile& file) {
    const std::string lower = lower_case(file.name);
    KrlFile read{&file.name, lower.substr(0, lower.find('.')), lower.ends_with(".src"), false, {}, 0, 0};
    if (lower != read.stem + (read.is_source ? ".src" : ".dat") || !is_program_name(read.stem, longest_name)) {
        refuse_line(file.name, 1, "this is no name of a KRL program");
    }
    read.lines = program_lines_of(file);
    find_body(read);
    return read;
}

}  // namespace qchopper
