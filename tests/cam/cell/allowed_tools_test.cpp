#include "cam/cell/job_tools.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace qchopper {
namespace {

Cell ready(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml"));
}

std::string refusal(const Cell& cell, const std::vector<std::uint16_t>& numbers) {
    try {
        with_tools(cell, numbers);
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::use);
        return error.what();
    }
    return "taken";
}

TEST(AllowedTools, AreThoseThatAreNamedInTheOrderOfTheCell) {
    const Cell cell = ready("kr60-ha");
    EXPECT_EQ(with_tools(cell, {}), cell);
    const Cell some = with_tools(cell, {4, 3});
    ASSERT_EQ(some.machine->tools.size(), 2U);
    EXPECT_EQ(some.machine->tools[0], cell.machine->tools[2]);
    EXPECT_EQ(some.machine->tools[1], cell.machine->tools[3]);
    EXPECT_EQ(some.tool.number, 3) << "the tool that jobs without a program name";
    EXPECT_EQ(some.tool.diameter, 12);
    EXPECT_EQ(with_tools(cell, {1, 2, 3, 4, 5, 6, 7, 8}), cell);
}

TEST(AllowedTools, ThatCannotCarveAreRefused) {
    EXPECT_NE(refusal(ready("kr60-ha"), {1, 9}).find("no tool 9"), std::string::npos);
    EXPECT_NE(refusal(ready("kr60-ha"), {2, 5}).find("none is ball-ended"), std::string::npos);
    EXPECT_NE(refusal(ready("foam-1"), {1}).find("no machine"), std::string::npos);
    EXPECT_EQ(describe_tools({4}), "tool 4");
    EXPECT_EQ(describe_tools({1, 2, 4}), "tools 1, 2 and 4");
}

}  // namespace
}  // namespace qchopper
