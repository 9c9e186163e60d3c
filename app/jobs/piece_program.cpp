// One step after the other; toolpath and replay take most of the time, and whether the arm follows a toolpath is asked
// without the holes, which come after it. A setup is placed by poses that are known before there is a toolpath
// (milling_poses.h). Where the arm cannot follow it, its block is placed again, by these poses and by those of the run
// that was refused, and so on a few times; where that has no other place, by those of all runs so far. The toolpath
// stays, and each operation is asked as soon as it is made: what no place holds lies mostly in the roughing, a fifth of
// the work. With the refused runs alone one piece of a bunny at 1.5 m got its program and another one did not; with all
// runs at once it was the other way round. The plan knows foam in cells and may miss a thin wall of it: where the proof
// finds tools too fast for that, and nothing else, the whole is made again with less feed of these.

#include "app/jobs/piece_program.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "app/pictures/deviation_picture.h"
#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/cell/job_tools.h"
#include "cam/job/job_caps.h"
#include "cam/post/post.h"
#include "cam/program/make_program.h"
#include "cam/program/reachable_holes.h"
#include "cam/program/sampled_path.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/drill_orientation.h"
#include "cam/setup/placement/place_block.h"
#include "cam/toolpath/make_toolpath.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/transform.h"
#include "sim/replay/finding.h"

namespace qchopper {
namespace {

constexpr double narrowly_beside = 2;  // mm; the finishing tool then still roughs what stands beside the walls
constexpr double pose_distance = 20;   // mm, of those of a toolpath by which its block is placed
constexpr std::size_t max_places = 6;  // of the block, the one that its setup has included
constexpr double drilled_cells = 4;    // of the toolpath's maps in the side of one by which holes are drilled
constexpr double slower = 0.6;         // feed of a tool that removed foam too fast, of the one before
constexpr int most_feeds = 4;          // that are tried, the largest included

std::vector<Pose> frames_of(const Setup& setup, const Cell& cell) {
    std::vector<Pose> frames;
    const std::size_t angles = std::max<std::size_t>(1, setup.placement.table_angles.size());
    for (std::size_t d = 0; d < angles; ++d) frames.push_back(setup_in_cell(cell, setup.spoil, setup.placement, d));
    return frames;
}

// A toolpath and the drilling that follows it.
struct MadePath {
    Toolpath toolpath;
    Drilling drilling;
};

// The wall of the dowels of a size; 0 if the cell lists none.
double wall_of(const JobHole& hole, const Cell& cell) {
    double wall = 0;
    for (const DowelSize& size : cell.dowels) {
        if (size.diameter == hole.diameter && size.depth == hole.depth) wall = size.wall;
    }
    return wall;
}

// The holes that the robot reaches where the block stands.
Drilling drilling_of(const std::vector<RemovedFoam>& removed, const Piece& piece, const PlacedSetup& piece_setup,
                     const Cell& cell, const std::vector<DrawnCap>& caps, const Context& context) {
    const Setup& setup = piece_setup.setup();
    std::vector<DrillHole> holes;
    for (const DrawnCap& drawn : caps) {
        for (const JobHole& hole : holes_of({drawn.cap})) {
            holes.push_back(
                {hole.number, hole.point, -hole.axis, hole.diameter, hole.depth, wall_of(hole, cell), hole.by_hand});
        }
    }
    if (holes.empty()) return {};
    InProcessStock left(setup);
    for (const RemovedFoam& along : removed) left.remove_above(along.orientation, along.down_to);
    Drilling drilling = drill_holes(holes, setup, apply(setup.piece_in_setup, *piece.mesh), cell, left);
    keep_reachable_holes(drilling, setup, piece_setup.machine_reachability, cell, context);
    return drilling;
}

// Places for the block of a setup, the next one after a program was refused at the one before.
class OtherPlaces {
 public:
    OtherPlaces(const PlacedSetup& known, const Piece& piece, const Cell& cell, const Context& context)
        : known_(known), piece_(piece), cell_(cell), context_(context) {}

