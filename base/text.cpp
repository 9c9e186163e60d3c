// Digits by std::to_chars, which no locale changes.

#include "base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <system_error>

namespace qchopper {

std::string fixed(double value, int decimals) {
    char text[400];  // the largest double has 309 digits
    const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
    if (result.ec != std::errc{}) return "?";
    std::string digits(text, result.ptr);
    if (digits.starts_with("-") && digits.find_first_not_of("-0.") == std::string::npos) digits.erase(0, 1);
    return digits;
}

std::string significant(double value, int digits) {
    char text[64];  // enough for 40 digits, sign, point and exponent
    const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return result.ec == std::errc{} ? std::string(text, result.ptr) : "?";
}

std::string with_commas(std::size_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
    return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return with_commas(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::string describe_volume(double mm3) {
    constexpr double a_litre = 1e6;
    const double size = std::abs(mm3);
    if (size >= 0.9995 * a_litre) return fixed(mm3 / a_litre, 3) + " l";
    const double ml = size / 1000;
    if (!(ml > 0)) return "0 ml";
    constexpr int max_decimals = 12;
    const int before_point = static_cast<int>(std::floor(std::log10(ml)));
    return fixed(mm3 / 1000, std::clamp(2 - before_point, 0, max_decimals)) + " ml";
}

std::string duration(std::uint32_t seconds) {
    if (seconds < 60) return std::to_string(seconds) + " s";
    const std::uint32_t minutes = seconds / 60 + (seconds % 60 >= 30 ? 1 : 0);
    if (minutes < 60) return std::to_string(minutes) + " min";
    const std::string rest = std::to_string(minutes % 60);
    return std::to_string(minutes / 60) + " h " + (rest.size() < 2 ? "0" : "") + rest + " min";
}

std::string utc_text(std::uint64_t unix_ms) {
    const auto seconds = static_cast<std::time_t>(unix_ms / 1000);
    std::tm parts{};
    ::gmtime_r(&seconds, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &parts);
    return text.data();
}

}  // namespace qchopper
