// Compares boxes axis by axis.

#include "cam/setup/stock_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-6;  // mm

// Rounded up, so that a violation of a tenth is not "0 mm too high": from 10 on to whole mm, below to tenths.
std::string rounded_up(double mm) {
    const double shown = std::abs(mm) < 10 ? std::ceil(std::abs(mm) * 10) / 10 : std::ceil(std::abs(mm));
    return significant(shown, 15) + " mm";
}

std::string describe_size(Vec3 size) {
    const auto number = [](double mm) { return std::to_string(std::lround(mm)); };
    return number(size.x) + " x " + number(size.y) + " x " + number(size.z) + " mm";
}

void add_piece_margins(const Setup& setup, const Cell& cell, std::vector<Margin>& margins) {
    assert(setup.block.stock < cell.stock.size());
    const Vec3 piece = setup.box.size();
    const Vec3 block = setup.block.size;
    const std::string name = "block " + cell.stock[setup.block.stock].name + " (" + describe_size(block) + ")";
    const FlushFaces flush = setup.flush_faces();
    Vec3 room = block - size_with_foam(piece, margins_of(cell), flush);
    // Sizes of sawn blocks are to a step, nearest to the piece.
    const auto is_nearest = [&](double mm, bool is_flush) {
        return is_flush && std::abs(mm) <= 0.5 * flush_step + rounding;
    };
    if (is_nearest(room.x, flush[0] || flush[1])) room.x = 0;
    if (is_nearest(room.y, flush[2] || flush[3])) room.y = 0;
    if (is_nearest(room.z, flush[4])) room.z = 0;
    margins.push_back({"piece in block, length", "too long for " + name, room.x});
    margins.push_back({"piece in block, width", "too wide for " + name, room.y});
    margins.push_back({"piece in block, height", "too high for " + name, room.z});
}

// The tool travels around the block, its axis half a diameter outside.
void add_reach_margins(const Setup& setup, const Cell& cell, std::vector<Margin>& margins) {
    const Table& table = cell.table;
    const Box& workspace = cell.workspace;
    const double half_x = setup.block.size.x / 2 + cell.tool.diameter / 2;
    const double half_y = setup.block.size.y / 2 + cell.tool.diameter / 2;
    const std::string beyond = "of its block beyond the reach in ";
    margins.push_back({"block to reach, -x", beyond + "-x", table.centre_x - half_x - workspace.min.x});
    margins.push_back({"block to reach, +x", beyond + "+x", workspace.max.x - table.centre_x - half_x});
    margins.push_back({"block to reach, -y", beyond + "-y", table.centre_y - half_y - workspace.min.y});
    margins.push_back({"block to reach, +y", beyond + "+y", workspace.max.y - table.centre_y - half_y});
    margins.push_back({"block top to reach ceiling", "too high for the reach with block and clearance",
                       workspace.max.z - table.height - setup.block.size.z - cell.clearance});
    margins.push_back({"table to reach floor", "of its underside below the reach", table.height - workspace.min.z});
}

}  // namespace

bool StockFit::fits() const {
    return worst().mm >= -rounding;
}

const Margin& StockFit::worst() const {
    assert(!margins.empty());
    return *std::min_element(margins.begin(), margins.end(),
                             [](const Margin& a, const Margin& b) { return a.mm < b.mm; });
}

StockFit check_stock_fit(const Setup& setup, const Cell& cell) {
    StockFit report;
    add_piece_margins(setup, cell, report.margins);
    add_reach_margins(setup, cell, report.margins);
    report.margins.push_back(
        {"block on table, x", "of its block beyond the table in x", (cell.table.size_x - setup.block.size.x) / 2});
    report.margins.push_back(
        {"block on table, y", "of its block beyond the table in y", (cell.table.size_y - setup.block.size.y) / 2});
    return report;
}

Vec3 largest_block(const Cell& cell) {
    const Table& table = cell.table;
    const Box& workspace = cell.workspace;
    if (table.height < workspace.min.z) return {};
    const double half_x = std::min(table.centre_x - workspace.min.x, workspace.max.x - table.centre_x);
    const double half_y = std::min(table.centre_y - workspace.min.y, workspace.max.y - table.centre_y);
    return {std::min(table.size_x, 2 * half_x - cell.tool.diameter),
            std::min(table.size_y, 2 * half_y - cell.tool.diameter), workspace.max.z - table.height - cell.clearance};
}

std::string describe_stock_fit(const std::string& piece, const StockFit& report) {
    if (report.fits()) {
        return "piece " + piece + " fits, tightest: " + report.worst().name + " " +
               std::to_string(static_cast<long>(std::floor(std::max(0.0, report.worst().mm)))) + " mm";
    }
    std::string problems;
    for (const Margin& margin : report.margins) {
        if (margin.mm >= -rounding) continue;
        problems += (problems.empty() ? "" : ", ") + rounded_up(margin.mm) + " " + margin.problem;
    }
    return "piece " + piece + " does not fit: " + problems;
}

}  // namespace qchopper