    // That holds best the runs that were refused so far, and the poses of the setup; else that which holds all runs
    // of the operations best that are known so far, then the first of a coarse grid that holds the former. Nothing if
    // all were tried or do not hold the setup.
    std::optional<PlacedSetup> next(const ProgramRefused& refused, const std::vector<Operation>& operations) {
        const Setup& setup = known_.setup();
        if (poses_.empty()) {
            poses_ = milling_poses(setup, *piece_.mesh, cell_);
            tried_.push_back(setup.placement);
        }
        if (refused.run()) {
            add(poses_, refused.run()->orientation, refused.run()->run);
        }
        std::optional<PlacedSetup> other = at(place_block(setup, poses_, cell_, {}, context_).placement);
        if (!other && asked_ < operations.size()) {  // runs that would be refused later are among them
            asked_ = operations.size();
            std::vector<OrientationPoses> all = poses_;
            for (const Operation& operation : operations) {
                for (const PathRun& run : operation.runs) add(all, operation.orientation, run);
            }
            other = at(place_block(setup, all, cell_, {}, context_).placement);
        }
        if (!other) {
            const std::optional<BlockPlacement> first = first_place(setup, poses_, cell_, {}, context_);
            if (first) other = at(*first);
        }
        return other;
    }

 private:
    static void add(std::vector<OrientationPoses>& poses, std::size_t orientation, const PathRun& run) {
        poses[orientation].regions.push_back(sparse_poses(sampled_path({&run, 1}), pose_distance));
    }

    std::optional<PlacedSetup> at(const BlockPlacement& place) {
        if (tried_.size() > max_places || std::ranges::find(tried_, place) != tried_.end()) return {};
        tried_.push_back(place);
        return placed_at(known_, piece_, cell_, place);
    }

