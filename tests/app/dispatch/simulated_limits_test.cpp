// Tickets of jobs that fit a ready cell are within the limits of the simulated cell that is made of its file.

#include "app/dispatch/simulated_limits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cam/cell/job_tools.h"
#include "cam/job/ticket.h"
#include "cam/job/write_job.h"
#include "devices/wire/codec.h"
#include "segment/search/segmentation.h"
#include "sim/cell/ticket_check.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Cell ready(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml"));
}

// Of a cube whose job names these tools and stands in this block.
JobInput cube_job(const Cell& cell, const std::vector<std::uint16_t>& tools, Vec3 block) {
    JobInput input;
    input.piece = uncut(shapes::box({-50, -50, 0}, {50, 50, 100}), 0).pieces.front();
    input.piece_no = 1;
    input.piece_count = 1;
    input.cell = cell;
    input.setup.box = {{-50, -50, 0}, {50, 50, 100}};
    input.setup.block.size = block;
    input.program.emplace();
    input.program->tools = tools;
    return input;
}

std::string fault_of(const JobInput& input) {
    const JobTicket ticket{ticket_template(input), "A.qjob", 1000, {}};
    WireTicket order;
    order.cell_id = input.cell.id;
    order.made_for = 1;
    const auto fault = does_not_fit(wire_ticket(ticket, order), simulated_limits(input.cell));
    return fault ? std::string(name(fault->result)) + " at " + std::to_string(fault->detail) : "";
}

struct SimulatedLimits : ::testing::TestWithParam<const char*> {};

TEST_P(SimulatedLimits, EveryToolOfTheFileMayBeNamed) {
    const Cell cell = ready(GetParam());
    std::vector<std::uint16_t> numbers;
    for (const Tool& tool : tools_of(cell)) numbers.push_back(tool.number);
    ASSERT_EQ(numbers.size(), cell.machine ? cell.machine->tools.size() : 1U);
    const Vec3 block = cell.stock.front().size;
    for (const std::uint16_t number : numbers) EXPECT_EQ(fault_of(cube_job(cell, {number}, block)), "") << number;
    std::reverse(numbers.begin(), numbers.end());
    EXPECT_EQ(fault_of(cube_job(cell, numbers, block)), "") << "all of them, the last one first";
    numbers.push_back(999);
    EXPECT_EQ(fault_of(cube_job(cell, {999}, block)).substr(0, 4), "TOOL");
}

TEST_P(SimulatedLimits, EveryBlockMayStandAsItIsUsed) {
    const Cell cell = ready(GetParam());
    const std::vector<std::uint16_t> tools{cell.tool.number};
    for (const Stock& stock : cell.stock) {
        const Vec3 s = stock.size;
        EXPECT_EQ(fault_of(cube_job(cell, tools, s)), "") << stock.name;
        EXPECT_EQ(fault_of(cube_job(cell, tools, {s.y, s.x, s.z})), "") << stock.name;
        if (!stock.is_sawn) continue;
        EXPECT_EQ(fault_of(cube_job(cell, tools, {s.z, s.x, s.y})), "")
            << stock.name << ", sawn in another orientation";
        EXPECT_EQ(fault_of(cube_job(cell, tools, {s.x, s.z, s.y})), "")
            << stock.name << ", sawn in another orientation";
    }
    EXPECT_NE(fault_of(cube_job(cell, tools, {120, 120, 4000})), "");
}

INSTANTIATE_TEST_SUITE_P(Cells, SimulatedLimits,
                         ::testing::Values("foam-1", "kr60-ha", "kr120-r2500-pro-rotary", "irb6640-185-2.8",
                                           "gantry-3axis"));

}  // namespace
}  // namespace qchopper
