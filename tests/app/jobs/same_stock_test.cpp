// One toolpath, posted in each language for a cell of its own, leaves the same stock: two tools from above, and a hole
// that is drilled in pecks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "cam/post/post.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/read_program.h"
#include "sim/replay/stock/stock_model.h"
#include "sim/replay/walk/machine_walk.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using namespace test_programs;

constexpr double cell_mm = 0.5;
constexpr std::size_t drill = 4;  // index of the drill of 8 mm in the ready cells
const Vec3 size{250, 200, 150};

Operation drilled(const Job& job) {
    Operation made = operation(job, 0, drill, 15);
    made.kind = OperationKind::drilling;
    made.rounding = 0;
    const Vec3 mouth{80, 70, job.setup.block.size.z - job.setup.spoil};
    PathRun run{{mouth.x, mouth.y, made.retract}, {}, 1};
    for (const double depth : {8.0, 16.0, 22.0}) {
        run.moves.push_back({mouth - Vec3{0, 0, depth}, MoveKind::cut});
        run.moves.push_back({mouth + Vec3{0, 0, 2}, MoveKind::retract});
    }
    run.moves.push_back({run.start, MoveKind::retract});
    made.runs = {run};
    return made;
}

// A ready cell, or that with a rotary table as if its controller were ABB's.
Cell cell_of(const std::string& name) {
    if (name != "a rotary table in RAPID") return ready_cell(name + ".toml");
    Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    CellMachine& machine = *cell.machine;
    machine.program.dialect = Dialect::rapid;
    for (auto* signal : {&machine.spindle.on, &machine.spindle.speed, &machine.spindle.at_speed, &machine.spindle.off,
                         &machine.extraction->on, &machine.extraction->off}) {
        if (*signal) (*signal)->target = "signal_" + (*signal)->target;
    }
    return cell;
}

Job job_of(const std::string& cell) {
    Job job = job_in(cell_of(cell), size, 0, 0);
    job.toolpath.operations.pop_back();
    job.toolpath.operations.push_back(drilled(job));
    return job;
}

ReplayScene scene_of(const Job& job, const ProgramPart& part) {
    ReplayScene scene;
    scene.cell = &job.cell;
    const BlockPlacement& place = job.setup.placement;
    const bool turns = job.cell.machine->rotary_table.has_value();
    scene.orientations.push_back(
        {{0, 0, 1}, turns ? place.table_angle(0) : 0, setup_in_cell(job.cell, job.setup.spoil, place, 0)});
    for (const PostedChunk& chunk : part.chunks) {
        scene.chunks.push_back({chunk.name.substr(0, chunk.name.find('.')), chunk.tool_number, 0});
    }
    scene.block = job.setup.block_box();
    scene.spoil = job.setup.spoil;
    return scene;
}

struct Carved {
    StockRecord stock;
    double removed_mm3 = 0;
};

// With corners rounded as far as the controller may.
Carved carved(const std::string& cell) {
    const Job job = job_of(cell);
    const std::vector<ProgramPart> parts = post_program(program_of(job), job.cell, {7});
    EXPECT_EQ(parts.size(), 1U);
    std::vector<ProgramFile> files;
    for (const ProgramText& file : parts[0].files) files.push_back({file.name, file.text});
    const ParsedProgram program = read_program(job.cell.machine->program.dialect, files, "qc_7", job.cell);
    const ReplayScene scene = scene_of(job, parts[0]);
    FindingLog log;
    const ToolPath path = walk_machine(program, scene, log, {});
    for (const Finding& finding : log.findings()) {
        const bool is_of_frames = finding.kind == FindingKind::base_frame || finding.kind == FindingKind::tool_frame ||
                                  finding.kind == FindingKind::unknown_signal || finding.kind == FindingKind::not_home;
        EXPECT_FALSE(is_of_frames) << cell << ": " << finding.text;
    }
    EXPECT_EQ(std::ranges::count(path.lines, 1U, &TipLine::hole), 8);
    StockModel stock(scene.block, {{0, 0, 1}}, cell_mm);
    const MillingFigures figures = mill_stock(stock, path, scene, true, log, {});
    return {stock.record(), figures.removed_mm3};
}

// Cells whose heights differ by more than one cell, and all that were cut.
std::pair<std::size_t, std::size_t> differing(const StockRecord& a, const StockRecord& b) {
    std::size_t different = 0;
    std::size_t all = 0;
    EXPECT_EQ(a.maps[0].tiles.size(), b.maps[0].tiles.size());
    for (std::size_t t = 0; t < std::min(a.maps[0].tiles.size(), b.maps[0].tiles.size()); ++t) {
        const StockTile& one = a.maps[0].tiles[t];
        const StockTile& other = b.maps[0].tiles[t];
        EXPECT_EQ(one.tx, other.tx);
        EXPECT_EQ(one.ty, other.ty);
        for (std::size_t i = 0; i < one.height.size(); ++i) {
            if (one.height[i] == StockTile::not_cut && other.height[i] == StockTile::not_cut) continue;
            ++all;
            const bool is_one = (one.height[i] == StockTile::not_cut) != (other.height[i] == StockTile::not_cut);
            if (is_one || std::abs(one.height[i] - other.height[i]) > 100 * cell_mm) ++different;
        }
    }
    return {different, all};
}

TEST(SameStock, InEveryLanguage) {
    const Carved krl = carved("kr60-ha");
    for (const char* cell : {"irb6640-185-2.8", "gantry-3axis", "a rotary table in RAPID"}) {
        const Carved other = carved(cell);
        const auto [different, all] = differing(krl.stock, other.stock);
        EXPECT_GT(all, 50'000U);
        // On a wall a hundredth of a millimetre decides whether the centre of a cell is cut.
        EXPECT_LE(different, all / 1000) << cell;
        EXPECT_NEAR(other.removed_mm3, krl.removed_mm3, 1e-3 * krl.removed_mm3) << cell;
        std::printf("%s: %zu of %zu cells differ by more than %.2f mm\n", cell, different, all, cell_mm);
    }
}

}  // namespace
}  // namespace qchopper