    const PlacedSetup& known_;
    const Piece& piece_;
    const Cell& cell_;
    const Context& context_;
    std::vector<OrientationPoses> poses_;
    std::vector<BlockPlacement> tried_;
    std::size_t asked_ = 0;  // operations of which all runs were asked at once
};

// Whether the arm follows the toolpath alone where the block stands: throws ProgramRefused if not.
void check_followed(const Toolpath& path, const PlacedSetup& piece_setup, const Cell& cell, const Context& context) {
    make_program(path, piece_setup.setup(), piece_setup.machine_reachability, cell, context);
}

struct PostedProgram {
    std::vector<ProgramPart> parts;
    MovesLeftOut left_out;
};

PostedProgram post(const Toolpath& path, const Drilling& drilling, const PlacedSetup& piece_setup,
                   const ProgramName& name, const Cell& cell, const Context& context) {
    Toolpath whole = path;
    const std::vector<Operation>& drilled = drilling.operations;
    whole.operations.insert(whole.operations.end(), drilled.begin(), drilled.end());
    const Setup setup = with_drill_orientations(piece_setup.setup(), drilling.orientations);
    const Program program = make_program(whole, setup, piece_setup.machine_reachability, cell, context);
    return {post_program(program, cell, name), {program.left_out_mm, program.left_out_because}};
}

std::size_t bytes_of(const ProgramPart& part) {
    std::size_t bytes = 0;
    for (const ProgramText& file : part.files) bytes += file.text.size();
    return bytes;
}

std::vector<std::size_t> drilled_holes(const Drilling& drilling) {
    std::vector<std::size_t> numbers;
    for (const DrillHole& hole : drilling.holes) {
        if (hole.by_hand.empty()) numbers.push_back(hole.number);
    }
    return numbers;
}

// What refuses a program that drills this hole and does nothing else; empty: nothing.
std::string refusal_alone(std::size_t number, const Drilling& drilling, const PlacedSetup& piece_setup,
                          const ProgramName& name, const Cell& cell, const Context& context) {
    Drilling alone = drilling;
    for (const std::size_t other : drilled_holes(drilling)) {
        if (other != number) leave_to_hand(alone, other, "not asked", piece_setup.setup());
    }
    try {
        post({}, alone, piece_setup, name, cell, context);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

// With the holes. Where the program cannot be made with them, without those with which alone none can be made; and
// where that does not help, without any.
PostedProgram make_parts(MadePath& made, const PlacedSetup& piece_setup, const ProgramName& name, const Cell& cell,
                         const Context& context) {
    const auto posted = [&] { return post(made.toolpath, made.drilling, piece_setup, name, cell, context); };
    const auto leave = [&](std::size_t number, const std::string& why) {
        leave_to_hand(made.drilling, number, "the program cannot drill: " + why, piece_setup.setup());
    };
    while (!made.drilling.operations.empty()) {
        std::string why;
        try {
            return posted();
        } catch (const InputError& error) {
            why = error.what();
        }
        const std::vector<std::size_t> before = drilled_holes(made.drilling);
        const Drilling all = made.drilling;
        for (const std::size_t number : before) {
            const std::string alone = refusal_alone(number, all, piece_setup, name, cell, context);
            if (!alone.empty()) leave(number, alone);
        }
        if (drilled_holes(made.drilling).size() < before.size()) continue;
        for (const std::size_t number : before) leave(number, why);
    }
    return posted();
}

std::vector<DrawnCap> decided(std::vector<DrawnCap> caps, const Drilling& drilling) {
    std::map<std::size_t, std::string> reasons;
    for (const DrillHole& hole : drilling.holes) reasons[hole.number] = hole.by_hand;
    decide_holes(caps, drilled_holes(drilling), reasons, {});
    return caps;
}

// Of a part as it was posted; the figures of its chunks are read back later.
ProgramInput program_of(const PostedProgram& posted, std::size_t number, const MadePath& made,
                        const CellMachine& machine) {
    const ProgramPart& part = posted.parts[number - 1];
    ProgramInput input;
    input.program.dialect = machine.program.dialect;
    input.program.scallop_mm = machine.program.scallop;
    for (const UnusedTool& unused : made.toolpath.unused) {
        ToolLeftOut left_out{{}, unused.orientation, unused.because};
        if (unused.tool) left_out.tool = machine.tools[*unused.tool].number;
        input.program.left_out.push_back(std::move(left_out));
    }
    input.program.moves_left_out = posted.left_out;
    input.program.drilling = made.drilling.orientations;
    input.program.entry = part.entry;
    for (const ProgramText& file : part.files) {
        input.program.files.push_back(file.name);
        input.texts[file.name] = file.text;
    }
    for (const PostedChunk& chunk : part.chunks) {
        JobChunk record;
        record.file = chunk.name;
        record.tool = chunk.tool_number;
        record.orientation = chunk.orientation;
        input.program.chunks.push_back(record);
        input.program.holes.insert(input.program.holes.end(), chunk.holes.begin(), chunk.holes.end());
        if (input.tools.empty() || input.tools.back() != chunk.tool_number) input.tools.push_back(chunk.tool_number);
    }
    input.program.part.number = static_cast<std::uint16_t>(number);
    input.program.part.count = static_cast<std::uint16_t>(posted.parts.size());
    std::sort(input.program.holes.begin(), input.program.holes.end());
    return input;
}

// Where the machine cannot follow the toolpath from where the block stands, from another place. Throws ProgramRefused.
FollowedToolpath followed_with(const ToolpathSettings& settings, const Piece& piece, const PlacedSetup& known,
                               const Cell& cell, const Context& context) {
    StageTimer stage(context, "toolpaths made");
    OtherPlaces places(known, piece, cell, context);
    PlacedSetup piece_setup = known;
    const auto check_newest = [&](const std::vector<Operation>& so_far) {
        for (std::size_t i = so_far.size() - 1; i < so_far.size();) {
            try {
                check_operation(so_far[i], i + 1, piece_setup.setup(), piece_setup.machine_reachability, cell, context);
                ++i;
            } catch (const ProgramRefused& refused) {
                std::optional<PlacedSetup> other = places.next(refused, so_far);
                if (!other) throw;
                piece_setup = std::move(*other);
                i = 0;
            }
        }
    };
    InProcessStock left(known.setup());
    FollowedToolpath followed{make_toolpath(known.setup(), *piece.mesh, cell, settings, context, &left, check_newest),
                              {}};
    stage.next("programs made");
    while (true) {
        try {
            check_followed(followed.toolpath, piece_setup, cell, context);
            break;
        } catch (const ProgramRefused& refused) {
            std::optional<PlacedSetup> other = places.next(refused, followed.toolpath.operations);
            if (!other) throw;
            piece_setup = std::move(*other);
        }
    }
    followed.removed = left.removed(drilled_cells);
    const BlockPlacement& place = piece_setup.setup().placement;
    if (place != known.setup().placement) followed.place = place;
    return followed;
}

void add_proof(ProgramInput& input, const JobProof& proof, const TriangleMesh& mesh) {
    if (proof.chunks.size() == input.program.chunks.size()) input.program.chunks = proof.chunks;
    input.program.time_s = proof.time_s;
    input.proof = proof;
    if (!proof.deviation.empty()) input.deviation_picture = deviation_picture(mesh, proof.deviation, proof.is_given_up);
}

PiecePrograms without_programs(const std::string& because, bool is_machine_refusing, std::vector<DrawnCap> caps) {
    return {{}, because, caps_by_hand(std::move(caps), because), {}, is_machine_refusing};
}

ToolpathSettings settings_for(const Cell& cell, FineTools fine, const std::map<std::uint16_t, double>& feed_shares) {
    ToolpathSettings settings;
    settings.scallop = cell.machine->program.scallop;
    settings.fine = fine;
    settings.feed_shares = feed_shares;
    return settings;
}

// What follows after the toolpath.
PiecePrograms programs_along(FollowedToolpath followed, const Piece& piece, const PlacedSetup& known,
                             const ProgramName& name, const Cell& cell, std::vector<DrawnCap> caps,
                             const Context& context) {
    if (!followed.none_because.empty()) {
        return without_programs(followed.none_because, followed.is_machine_refusing, std::move(caps));
    }
    const Cell planned = with_tools(cell, known.setup().tools);
    const PlacedSetup piece_setup = followed.place ? placed_at(known, piece, planned, *followed.place).value() : known;
    const Setup& setup = piece_setup.setup();
    MadePath made{std::move(followed.toolpath), {}};
    PostedProgram posted;
    try {
        const StageTimer stage(context, "programs made");
        made.drilling = drilling_of(followed.removed, piece, piece_setup, planned, caps, context);
        posted = make_parts(made, piece_setup, name, planned, context);
    } catch (const InputError& error) {
        return without_programs(error.what(), dynamic_cast<const ProgramRefused*>(&error) != nullptr, std::move(caps));
    }
    followed.removed.clear();
    const TriangleMesh mesh = job_mesh(to_stl(apply(setup.piece_in_setup, *piece.mesh)), piece.name);
    const std::vector<Pose> frames = frames_of(setup, cell);
    PiecePrograms programs;
    programs.place = followed.place;
    programs.caps = decided(std::move(caps), made.drilling);
    std::vector<JobCap> job_caps;
    for (const DrawnCap& drawn : programs.caps) job_caps.push_back(drawn.cap);
    std::size_t all_bytes = 0;
    for (const ProgramPart& part : posted.parts) all_bytes += bytes_of(part);
    std::size_t bytes_read = 0;
    Bytes stock;  // what the part before left
    while (programs.parts.size() < posted.parts.size()) {
        ProvenProgram proven;
        proven.input = program_of(posted, programs.parts.size() + 1, made, *planned.machine);
        proven.input.stock = std::move(stock);
        const StageTimer stage(context, "programs replayed");
        bytes_read += bytes_of(posted.parts[programs.parts.size()]);
        context.progress("bytes of the program read", bytes_read, all_bytes);
        ProofInput proof{cell,
                         setup,
                         frames,
                         mesh,
                         proven.input.program,
                         proven.input.texts,
                         &proven.input.stock,
                         holes_of(job_caps),
                         piece.half_spaces};
        proof.is_stated = false;
        proven.proof = prove(proof, context);
        stock = std::move(proven.proof.stock_left);
        add_proof(proven.input, proven.proof, mesh);
        programs.parts.push_back(std::move(proven));
    }
    return programs;
}

}  // namespace

std::string no_programs_for(const Cell& cell) {
    return cell.machine ? "" : "the cell file describes no machine";
}

ProgramName program_name(const JobInput& job) {
    return {job.piece_no, order_in_names(job.project_id)};
}

std::vector<DrawnCap> caps_by_hand(std::vector<DrawnCap> caps, const std::string& none_because) {
    decide_holes(caps, {}, {}, "there is no program: " + none_because);
    return caps;
}

std::set<std::uint16_t> too_fast_tools(const std::vector<ProvenProgram>& parts) {
    std::set<std::uint16_t> tools;
    for (const ProvenProgram& part : parts) {
        for (const ProofFinding& finding : part.proof.findings) {
            if (finding.kind != to_word(FindingKind::removal_rate)) return {};
            for (const JobChunk& chunk : part.input.program.chunks) {
                if (chunk.file == finding.file) tools.insert(chunk.tool);
            }
        }
    }
    return tools;
}

FollowedToolpath follow_toolpath(const Piece& piece, const PlacedSetup& known, const Cell& cell, const Context& context,
                                 FineTools fine, const std::map<std::uint16_t, double>& feed_shares) {
    ToolpathSettings settings = settings_for(cell, fine, feed_shares);
    const Cell planned = with_tools(cell, known.setup().tools);
    try {
        try {
            return followed_with(settings, piece, known, planned, context);
        } catch (const ProgramRefused&) {
            // Poses are known of tips on the block, not of all that roughing takes beside it.
            settings.beside_block = narrowly_beside;
            return followed_with(settings, piece, known, planned, context);
        }
    } catch (const InputError& error) {
        FollowedToolpath none;
        none.none_because = error.what();
        none.is_machine_refusing = dynamic_cast<const ProgramRefused*>(&error) != nullptr;
        return none;
    }
}

PiecePrograms make_programs(const Piece& piece, const PlacedSetup& known, const ProgramName& name, const Cell& cell,
                            const std::vector<DrawnCap>& caps, const Context& context, FineTools fine,
                            std::optional<FollowedToolpath> followed) {
    std::map<std::uint16_t, double> feed_shares;
    for (int made = 1;; ++made) {
        std::optional<FollowedToolpath> own = std::exchange(followed, std::nullopt);
        if (!own) own = follow_toolpath(piece, known, cell, context, fine, feed_shares);
        PiecePrograms programs = programs_along(*std::move(own), piece, known, name, cell, caps, context);
        const std::set<std::uint16_t> too_fast = too_fast_tools(programs.parts);
        if (made == most_feeds) return programs;
        std::string numbers;
        for (const CuttingTool& tool : cell.machine->tools) {
            double& share = feed_shares.try_emplace(tool.number, 1).first->second;
            if (!too_fast.contains(tool.number) || share * tool.feed_max_mm_per_s <= tool.feed_min_mm_per_s) continue;
            share *= slower;
            numbers += (numbers.empty() ? "" : ", ") + std::to_string(tool.number);
        }
        if (numbers.empty()) return programs;  // they have their least feed
        context.message("piece " + piece.name + ": the proof finds that tool " + numbers +
                        " removes foam too fast; its program is made again with less feed");
    }
}

}  // namespace qchopper
