#include "cam/cell/job_tools.h"

#include <gtest/gtest.h>

#include <tuple>

#include "base/error.h"
#include "tests/cam/cell/short_tools.h"

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
    EXPECT_EQ(with_tools(cell, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), cell);
}

TEST(AllowedTools, ThatCannotCarveAreRefused) {
    EXPECT_NE(refusal(ready("kr60-ha"), {1, 99}).find("no tool 99"), std::string::npos);
    EXPECT_NE(refusal(ready("kr60-ha"), {2, 5}).find("none is ball-ended"), std::string::npos);
    EXPECT_NE(refusal(ready("foam-1"), {1}).find("no machine"), std::string::npos);
    EXPECT_EQ(describe_tools({4}), "tool 4");
    EXPECT_EQ(describe_tools({1, 2, 4}), "tools 1, 2 and 4");
}

TEST(ToolSets, AreOneWhereNoKindHasSeveralStickOuts) {
    EXPECT_EQ(tool_sets(ready("gantry-3axis").machine->tools), (std::vector<std::vector<std::uint16_t>>{{}}));
    std::vector<CuttingTool> twins(2);
    EXPECT_EQ(tool_sets(twins).size(), 1U) << "of equal tools there is no longer one";
}

TEST(ToolSets, OfReadyCellsAreShortAndLongOnes) {
    EXPECT_EQ(tool_sets(ready("kr60-ha").machine->tools),
              (std::vector<std::vector<std::uint16_t>>{{1, 2, 3, 4, 5, 6, 7, 8}, {2, 3, 4, 5, 6, 7, 9, 10}}));
}

TEST(ToolSets, HaveOneStickOutOfEveryKind) {
    Cell cell = with_short_tools(ready("kr60-ha"));
    std::vector<CuttingTool>& tools = cell.machine->tools;
    for (const auto& [of, number, stick_out] :
         {std::tuple(0, 9, 300.0), std::tuple(0, 10, 200.0), std::tuple(7, 11, 300.0)}) {
        CuttingTool longer = tools[static_cast<std::size_t>(of)];
        longer.number = static_cast<std::uint16_t>(number);
        longer.stick_out = stick_out;
        tools.push_back(longer);
    }
    EXPECT_EQ(tool_sets(tools), (std::vector<std::vector<std::uint16_t>>{
                                    {1, 2, 3, 4, 5, 6, 7, 8}, {2, 3, 4, 5, 6, 7, 10, 11}, {2, 3, 4, 5, 6, 7, 9, 11}}));
}

}  // namespace
}  // namespace qchopper
