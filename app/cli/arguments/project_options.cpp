// On the option parser CLI11; options that several commands have are added by one function.

#include "app/cli/arguments/project_options.h"

#include <CLI/CLI.hpp>

#include "app/cli/arguments/option_values.h"
#include "app/store/ready_cells.h"
#include "segment/regions/methods.h"

namespace qchopper {
namespace {

void add_scale(CLI::App* c, std::optional<double>& scale) {
    c->add_option("--scale", scale, "enlarge by this factor; recorded, and shown as a warning")
        ->check(number_between(1e-6, 1e6, "a factor above 0"));
}

// The older name is taken for one version more; help does not show it.
void add_fragments(CLI::App* c, std::optional<std::string>& fragments) {
    c->add_option("--fragments", fragments, "solids too small to be pieces: keep or drop (keep)")
        ->check(one_of({"keep", "drop"}));
    c->add_option("--crumbs", fragments)->check(one_of({"keep", "drop"}))->group("");
}

void add_repair_choices(CLI::App* c, RepairChoiceArguments& a) {
    c->add_flag("--size-ok", a.size_ok,
                "take a scan that is shorter than 1 cm or longer than 20 m; without it that is asked on a terminal, "
                "else refused");
    const OptionCheck is_tolerance = number_between(0, many, "a length in mm");
    c->add_option("--snap-borders", a.snap_borders_mm,
                  "make one point of border points that lie within so many mm (off)")
        ->check(is_tolerance);
    c->add_option("--weld", a.snap_borders_mm)->check(is_tolerance)->group("");
    c->add_option("--fill", a.fill,
                  "close holes flat, fair (refined, bent like the surface around), auto (small ones flat, large ones "
                  "fair) or none (auto)")
        ->check(one_of({"auto", "flat", "fair", "none"}));
    c->add_flag("--smooth-pen-grooves", a.smooth_pen_grooves,
                "lift the shallow grooves that a marker pen leaves in a laser scan");
    c->add_flag("--smooth-marks", a.smooth_pen_grooves)->group("");
    const OptionCheck is_length = number_between(0, many, "a length in mm");
    c->add_option("--alpha-wrap", a.alpha_wrap_mm,
                  "last resort: wrap the scan with a ball of so many mm, which keeps no point of it (off)")
        ->check(is_length);
    c->add_option("--wrap", a.alpha_wrap_mm)->check(is_length)->group("");
}

void add_candidate_options(CLI::App* c, ProjectArguments& a) {
    c->add_option("--normals", a.normals,
                  "planes are tried along the axes of the piece's box, or along 129 normals of the sphere too: box or "
                  "sphere (sphere by carve and chopper, else box; docs/user/candidate-planes.md)")
        ->check(one_of({"box", "sphere"}));
    CLI::Option* offsets =
        c->add_option("--offsets", a.offsets, "so many planes along each normal (80 by carve, else 40)")
            ->check(number_between(1, 10'000, "a count from 1 to 10000"));
    c->add_option("--offset-step", a.offset_step_mm,
                  "planes so many mm apart instead, but at most 199 along each normal (5 by chopper)")
        ->check(number_between(1e-3, many, "a length in mm"))
        ->excludes(offsets);
    c->add_option("--planes", a.planes,
                  "a text file with a plane nx,ny,nz,d in each line; every piece is tried with them too");
    c->add_option(
         "--propose", a.propose,
         "every piece is tried with planes along the borders of the regions of the scan too, by methods of the "
         "literature: " +
             names_of_region_methods() + "; several by commas, all or none (none; docs/user/candidate-planes.md)")
        ->check(read_by(proposers_from, "neither none, all, nor some of " + names_of_region_methods()));
    c->add_flag("--symmetry", a.symmetry,
                "find the symmetry plane of the scan; it and the mirror images of cuts are tried too (chopper does)");
    c->add_option("--no-cut", a.no_cut,
                  "a PLY of the scan in which surface that must not be cut is painted red or has the property no_cut");
}

// One statement per option, without a branch.
// NOLINTNEXTLINE(readability-function-size)
void add_project_options(CLI::App* c, ProjectArguments& a) {
    add_repair_choices(c, a);
    c->add_flag("--resolve-self-intersections", a.resolve_self_intersections,
                "repair places where the scan runs through itself; cutting does not need that");
    add_units(c, "scan", a.units);
    add_scale(c, a.scale);
    takes_cell_name(c->add_option("--cell", a.cell, "the cell file, or the name of a ready cell, as kr60-ha"));
    CLI::Option* tools = add_tools(c, a.tools);
    c->add_option("--finest-tool", a.finest_tool, "finish with no ball-ended tool of a smaller diameter, in mm (all)")
        ->check(CLI::PositiveNumber)
        ->excludes(tools);
    c->add_option(
         "--fine", a.fine,
         "which small tools finish what larger ones leave: all; auto, those that add 0.3 % of a piece's "
         "surface or more; none, so that the largest ball below the tool of the roughing is the smallest (auto)")
        ->check(one_of({"auto", "all", "none"}))
        ->excludes(tools);
    c->add_option(
         "--preset", a.preset,
         "objectives and stop rules by name: carve cuts for what a tilting tool reaches, until of no piece more "
         "than 2 % is out of reach and every piece fits the cell; thesis has the objectives of Nicholson 2016 "
         "and no stop rule; bunny, femur, vertebrae and skull are its cases; chopper has the objectives of Luo et al. "
         "2012 and stops when every piece fits the print volume (carve)")
        ->check(one_of({"carve", "thesis", "bunny", "femur", "vertebrae", "skull", "chopper"}));
    c->add_option("--min-cuts", a.min_cuts, "stop rule: make at least N cuts")
        ->check(number_between(0, 1e6, "a count of cuts"));
    c->add_option("--max-faces", a.max_faces, "stop rule: every piece has fewer than N faces")
        ->check(number_between(1, many, "a count of faces"));
    c->add_option("--max-obb", a.max_obb, "stop rule: every piece fits in a box of X,Y,Z mm, in some orientation")
        ->check(read_by(lengths_from, "not X,Y,Z in mm"));
    c->add_flag("--fits-cell", a.fits_cell,
                "stop rule: every piece fits the cell, and by carve its arm and tools can carve it (by carve, and by "
                "prepare if no other is set)");
    c->add_option(
         "--max-unreachable", a.max_unreachable,
         "stop rule: of no piece a larger share of the surface, 0 to 1, is out of reach of the tool (0.02 by carve)")
        ->check(number_between(0, 1, "a share from 0 to 1"));
    c->add_flag("--count-narrow", a.count_narrow,
                "surface too narrow for the smallest tool counts as out of reach (it is only reported)");
    add_candidate_options(c, a);
    c->add_option(
        "--ignore-surface", a.ignore_surface,
        "a PLY of the scan in which surface that may stay as it is, is painted red or has the property ignore; "
        "it is never out of reach (docs/user/ignored-surface.md)");
    c->add_flag(
        "--ignore-inside", a.ignore_inside,
        "surface that no direction at all reaches before the first cut may stay, such as the inside of a skull");
    c->add_option("--max-cuts", a.max_cuts, "end the search at N cuts, whatever the stop rules (500)")
        ->check(number_between(0, 1e6, "a count of cuts"));
    c->add_option("--stop", a.stop, "stop when any or all of the rules hold (all)")->check(one_of({"any", "all"}));
    c->add_option("--fragility", a.fragility,
                  "form of that objective: thinness, thesis or binary (thinness; binary by chopper)")
        ->check(one_of({"thinness", "thesis", "binary"}));
    c->add_option(
         "--print-volume", a.print_volume,
         "box of X,Y,Z mm that parts, utilization and seam count by, in the best order of the axes (the largest "
         "block of the cell, else none)")
        ->check(read_by(print_volume_from, "not X,Y,Z in mm, each at least 1"));
    c->add_option("--utilization", a.utilization, "over which pieces: those of the newest cut, or the whole (cut)")
        ->check(one_of({"cut", "whole"}));
    c->add_option("--connector", a.connector, "form of that objective: spread or ratio (spread)")
        ->check(one_of({"spread", "ratio"}));
    c->add_option("--forbid", a.forbidden,
                  "take a cut with the value 1 of this objective only if no other is left: fragility or connector; "
                  "several by commas")
        ->delimiter(',')
        ->check(one_of(forbiddable()));
    c->add_option(
         "--discard", a.discard,
         "leave pieces out, before the search and until undone: head rest, debris, table; names by commas, and "
         "below=50ml for all that are smaller")
        ->check(read_by(discard_from, "not like A,C,below=50ml"));
    add_fragments(c, a.fragments);
    c->add_option("--fragment-volume", a.fragment_volume_mm3,
                  "solids of less than so many mm3 are no pieces (a hundred-thousandth of the scan's volume)")
        ->check(number_between(0, many, "a volume in mm3"));
    c->add_option("--weights", a.weights,
                  "of the terms, any of face_ratio=10,fragility=5,piece_count=50,undercut=10,unreachable=0, and of "
                  "Chopper's parts, utilization, connector, seam, symmetry, structure (the preset's)")
        ->check(
            read_by(weights_from, "not like face_ratio=10,fragility=5,piece_count=50,undercut=10, nor four numbers"));
    c->add_option("--structure", a.structure,
                  "avoid cuts where the whole model, standing upright under a load, has tension and shear "
                  "(docs/user/structure.md): upright=+z,density=KG_M3,strength=MPA,load=weight; load may be N or "
                  "weight+N; voxel=MM (off)")
        ->check(read_by(load_from, "not like upright=+z,density=100,strength=0.5,load=weight"));
    c->add_option("--beam", a.beam, "how many segmentations the search keeps (1: greedy)")
        ->check(number_between(1, 1000, "a count from 1 to 1000"));
    c->add_option("--time-limit", a.time_limit_s, "stop after so many seconds, with the decision being made")
        ->check(number_between(0, 1e9, "a number of seconds"));
}

}  // namespace

CLI::Option* add_tools(CLI::App* command, std::vector<std::uint16_t>& tools) {
    return command
        ->add_option("--tools", tools,
                     "carve with no other tools of the cell file than those of these numbers, several by commas; "
                     "holes without their drill are left to the hand (all)")
        ->delimiter(',')
        ->check(number_between(1, 65535, "the number of a tool"));
}

void add_project(CLI::App* command, std::filesystem::path& project) {
    command->add_option("PROJECT", project, "the folder NAME.qch")->required();
}

CLI::Option* takes_cell_name(CLI::Option* option) {
    const std::function<std::string(std::string)> named = [](const std::string& text) {
        return cell_file_of(text).string();
    };
    return option->transform(named);
}

void add_units(CLI::App* command, const std::string& of, std::optional<std::string>& units) {
    command->add_option("--units", units, "what one unit of the " + of + " is: mm, cm, m, in")
        ->check(one_of({"mm", "cm", "m", "in"}));
}

void add_common(CLI::App* command, Arguments& arguments, const std::function<void()>& on_parsed) {
    command->add_flag("--json", arguments.json, "exactly one JSON document on stdout");
    command->add_flag("-q,--quiet", arguments.quiet, "no progress, only warnings and errors on stderr");
    command
        ->add_option("--progress", arguments.progress,
                     "json: progress, messages, warnings and errors on stderr as a JSON document a line")
        ->check(one_of({"json"}));
    command->add_flag("--timings", arguments.timings,
                      "print where the time went and the peak memory, on stderr; with --json in the document too");
    command
        ->add_option("--threads", arguments.threads,
                     "compute with at most so many threads (as many as there are processors); the results are the same")
        ->check(number_between(1, 1024, "a number of threads"));
    command->callback(on_parsed);
}

void add_repair(CLI::App& app, RepairArguments& repair, Arguments& common) {
    CLI::App* c = app.add_subcommand("repair", "make a closed solid of a scan and report what was done");
    c->add_option("SCAN", repair.scan, scan_formats + "; - is standard input")->required();
    c->add_option("-o,--out", repair.out, "the file to write: .ply, which keeps every bit, or .stl")->required();
    add_units(c, "file", repair.units);
    add_scale(c, repair.scale);
    add_repair_choices(c, repair);
    add_fragments(c, repair.fragments);
    c->add_flag("--keep-self-intersections", repair.keep_self_intersections,
                "leave places where the scan runs through itself");
    c->add_option("--groove-width", repair.groove_width, "with --smooth-pen-grooves: the widest, in mm (6)")
        ->check(CLI::PositiveNumber);
    c->add_option("--groove-depth", repair.groove_depth, "with --smooth-pen-grooves: the deepest, in mm (1)")
        ->check(CLI::PositiveNumber);
    c->add_option("--mark-width", repair.groove_width)->check(CLI::PositiveNumber)->group("");
    c->add_option("--mark-depth", repair.groove_depth)->check(CLI::PositiveNumber)->group("");
    c->add_option("--skip", repair.skipped, "leave steps out: faces, split, orient, stitch, degenerate, orient_outward")
        ->delimiter(',')
        ->transform([](const std::string& step) {
            return step == "no_area" ? "degenerate" : step == "outwards" ? "orient_outward" : step;
        })
        ->check(one_of({"faces", "split", "orient", "stitch", "degenerate", "orient_outward"}));
    add_common(c, common, [&] { common.command = repair; });
}

void add_prepare(CLI::App& app, PrepareArguments& prepare, Arguments& common) {
    CLI::App* c = app.add_subcommand("prepare", "make pieces and job files of a scan");
    c->add_option("SCAN", prepare.input, scan_formats + "; or the folder NAME.qch of a project to go on with")
        ->required();
    add_project_options(c, prepare);
    CLI::Option* without = c->add_flag("--no-programs", prepare.no_programs,
                                       "write jobs without robot programs, now and whenever this project goes on; they "
                                       "go to a simulated cell only");
    CLI::Option* with = c->add_flag("--programs", prepare.programs, "write robot programs again, after --no-programs")
                            ->excludes(without);
    c->add_flag("--items", prepare.items,
                "write no programs, but what they are made from, for work and gather, into NAME.qch/work")
        ->excludes(with)
        ->excludes(without);
    c->add_option("-o,--out", prepare.out, "the project folder to make: NAME.qch");
    add_common(c, common, [&] { common.command = prepare; });
}

void add_segment(CLI::App& app, SegmentArguments& segment, Arguments& common) {
    CLI::App* c = app.add_subcommand("segment", "cut a scan one decision at a time; --help lists the decisions");
    c->add_option("SCAN", segment.input, scan_formats + ", to make a project of; or the folder NAME.qch of one")
        ->required();
    add_project_options(c, segment);
    c->get_option("--cell")->description(
        "the cell file, or the name of a ready cell, now or later; without one the tool has no radius and tilts by up "
        "to "
        "60 degrees");
    c->add_flag("--step", segment.step, "propose the best planes for the next piece; cut nothing");
    c->add_option("--top", segment.top, "how many planes to show (10)")
        ->check(number_between(1, 1e6, "a count of planes"));
    c->add_option("--accept", segment.accept, "cut by the K-th plane of that ranking")
        ->check(number_between(1, 1e6, "a place in the ranking"));
    c->add_option(
         "--expect-plane", segment.expected_plane,
         "with --accept: cut only if the K-th plane is this one to the last digit, nx,ny,nz,d of --step --json")
        ->check(read_by(plane_from, "not nx,ny,nz,d"));
    c->add_option("--try-weights", segment.tried_weights,
                  "with --step or --preview: rank by these weights, as --weights takes them, and keep those in force")
        ->check(
            read_by(weights_from, "not like face_ratio=10,fragility=5,piece_count=50,undercut=10, nor four numbers"));
    c->add_option("--plane", segment.plane,
                  "cut by nx,ny,nz,d: a direction of any length, and the distance along it in mm, as --step shows")
        ->check(read_by(plane_from, "not nx,ny,nz,d"));
    c->add_option("--preview", segment.preview, "what K or nx,ny,nz,d would make; cuts nothing")
        ->check(read_by([](const std::string& text) { return plane_from(text) || place_from(text); },
                        "neither a place in the ranking nor nx,ny,nz,d"));
    c->add_flag("--setups", segment.preview_setups,
                "with --preview: how the pieces would be milled, as setup shows it");
    c->add_option("--piece", segment.piece, "the piece to be cut next (the one that the rules choose)");
    c->add_flag("--write-pieces", segment.write_pieces, "write the pieces of the project folder after each decision");
    c->add_flag("--undo", segment.undo, "undo the last decision");
    c->add_flag("--redo", segment.redo, "redo the decision that was undone");
    c->add_flag("--reset", segment.reset, "undo all cuts; --undo brings them back");
    c->add_flag("--auto", segment.goes_on, "let the search go on to the stop rules, given now or before");
    c->add_option("--plan", segment.plan, "write the cuts as a plan (docs/user/plan-file.md)");
    c->add_option("--replay", segment.replayed, "make the cuts of a plan on this scan");
    c->add_option("--regions", segment.regions,
                  "write the regions that a method of --propose finds on the scan to the .png or .ply of -o; cuts "
                  "nothing")
        ->check(read_by([](const std::string& text) { return region_method(text) != nullptr; },
                        "none of " + names_of_region_methods()));
    c->add_option("-o,--out", segment.out, "the project folder to make: NAME.qch; with --regions the file to write");
    add_common(c, common, [&] { common.command = segment; });
}

}  // namespace qchopper
