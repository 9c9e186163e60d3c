#include "app/cli/arguments.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>
#include <numeric>
#include <sstream>

#include "app/cli/examples.h"
#include "app/cli/segment_values.h"
#include "app/cli/version.h"
#include "base/error.h"

namespace qchopper {
namespace {

constexpr const char* scan_formats = "PLY, STL, OBJ, OFF, GLB, glTF or 3MF, packed by gzip or not";

// Edits that turn one word into another.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

std::string hint(CLI::App& app, int argc, const char* const* argv) {
    if (argc < 2 || argv[1][0] == '-') return {};
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == argv[1]) return {};
    }
    for (const CLI::App* command : app.get_subcommands({})) {
        if (distance(command->get_name(), argv[1]) <= 2) {
            return "\"" + std::string(argv[1]) + "\" is no command; did you mean \"" + command->get_name() + "\"?";
        }
    }
    return "\"" + std::string(argv[1]) + "\" is no command";
}

// Own words instead of CLI11's validators, which print type names and 300-digit bounds.
CLI::Validator number_between(double low, double high, const std::string& words) {
    return CLI::Validator(
        [=](const std::string& text) {
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool ok = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
            return ok ? std::string() : "\"" + text + "\" is not " + words;
        },
        "");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
    return CLI::Validator(
        [=](const std::string& text) {
            if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
            std::string list;
            for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
            return "\"" + text + "\" is not one of " + list;
        },
        "");
}

constexpr double many = 1e15;

void add_common(CLI::App* command, Arguments& arguments) {
    command->add_flag("--json", arguments.json, "exactly one JSON document on stdout");
    command->add_flag("-q,--quiet", arguments.quiet, "no progress, only warnings and errors on stderr");
}

// The text of X,Y,Z as three lengths.
std::optional<Vec3> three_lengths(const std::string& text) {
    std::istringstream in(text);
    Vec3 v;
    char comma[2] = {};
    if (!(in >> v.x >> comma[0] >> v.y >> comma[1] >> v.z) || comma[0] != ',' || comma[1] != ',') return std::nullopt;
    char rest = 0;
    if (in >> rest || !(v.x > 0 && v.y > 0 && v.z > 0)) return std::nullopt;
    return v;
}

struct Parser {
    CLI::App app{"From the scan of a bone to carving jobs for a robot cell.", "qchopper"};
    Arguments common;
    SampleArguments sample;
    InspectArguments inspect;
    RepairArguments repair;
    PrepareArguments prepare;
    SegmentArguments segment;
    ExplainArguments explain;
    ExportArguments exported;
    DryRunArguments dry_run;
    CellSimArguments cell_sim;
    DispatchArguments dispatch;
    std::string max_obb;

    Parser() {
        app.footer(examples_of(""));
        app.require_subcommand(1);
        app.set_version_flag("--version", std::string("qchopper ") + version);
        add_sample();
        add_inspect();
        add_repair();
        add_prepare();
        add_segment();
        add_explain();
        add_export();
        add_dry_run();
        add_cell_sim();
        add_dispatch();
        for (CLI::App* command : app.get_subcommands({})) command->footer(examples_of(command->get_name()));
    }

    void add_sample() {
        CLI::App* c = app.add_subcommand("sample", "make a specimen that looks like a bone and is hard like one");
        c->add_option("SPECIMEN", sample.specimen, "vertebra, femur or skull")
            ->required()
            ->check(one_of({"vertebra", "femur", "skull"}));
        c->add_option("--faces", sample.faces, "how many faces (100000)")
            ->check(number_between(1, many, "a count of faces"));
        c->add_option("--holes", sample.holes, "leave so many holes (0)")
            ->check(number_between(0, 1e6, "a count of holes"));
        c->add_option("--marks", sample.marks, "draw so many shallow dents, as a marker pen leaves them in a scan (0)")
            ->check(number_between(0, 1e6, "a count of marks"));
        c->add_option("-o,--out", sample.out, "the file to write: .ply, or .stl")->required();
        add_common(c, common);
    }

    void add_inspect() {
        CLI::App* c = app.add_subcommand("inspect", "say what a scan is and what is wrong with it");
        c->add_option("SCAN", inspect.scan, std::string(scan_formats) + "; - is standard input")->required();
        c->add_option("--units", inspect.units, "what one unit of the file is: mm, cm, m, in")
            ->check(one_of({"mm", "cm", "m", "in"}));
        c->add_flag("--deep", inspect.deep, "look for faces that run through each other too");
        add_common(c, common);
    }

