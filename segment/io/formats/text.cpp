// A pointer moves over the text; numbers are read by std::from_chars. O(characters), nothing is copied.

#include "segment/io/formats/text.h"

#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

namespace qchopper {
namespace {

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

std::string_view without_plus(std::string_view word) {
    const bool has_one_sign = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    return has_one_sign ? word.substr(1) : word;
}

}  // namespace

// Passes one character and counts the line that it ends; CR LF counts at the LF.
void Text::pass_one() {
    if (*at_ == '\n' || (*at_ == '\r' && (at_ + 1 == end_ || at_[1] != '\n'))) ++line_;
    ++at_;
}

std::string_view Text::word() {
    while (at_ != end_ && is_space(*at_)) pass_one();
    const char* const begin = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view Text::rest_of_line() {
    const char* const begin = at_;
    while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
    const std::string_view rest(begin, static_cast<std::size_t>(at_ - begin));
    if (at_ != end_ && *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') pass_one();
    if (at_ != end_) pass_one();
    return rest;
}

std::optional<double> number(std::string_view word) {
    word = without_plus(word);
    double value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (stop != word.data() + word.size() || word.empty()) return {};
    if (fault == std::errc::result_out_of_range) {
        // from_chars leaves the value unset here; strtod returns 0 or infinity. It reads a decimal point, because the
        // program never changes the locale
        return std::strtod(std::string(word).c_str(), nullptr);
    }
    if (fault != std::errc()) return {};
    return value;
}

std::optional<std::int64_t> integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || stop != word.data() + word.size()) return {};
    return value;
}

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
    if (word.size() != lower.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
        if (c != lower[i]) return false;
    }
    return true;
}

}  // namespace qchopper
