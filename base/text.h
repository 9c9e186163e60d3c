// Numbers as text for people, the same under every locale (tests/base/text_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace qchopper {

// With so many decimals, at most 80; never "-0".
std::string fixed(double value, int decimals);

// With at most so many significant digits, 1 to 40, without trailing zeros: "0.00125", "1.2e+09".
std::string significant(double value, int digits);

// "1 hole", "5,000 holes"; `many` is the plural where it is not `one` with an s.
std::string counted(std::size_t count, const std::string& one, const std::string& many = {});

// 1234567 -> "1,234,567"
std::string with_commas(std::size_t number);

// "1.234 l"; below a litre in ml with three significant digits: "320 ml", "0.0123 ml".
std::string describe_volume(double mm3);

// "45 s"; from a minute on rounded to minutes: "12 min", "3 h 05 min".
std::string duration(std::uint32_t seconds);

// "2026-11-22 17:43:28", in UTC.
std::string utc_text(std::uint64_t unix_ms);

}  // namespace qchopper