    void add_scale(CLI::App* c, std::optional<double>& scale) {
        c->add_option("--scale", scale, "enlarge by this factor; recorded, and shown as a warning")
            ->check(number_between(1e-6, 1e6, "a factor above 0"));
    }

    void add_repair_choices(CLI::App* c, RepairChoiceArguments& a) {
        c->add_option("--weld", a.weld_mm, "make one point of border points that lie within so many mm (off)")
            ->check(number_between(0, many, "a length in mm"));
        c->add_option(
             "--fill", a.fill,
             "close holes flat, fair (refined, bent like the surface around), auto (small ones flat, large ones "
             "fair) or none (auto)")
            ->check(one_of({"auto", "flat", "fair", "none"}));
        c->add_flag("--smooth-marks", a.smooth_marks,
                    "lift the shallow lines that a marker pen leaves in a laser scan");
        c->add_option("--wrap", a.wrap_mm,
                      "last resort: wrap the scan with a ball of so many mm, which keeps no point of it (off)")
            ->check(number_between(0, many, "a length in mm"));
    }

    void add_repair() {
        CLI::App* c = app.add_subcommand("repair", "make a closed solid of a scan and say what that took");
        c->add_option("SCAN", repair.scan, std::string(scan_formats) + "; - is standard input")->required();
        c->add_option("-o,--out", repair.out, "the file to write: .ply, which keeps every bit, or .stl")->required();
        c->add_option("--units", repair.units, "what one unit of the file is: mm, cm, m, in")
            ->check(one_of({"mm", "cm", "m", "in"}));
        add_scale(c, repair.scale);
        add_repair_choices(c, repair);
        c->add_option("--crumbs", repair.crumbs, "solids too small to be pieces: keep or drop (keep)")
            ->check(one_of({"keep", "drop"}));
        c->add_flag("--keep-self-intersections", repair.keep_self_intersections,
                    "leave places where the scan runs through itself");
        c->add_option("--mark-width", repair.mark_width, "with --smooth-marks: the widest line, in mm (6)")
            ->check(CLI::PositiveNumber);
        c->add_option("--mark-depth", repair.mark_depth, "with --smooth-marks: the deepest, in mm (1)")
            ->check(CLI::PositiveNumber);
        c->add_option("--skip", repair.skipped, "leave steps out: faces, split, orient, stitch, no_area, outwards")
            ->delimiter(',')
            ->check(one_of({"faces", "split", "orient", "stitch", "no_area", "outwards"}));
        add_common(c, common);
    }

    void add_project_options(CLI::App* c, ProjectArguments& a) {
        add_repair_choices(c, a);
        c->add_flag("--resolve-self-intersections", a.resolve_self_intersections,
                    "mend places where the scan runs through itself; the cut copes with them");
        c->add_option("--units", a.units, "what one unit of the scan is: mm, cm, m, in")
            ->check(one_of({"mm", "cm", "m", "in"}));
        add_scale(c, a.scale);
        c->add_option("--cell", a.cell, "the cell file (docs/cell-file.md)");
        c->add_option("--preset", a.preset, "weights and stop rule by name: bunny, femur, vertebrae, skull")
            ->check(one_of({"bunny", "femur", "vertebrae", "skull"}));
        c->add_option("--min-cuts", a.min_cuts, "stop rule: make at least N cuts")
            ->check(number_between(0, 1e6, "a count of cuts"));
        c->add_option("--max-faces", a.max_faces, "stop rule: every piece has fewer than N faces")
            ->check(number_between(1, many, "a count of faces"));
        c->add_option("--max-obb", max_obb, "stop rule: every piece fits in a box of X,Y,Z mm, in some orientation")
            ->check(CLI::Validator(
                [](const std::string& text) {
                    return three_lengths(text) ? std::string() : "\"" + text + "\" is not X,Y,Z in mm";
                },
                ""));
        c->add_flag("--fits-cell", a.fits_cell,
                    "stop rule: every piece fits the cell (the default if no other is set)");
        c->add_option("--stop", a.stop, "stop when any or all of the rules hold (all)")->check(one_of({"any", "all"}));
        c->add_option("--fragility", a.fragility, "form of that objective: thinness or thesis (thinness)")
            ->check(one_of({"thinness", "thesis"}));
        c->add_option("--crumbs", a.crumbs, "solids too small to be pieces: keep or drop (keep)")
            ->check(one_of({"keep", "drop"}));
        c->add_option("--fragment-volume", a.fragment_volume_mm3,
                      "solids of less than so many mm3 are no pieces (a hundred-thousandth of the scan's volume)")
            ->check(number_between(0, many, "a volume in mm3"));
        c->add_option("--weights", a.weights,
                      "of the four terms: face_ratio=10,fragility=5,piece_count=50,undercut=10 (any of them)")
            ->check(CLI::Validator(
                [](const std::string& text) {
                    return weights_from(text) ? std::string()
                                              : "\"" + text +
                                                    "\" is not like face_ratio=10,fragility=5,piece_count=50,"
                                                    "undercut=10, nor four numbers";
                },
                ""));
        c->add_option("--beam", a.beam, "how many segmentations the search keeps (1: greedy)")
            ->check(number_between(1, 1000, "a count from 1 to 1000"));
        c->add_option("--time-limit", a.time_limit_s, "stop after so many seconds, with the decision being made")
            ->check(number_between(0, 1e9, "a number of seconds"));
    }

