// Measures what the programs of a piece and their proof cost beside what they would cost at least: the plain loop over
// the cells under the moves (plain_loop.h), the inverse kinematics of the points, and reading the text. The figures of
// a table are of one run, so that their ratios hold on any machine.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "app/jobs/piece_program.h"
#include "base/error.h"
#include "base/timings.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/job_piece.h"
#include "bench/plain_loop.h"
#include "cam/cell/job_tools.h"
#include "cam/job/job_caps.h"
#include "cam/job/read_job.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/drill_orientation.h"
#include "segment/mesh/transform.h"
#include "sim/program/krl_reader.h"
#include "sim/replay/signal_walk.h"
#include "sim/replay/turn.h"
#include "sim/replay/walk/machine_walk.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

constexpr const char* usage =
    "bench_program_limits [--make] JOB CELL\n"
    "  --make  makes the program again too: toolpath, program and post\n"
    "  JOB     of a piece with a program; of one in parts the first, beside which the others lie\n";
constexpr double replay_cell = 0.25;  // mm
constexpr int runs = 3;               // the best of so many counts; of replay and toolpath one
constexpr double max_replay = 5;      // plain loops
constexpr double max_made = 6;        // plain loops
constexpr double min_faster = 1200;   // times than the machine
constexpr double million = 1e6;

using Texts = std::map<std::string, std::string>;

Texts texts_of(const ReadJob& job) {
    Texts texts;
    for (const std::string& name : job.program->files) {
        const Bytes& bytes = job.files.at(name);
        texts[name] = {bytes.begin(), bytes.end()};
    }
    return texts;
}

ParsedProgram read(const ReadJob& job, const Texts& texts, const Cell& cell) {
    std::vector<ProgramFile> files;
    for (const std::string& name : job.program->files) files.push_back({name, texts.at(name)});
    const std::string& entry = job.program->entry;
    return read_krl(files, entry.substr(0, entry.rfind('.')), {called_programs(cell)});
}

// What the way of the tip asks of a scene.
ReplayScene scene_of(const ReadJob& job, const TriangleMesh& mesh, const Cell& cell) {
    ReplayScene scene;
    scene.cell = &cell;
    const Setup setup = with_drill_orientations(job.setup, job.program->drilling);
    for (std::size_t d = 0; d < setup.access.orientations.size(); ++d) {
        scene.orientations.push_back({normalized(setup.tool_axis(d)), setup.placement.table_angle(d),
                                      setup_in_cell(cell, setup.spoil, setup.placement, d)});
    }
    for (const JobChunk& chunk : job.program->chunks) {
        scene.chunks.push_back({chunk.file.substr(0, chunk.file.rfind('.')), chunk.tool, chunk.orientation});
    }
    scene.block = setup.block_box();
    scene.spoil = setup.spoil;
    scene.target = &mesh;
    return scene;
}

struct PosesHeld {
    double cpu_s = 0;
    std::size_t points = 0;
    std::size_t answers = 0;
};

// Of the ends of all straight moves, one after the other.
PosesHeld hold_poses(const ParsedProgram& program, const Cell& cell) {
    const CellMachine& machine = *cell.machine;
    const Pose cell_in_robot = inverse(machine.robot->base_in_cell);
    std::vector<Pose> flanges;
    for (const ProgramStep& step : program.steps) {
        if (step.kind != StepKind::linear_move) continue;
        const ModalState& state = program.states[step.state];
        Pose base = pose_of(*state.base);
        if (state.base_machine != 0 && machine.rotary_table) {
            base = cell_in_robot * (machine.rotary_table->table_in_cell * about_z(step.e1.value_or(0)) * base);
        }
        const auto& v = step.values;
        flanges.push_back(base * pose_of({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}) * inverse(pose_of(*state.tool)));
    }
    PosesHeld held;
    held.points = flanges.size();
    held.cpu_s = best_of(runs, cpu_s, [&] {
        held.answers = 0;
        Joints before = machine.start.joints;
        for (const Pose& flange : flanges) {
            const ArmAnswers answers = inverse(machine.robot->geometry, flange, before);
            if (!answers.empty()) before = answers[0].joints;
            held.answers += answers.size();
        }
        return held.answers;
    });
    return held;
}

// Of all parts of a program.
struct Limits {
    PlainLoop loop;
    PosesHeld poses;
    std::size_t bytes = 0;
    double read_s = 0;
    double replay_s = 0;
    double machine_s = 0;
    bool is_proven = true;
};

void add(const PlainLoop& part, PlainLoop& sum) {
    sum.cpu_s += part.cpu_s;
    sum.moves += part.moves;
    sum.length += part.length;
    sum.cells += part.cells;
    sum.lowered += part.lowered;
    sum.cut += part.cut;
}

