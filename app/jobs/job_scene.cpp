// O(triangles) and O(lines of the program).

#include "app/jobs/job_scene.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "cam/job/job_caps.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/drill_orientation.h"
#include "segment/io/read_mesh.h"
#include "sim/replay/flush_check.h"
#include "sim/replay/read_program.h"
#include "sim/replay/scene.h"
#include "sim/replay/signal_walk.h"

namespace qchopper {
namespace {

std::string without_ending(const std::string& file) {
    return file.substr(0, file.rfind('.'));
}

// A point of its plane, and the normal out of the half-space.
std::pair<Vec3, Vec3> border_of(const HalfSpace& half_space, const Pose& pose) {
    const Plane& plane = half_space.plane;
    return {apply(pose, plane.offset * plane.normal), rotate(pose, -half_space.up())};
}

// The caps of the piece but its base in setup coordinates, and which face of the block each is said to be.
std::vector<SceneCap> caps_of(const ProofInput& input) {
    std::vector<SceneCap> caps;
    const Setup& setup = input.setup;
    for (const HalfSpace& half_space : input.half_spaces) {
        if (half_space.cut == setup.base) continue;
        const auto [point, outward] = border_of(half_space, setup.piece_in_setup);
        SceneCap cap{half_space.cut, point, outward, std::nullopt};
        for (const FlushCap& flush : setup.flush_caps) {
            if (flush.cut == half_space.cut) cap.face = static_cast<std::size_t>(flush.face);
        }
        caps.push_back(cap);
    }
    return caps;
}

// What is not milled: the plane of the base, and caps that are said to be faces of the block.
std::vector<bool> unmilled_of(const Setup& setup, const std::vector<SceneCap>& caps, const TriangleMesh& mesh) {
    std::vector<bool> is_unmilled(mesh.triangles.size(), false);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        is_unmilled[t] = setup.base && is_in_plane(mesh, t, {}, {0, 0, -1});
        for (const SceneCap& cap : caps) {
            if (cap.face && is_in_plane(mesh, t, cap.point, cap.outward)) is_unmilled[t] = true;
        }
    }
    return is_unmilled;
}

}  // namespace

TriangleMesh job_mesh(const Bytes& piece_stl, const std::string& source) {
    ReadOptions options;
    options.weld = true;
    return parse_mesh(piece_stl, source, {}, options).mesh;
}

JobContents::JobContents(const ReadJob& job, const std::string& source)
    : job_(job), mesh_(job_mesh(job.files.at("piece.stl"), source + ": piece.stl")) {
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        texts_[name] = {bytes.begin(), bytes.end()};
    }
}

ProofInput JobContents::input(const Cell& cell) const {
    const auto stock = job_.files.find("stock.bin");
    return {cell,
            job_.setup,
            job_.setup_in_cell,
            mesh_,
            *job_.program,
            texts_,
            stock != job_.files.end() ? &stock->second : nullptr,
            holes_of(job_.caps),
            job_.half_spaces};
}

ParsedProgram program_read_back(const ProofInput& input) {
    std::vector<ProgramFile> files;
    for (const std::string& name : input.program.files) files.push_back({name, input.texts.at(name)});
    return read_program(input.program.dialect, files, without_ending(input.program.entry), input.cell);
}

ReplayScene scene_of(const ProofInput& input) {
    ReplayScene scene;
    scene.cell = &input.cell;
    const Setup setup = with_drill_orientations(input.setup, input.program.drilling);
    const std::size_t own = input.setup.access.orientations.size();
    for (std::size_t d = 0; d < setup.access.orientations.size(); ++d) {
        const Vec3 tool_axis = normalized(setup.tool_axis(d));
        const Pose frame = d < own ? input.setup_in_cell[std::min(d, input.setup_in_cell.size() - 1)]
                                   : setup_in_cell(input.cell, setup.spoil, setup.placement, d);
        scene.orientations.push_back({tool_axis, setup.placement.table_angle(d), frame});
    }
    for (const JobChunk& chunk : input.program.chunks) {
        scene.chunks.push_back({without_ending(chunk.file), chunk.tool, chunk.orientation});
    }
    scene.block = setup.block_box();
    scene.spoil = setup.spoil;
    scene.target = &input.mesh;
    scene.caps = caps_of(input);
    scene.flush_tolerance = input.cell.saw.flush_tolerance;
    scene.is_unmilled = unmilled_of(setup, scene.caps, input.mesh);
    if (input.cell.machine) scene.scallop = input.cell.machine->program.scallop;
    const std::vector<std::size_t>& drilled = input.program.holes;
    for (const JobHole& hole : input.holes) {
        const bool is_due = std::binary_search(drilled.begin(), drilled.end(), hole.number);
        scene.holes.push_back({hole.number, hole.point, hole.axis, hole.diameter, hole.depth, hole.by_robot, is_due});
    }
    scene.is_last = input.program.part.number == input.program.part.count;
    scene.drilling = own;
    scene.tools = setup.tools;
    return scene;
}

std::optional<StockRecord> stock_before(const ProofInput& input) {
    if (!input.program.has_stock()) return std::nullopt;
    if (input.stock == nullptr)
        throw InputError(InputFault::mesh, "the stock in which the program begins is not known");
    return read_stock(*input.stock, "stock.bin");
}

}  // namespace qchopper