    void add_prepare() {
        CLI::App* c = app.add_subcommand("prepare", "the whole way: from a scan to job files");
        c->add_option("SCAN", prepare.input,
                      std::string(scan_formats) + "; or the folder NAME.qch of a project to go on with")
            ->required();
        add_project_options(c, prepare);
        c->add_option("-o,--out", prepare.out, "the project folder to make: NAME.qch");
        add_common(c, common);
    }

    void add_segment() {
        CLI::App* c = app.add_subcommand("segment", "cut a scan one decision at a time; --help lists the decisions");
        c->add_option("SCAN", segment.input,
                      std::string(scan_formats) + ", to make a project of; or the folder NAME.qch of one")
            ->required();
        add_project_options(c, segment);
        c->add_flag("--step", segment.step, "propose the best planes for the next piece; cut nothing");
        c->add_option("--top", segment.top, "how many planes to show (10)")
            ->check(number_between(1, 1e6, "a count of planes"));
        c->add_option("--accept", segment.accept, "cut by the K-th plane of that ranking")
            ->check(number_between(1, 1e6, "a place in the ranking"));
        const CLI::Validator plane(
            [](const std::string& text) {
                return plane_from(text) ? std::string() : "\"" + text + "\" is not nx,ny,nz,d";
            },
            "");
        c->add_option("--plane", segment.plane,
                      "cut by nx,ny,nz,d: a direction of any length, and the distance along it in mm, as --step shows")
            ->check(plane);
        c->add_option("--preview", segment.preview, "what K or nx,ny,nz,d would make; cuts nothing")
            ->check(CLI::Validator(
                [](const std::string& text) {
                    return plane_from(text) || place_from(text)
                               ? std::string()
                               : "\"" + text + "\" is neither a place in the ranking nor nx,ny,nz,d";
                },
                ""));
        c->add_option("--piece", segment.piece, "the piece to be cut next (the one that the rules choose)");
        c->add_option("--discard", segment.discard,
                      "leave a piece out for good: head rest, debris, table; undone alike");
        c->add_flag("--write-pieces", segment.write_pieces,
                    "write the pieces of the project folder after each decision");
        c->add_flag("--undo", segment.undo, "take the last decision back");
        c->add_flag("--redo", segment.redo, "put the decision that was taken back in force again");
        c->add_flag("--reset", segment.reset, "take all cuts back; --undo brings them again");
        c->add_flag("--auto", segment.goes_on, "let the search go on to the stop rules, given now or before");
        c->add_option("--plan", segment.plan, "write the cuts as a plan (docs/plan-file.md)");
        c->add_option("--replay", segment.replayed, "make the cuts of a plan on this scan");
        c->add_option("-o,--out", segment.out, "the project folder to make: NAME.qch");
        add_common(c, common);
    }

    void add_explain() {
        CLI::App* c =
            app.add_subcommand("explain", "say why a cut lies where it lies, with a plot of what all planes cost");
        c->add_option("PROJECT", explain.project, "the folder NAME.qch")->required();
        c->add_option("--cut", explain.cut, "the number of the cut (the last)")
            ->check(number_between(1, 1e6, "the number of a cut"));
        c->add_option("-o,--out", explain.out, "the plot to write, .svg (PROJECT/pictures/cut-K.svg)");
        add_common(c, common);
    }