void add_part(const ReadJob& job, const Cell& cell, Limits& limits) {
    const TriangleMesh mesh = job_mesh(job.files.at("piece.stl"), job.piece);
    const Texts texts = texts_of(job);
    for (const auto& [name, text] : texts) limits.bytes += text.size();
    limits.read_s += best_of(runs, cpu_s, [&] { return read(job, texts, cell); });
    const ParsedProgram program = read(job, texts, cell);
    const ReplayScene scene = scene_of(job, mesh, cell);
    FindingLog log;
    const ToolPath path = walk_machine(program, scene, log, {});
    std::vector<Vec3> tool_axes;
    for (const SceneOrientation& orientation : scene.orientations) tool_axes.push_back(orientation.tool_axis);
    add(plain_loop(path.lines, scene.block, tool_axes, cell.machine->tools, replay_cell, runs), limits.loop);
    const PosesHeld held = hold_poses(program, cell);
    limits.poses.cpu_s += held.cpu_s;
    limits.poses.points += held.points;
    limits.poses.answers += held.answers;
    const auto stock = job.files.find("stock.bin");
    const double started = process_cpu_s();
    const JobProof proof =
        prove({cell, job.setup, job.setup_in_cell, mesh, *job.program, texts,
               stock == job.files.end() ? nullptr : &stock->second, holes_of(job.caps), job.half_spaces, replay_cell});
    limits.replay_s += process_cpu_s() - started;
    limits.machine_s += proof.time_s;
    limits.is_proven = limits.is_proven && proof.is_proven();
}

double cpu_of(const RunTimes& times, const std::string& stage) {
    double cpu = 0;
    for (const StageTime& t : times.stages) cpu += t.name == stage ? t.spent.cpu_s : 0;
    return cpu;
}

// CPU seconds of toolpath, program and post, without the holes. Their proof is made with them, and not counted.
double made_again_s(const ReadJob& job, const Cell& cell) {
    Piece piece;
    piece.name = job.piece;
    piece.half_spaces = job.half_spaces;
    piece.mesh = std::make_shared<const TriangleMesh>(apply(inverse(job.setup.piece_in_setup), mesh_of(job)));
    PlacedSetup known;
    known.choice.setups = {job.setup};
    known.stock_fit = job.stock_fit;
    const Cell planned = with_tools(cell, job.setup.tools);
    const std::optional<PlacedSetup> placed = placed_at(known, piece, planned, job.setup.placement);
    if (!placed) throw InputError(InputFault::mesh, job.piece + ": the machine does not hold the setup of the job");
    Timings timings;
    Context context;
    context.timings = &timings;
    const PiecePrograms programs = make_programs(piece, *placed, {job.piece_no}, cell, {}, context);
    if (programs.parts.empty()) throw InputError(InputFault::mesh, job.piece + ": " + programs.none_because);
    return cpu_of(timings.so_far(), "toolpaths made") + cpu_of(timings.so_far(), "programs made");
}

void report(const std::string& piece, const Limits& limits, Figures& figures) {
    const PlainLoop& loop = limits.loop;
    figures.record(piece, "straight moves; their length",
                   std::to_string(loop.moves) + "; " + number_text(1e-3 * loop.length) + " m");
    figures.record(piece, "cells under the moves; lowered by them; lowered at least once",
                   number_text(static_cast<double>(loop.cells) / million) + "; " +
                       number_text(static_cast<double>(loop.lowered) / million) + "; " +
                       number_text(static_cast<double>(loop.cut) / million) + " million");
    figures.record(piece, "plain loop, CPU time", time_text(loop.cpu_s));
    figures.record(piece, "inverse kinematics of " + std::to_string(limits.poses.points) + " points, CPU time",
                   time_text(limits.poses.cpu_s));
    figures.record(piece, "reading " + number_text(1e-6 * static_cast<double>(limits.bytes)) + " MB of text, CPU time",
                   time_text(limits.read_s));
    figures.record(piece, limits.is_proven ? "replay, CPU time; proven" : "replay, CPU time; NOT PROVEN",
                   time_text(limits.replay_s));
    figures.at_most(piece, "replay / plain loop", limits.replay_s / loop.cpu_s, max_replay);
    figures.record(piece, "machine time", time_text(limits.machine_s));
    figures.at_least(piece, "machine time / replay", limits.machine_s / limits.replay_s, min_faster);
}

int measure(const fs::path& job_file, const std::string& cell_file, bool makes_again) {
    const ReadJob first = parse_job(read_job(job_file), job_file.string());
    const Cell cell = read_cell(cell_file);
    if (!first.program || first.program->part.number != 1) throw InputError(InputFault::use, usage);
    Figures figures;
    Limits limits;
    add_part(first, cell, limits);
    for (std::uint16_t part = 2; part <= first.program->part.count; ++part) {
        const fs::path file = job_file.parent_path() / job_file_name(first.piece, part);
        add_part(parse_job(read_job(file), file.string()), cell, limits);
    }
    report(first.piece, limits, figures);
    if (makes_again) {
        const double made_s = made_again_s(first, cell);
        figures.record(first.piece, "toolpath, program and post, CPU time", time_text(made_s));
        figures.at_most(first.piece, "toolpath, program and post / plain loop", made_s / limits.loop.cpu_s, max_made);
    }
    const double peak_mb = 1e-6 * static_cast<double>(Timings().so_far().peak_memory_bytes);
    figures.record(first.piece, "peak memory", number_text(peak_mb) + " MB");
    figures.print(std::cout);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const bool makes_again = argc > 1 && std::string(argv[1]) == "--make";
    if (argc != (makes_again ? 4 : 3)) {
        std::cerr << usage;
        return 64;
    }
    try {
        return measure(argv[argc - 2], argv[argc - 1], makes_again);
    } catch (const InputError& error) {
        std::cerr << error.what() << "\n";
        return 66;
    }
}
