// Reads one table of a settings file in TOML key by key; every error names file, line and key.
//
// Unknown keys are refused when their table is opened (tests/cam/cell/cell_test.cpp). A reader may be copied and
// outlive the reader that it came from.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// All keys that a table may have; at least one.
using Keys = std::span<const std::string_view>;

class TomlReader {
 public:
    // The outermost table. Throws InputError (config) if the text is not TOML or has an unknown key; `file` is for
    // messages.
    static TomlReader parse(std::string_view text, const std::string& file, Keys known);
    // The same with any keys, for a file of which one key tells which others it may have; then call with_keys().
    static TomlReader parse(std::string_view text, const std::string& file);
    // This table. Throws InputError (config) if it has an unknown key.
    TomlReader with_keys(Keys known) const;

    bool has(std::string_view key) const;
    // Each throws InputError (config) if the key is missing, of another type, or out of bounds.
    // One line, not empty, of at most `longest` bytes.
    std::string text(std::string_view key, std::size_t longest = 60) const;
    bool boolean(std::string_view key) const;
    double number(std::string_view key, double least, double most) const;
    // `value` stays as it is where the key is missing.
    void number_if_given(std::string_view key, double least, double most, double& value) const;
    std::uint32_t whole(std::string_view key, std::uint32_t least, std::uint32_t most) const;
    std::vector<double> numbers(std::string_view key, std::size_t count, double least, double most) const;
    // Lists of any length, also empty.
    std::vector<double> numbers(std::string_view key, double least, double most) const;
    std::vector<std::string> texts(std::string_view key) const;
    // A list of any length of lists of two numbers.
    std::vector<std::array<double, 2>> pairs(std::string_view key, double least, double most) const;
    Vec3 vector(std::string_view key, double least, double most) const;
    TomlReader table(std::string_view key, Keys known) const;
    // The same, or a table without keys where there is none.
    TomlReader table_if_given(std::string_view key, Keys known) const;
    std::vector<TomlReader> tables(std::string_view key, Keys known) const;

    // Throws InputError (config): "FILE:LINE: KEY: why".
    [[noreturn]] void refuse(std::string_view key, const std::string& why, const std::string& to_do = {}) const;

 private:
    struct Table;  // hides the TOML library; owns the whole file
    TomlReader(std::shared_ptr<const Table> table, std::string file, std::string prefix);
    std::string full(std::string_view key) const { return prefix_ + std::string(key); }

    std::shared_ptr<const Table> table_;
    std::string file_;
    std::string prefix_;
};

}  // namespace qchopper
