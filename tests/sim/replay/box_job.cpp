#include "tests/sim/replay/box_job.h"

#include "sim/program/krl_reader.h"
#include "sim/replay/signal_walk.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr double spoil = 10;
constexpr double above = 50;  // retract height
constexpr double link = 300;
constexpr double approach = 20;
const Vec3 low{-40, -25, 0};  // of the piece, which stands aside in its block
const Vec3 high{30, 18, 22};
constexpr double tall = 22;
constexpr double flute = 14;  // less than from the top of the block to the first level beside the piece

// Down to a point from above, cuts through the others, and up again.
void add_run(WrittenChunk& chunk, const std::vector<Vec3>& points) {
    const Vec3 first = points.front();
    chunk.moves.push_back({{first.x, first.y, above}, link, false});
    chunk.moves.push_back({first, approach, false});
    for (std::size_t i = 1; i < points.size(); ++i) chunk.moves.push_back({points[i], 100, i + 1 < points.size()});
    const Vec3 last = points.back();
    chunk.moves.push_back({{last.x, last.y, above}, link, false});
}

WrittenChunk top_chunk() {
    WrittenChunk chunk{2, 0, 15000, {}};
    std::vector<Vec3> points;
    for (int row = 0; row <= 4; ++row) {
        const double y = -33 + 16 * row;
        const double x = row % 2 == 0 ? -60 : 60;
        points.push_back({x, y, tall});
        points.push_back({-x, y, tall});
    }
    add_run(chunk, points);
    return chunk;
}

WrittenChunk side_chunk() {
    WrittenChunk chunk{2, 0, 15000, {}};
    const Vec3 from = low - Vec3{10, 10, 0};
    const Vec3 to = high + Vec3{10, 10, 0};
    for (const double z : {10.0, 0.0, -2.0}) {
        // Every other level begins at the opposite corner.
        const bool is_other = z == 0;
        const Vec3 a = is_other ? to : from;
        const Vec3 b = is_other ? from : to;
        add_run(chunk, {{a.x, a.y, z}, {b.x, a.y, z}, {b.x, b.y, z}, {a.x, b.y, z}, {a.x, a.y, z}, {0, a.y, z}});
    }
    return chunk;
}

}  // namespace

ReplayScene BoxJob::scene() const {
    return {&cell,
            job.orientations,
            job.orientations.size(),
            chunks_of(job),
            block,
            spoil,
            &target,
            is_unmilled,
            caps,
            0.1,
            0.25,
            cell.machine->rotary_table ? job.orientations[0].table_angle : 0};
}

BoxJob box_job(const std::string& cell_name) {
    BoxJob made{read_cell(std::string(QCHOPPER_SOURCE_DIR) + "/cells/" + cell_name + ".toml"),
                shapes::box(low, high, 8),
                {},
                {},
                {{-55, -40, -spoil}, {55, 40, tall + 5}},
                {}};
    for (std::size_t t = 0; t < made.target.triangles.size(); ++t) {
        made.is_unmilled.push_back(area_vector(made.target, t).z < 0);
    }
    made.cell.machine->tools[1].flute_length = flute;
    const double angle = made.cell.machine->rotary_table ? 0.5 : 0;
    made.job.orientations.push_back({{0, 0, 1}, angle, on_table(made.cell, spoil, angle)});
    made.job.chunks = {top_chunk(), side_chunk()};
    return made;
}

BoxJob sawn_box_job(const std::string& cell_name) {
    BoxJob made = box_job(cell_name);
    made.block.max.x = high.x;
    made.caps = {{1, high, {1, 0, 0}, 1}, {2, low, {-1, 0, 0}, std::nullopt}};
    for (std::size_t t = 0; t < made.target.triangles.size(); ++t) {
        if (area_vector(made.target, t).x > 0) made.is_unmilled[t] = true;
    }
    return made;
}

ParsedProgram read_back(const BoxJob& job, const std::vector<ProgramFile>& files) {
    return read_krl(files, "qc_1", called_programs(job.cell));
}

}  // namespace qchopper
