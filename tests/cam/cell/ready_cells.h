// Texts of ready cell files for tests that change a line, and what the reader says to them.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.h"
#include "cam/cell/cell.h"

namespace qchopper {

inline const std::filesystem::path cells = std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells";

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

inline const std::string& robot_cell() {
    static const std::string text = bytes_of(cells / "kr120-r2500-pro-rotary.toml");
    return text;
}

inline const std::string& gantry_cell() {
    static const std::string text = bytes_of(cells / "gantry-3axis.toml");
    return text;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

// The number, from 1, of the line in which a part of the text first begins.
inline int line_of(const std::string& text, const std::string& part) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// The one line in which the reader refuses a text, or "taken".
inline std::string refused(const std::string& text) {
    try {
        parse_cell(text, "cell.toml");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::config);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line: " << error.what();
        return error.what();
    }
    return "taken";
}

}  // namespace qchopper