    void add_export() {
        CLI::App* c = app.add_subcommand("export", "write pieces as 3MF, STL, PLY or GLB for other programs");
        c->add_option("PROJECT", exported.project, "the folder NAME.qch")->required();
        c->add_option("--format", exported.format, "3mf, stl, ply or glb")
            ->required()
            ->check(one_of({"3mf", "stl", "ply", "glb"}));
        c->add_option("--pose", exported.pose,
                      "place: as they sit in the scan; setup: as they lie in the stock (place)")
            ->check(one_of({"place", "setup"}));
        c->add_option("--piece", exported.piece, "only this piece");
        c->add_option("--simplify", exported.simplify_mm,
                      "as few faces as a deviation of so many mm allows; caps stay as they are")
            ->check(number_between(1e-9, many, "a length in mm above 0"));
        c->add_option("--max-faces", exported.max_faces, "no more than so many faces a piece; the deviation is told")
            ->check(number_between(4, many, "a count of faces from 4"));
        c->add_option("-o,--out", exported.out,
                      "the file to make, or for STL and PLY the folder (NAME.3mf, NAME-stl beside the project)");
        add_common(c, common);
    }

    void add_dry_run() {
        CLI::App* c = app.add_subcommand("dry-run", "hand every piece to a simulated cell inside, over real TCP");
        c->add_option("PROJECT", dry_run.project, "the folder NAME.qch")->required();
        c->add_option("--piece", dry_run.piece, "only this piece");
        c->add_option("--speed", dry_run.speed, "simulated seconds per second (100000)")
            ->check(number_between(1e-3, 1e9, "a factor above 0"));
        add_common(c, common);
    }

    void add_cell_sim() {
        CLI::App* c = app.add_subcommand("cell-sim", "be a simulated cell until stopped");
        c->add_option("--listen", cell_sim.listen, "HOST:PORT (127.0.0.1:15020); port 0 takes a free one");
        c->add_option("--drop", cell_sim.drop, "the folder where job files arrive")->required();
        c->add_option("--consent", cell_sim.consent, "auto, ask (on this terminal) or never (auto)")
            ->check(one_of({"auto", "ask", "never"}));
        c->add_option("--store", cell_sim.store, "the folder of the cell's lasting memory; none: it forgets");
        c->add_option("--cell", cell_sim.cell, "take id, reach and stock from this cell file");
        c->add_option("--speed", cell_sim.speed, "simulated seconds per second (1)")
            ->check(number_between(1e-3, 1e9, "a factor above 0"));
        add_common(c, common);
    }

    void add_dispatch() {
        CLI::App* c = app.add_subcommand("dispatch", "hand the jobs to the cell and follow them to their end");
        c->add_option("PROJECT", dispatch.project, "the folder NAME.qch")->required();
        c->add_option("--piece", dispatch.piece, "only this piece");
        c->add_option("--to", dispatch.to, "HOST:PORT of the cell (from the cell file)");
        c->add_option("--drop", dispatch.drop, "the folder where the cell fetches job files (from the cell file)");
        c->add_flag("--yes", dispatch.yes, "do not ask before a real cell is set in motion");
        add_common(c, common);
    }

    Arguments result() {
        if (!max_obb.empty()) prepare.max_obb = segment.max_obb = three_lengths(max_obb);
        const std::string name = app.get_subcommands().front()->get_name();
        if (name == "sample")
            common.command = sample;
        else if (name == "inspect")
            common.command = inspect;
        else if (name == "repair")
            common.command = repair;
        else if (name == "prepare")
            common.command = prepare;
        else if (name == "segment")
            common.command = segment;
        else if (name == "explain")
            common.command = explain;
        else if (name == "export")
            common.command = exported;
        else if (name == "dry-run")
            common.command = dry_run;
        else if (name == "cell-sim")
            common.command = cell_sim;
        else
            common.command = dispatch;
        return common;
    }
};

}  // namespace

std::optional<Arguments> parse_arguments(int argc, const char* const* argv) {
    Parser parser;
    try {
        parser.app.parse(argc, argv);
        return parser.result();
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) {  // help, version
            parser.app.exit(e, std::cout, std::cerr);
            return std::nullopt;
        }
        const std::string near = hint(parser.app, argc, argv);
        throw InputError(InputFault::use, near.empty() ? e.what() : near, "see qchopper --help");
    }
}

}  // namespace qchopper
