// Character by character; numbers by std::from_chars, which knows no locale.

#include "sim/program/program_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"

namespace qchopper {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_of_word(char c) {
    return is_digit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}

}  // namespace

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

LineRefused::LineRefused(const std::string& file_name, std::size_t line_number, const std::string& reason)
    : InputError(InputFault::mesh, "program " + file_name + ", line " + std::to_string(line_number) + ": " + reason,
                 "Make the job again; the program was not written by this version, or it was changed."),
      file(file_name),
      line(line_number),
      why(reason) {}

void refuse_line(const std::string& file, std::size_t line, const std::string& why) {
    throw LineRefused(file, line, why);
}

void ProgramLine::pass_space() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
}

std::string ProgramLine::word() {
    pass_space();
    if (!rest_.empty() && is_digit(rest_.front())) return {};
    const auto length = std::find_if_not(rest_.begin(), rest_.end(), is_of_word) - rest_.begin();
    std::string found = lower_case(rest_.substr(0, static_cast<std::size_t>(length)));
    rest_.remove_prefix(found.size());
    return found;
}

bool ProgramLine::takes_word(std::string_view wanted) {
    const std::string_view before = rest_;
    if (word() == wanted) return true;
    rest_ = before;
    return false;
}

char ProgramLine::letter() {
    pass_space();
    if (rest_.empty()) return 0;
    const char c =
        rest_.front() >= 'A' && rest_.front() <= 'Z' ? static_cast<char>(rest_.front() - 'A' + 'a') : rest_.front();
    if (c < 'a' || c > 'z') return 0;
    rest_.remove_prefix(1);
    return c;
}

bool ProgramLine::takes_text(std::string_view lower) {
    pass_space();
    if (rest_.size() < lower.size() || lower_case(rest_.substr(0, lower.size())) != lower) return false;
    rest_.remove_prefix(lower.size());
    return true;
}

std::string_view ProgramLine::until_quote() {
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) refuse("a quote is missing");
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
}

bool ProgramLine::takes(char c) {
    pass_space();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
}

void ProgramLine::need(char c) {
    if (!takes(c)) refuse(std::string("\"") + c + "\" is missing");
}

void ProgramLine::need_word(std::string_view wanted) {
    if (!takes_word(wanted)) refuse("\"" + std::string(wanted) + "\" is missing");
}

double ProgramLine::number(double least, double largest) {
    pass_space();
    std::size_t length = 0;
    std::size_t digits = 0;
    std::size_t points = 0;
    if (length < rest_.size() && rest_[length] == '-') ++length;
    for (; length < rest_.size() && (is_digit(rest_[length]) || rest_[length] == '.'); ++length) {
        rest_[length] == '.' ? ++points : ++digits;
    }
    if (digits == 0 || points > 1 || digits > 15) refuse("a number is missing or has no valid form");
    if (length < rest_.size() && is_of_word(rest_[length])) refuse("a number is followed by a letter");
    double value = 0;
    const auto result = std::from_chars(rest_.data(), rest_.data() + length, value, std::chars_format::fixed);
    if (result.ec != std::errc() || result.ptr != rest_.data() + length) refuse("a number has no valid form");
    rest_.remove_prefix(length);
    if (!(value >= least && value <= largest)) {
        refuse(significant(value, 10) + " is not between " + significant(least, 6) + " and " + significant(largest, 6));
    }
    return value;
}

std::uint32_t ProgramLine::integer(std::uint32_t least, std::uint32_t largest) {
    const double value = number(least, largest);
    if (value != std::floor(value)) refuse("a whole number is needed");
    return static_cast<std::uint32_t>(value);
}

std::uint32_t ProgramLine::index(std::uint32_t least, std::uint32_t largest) {
    need('[');
    const std::uint32_t value = integer(least, largest);
    need(']');
    return value;
}

void ProgramLine::need_end() {
    pass_space();
    if (!rest_.empty()) refuse("\"" + std::string(rest_.substr(0, 20)) + "\" is not expected here");
}

}  // namespace qchopper
