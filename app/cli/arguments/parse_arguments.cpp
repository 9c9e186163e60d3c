// One function per command, on the option parser CLI11.

#include <CLI/CLI.hpp>

#include <iostream>

#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/examples.h"
#include "app/cli/arguments/option_values.h"
#include "app/cli/arguments/project_options.h"
#include "app/cli/arguments/version.h"
#include "base/edit_distance.h"
#include "base/error.h"

namespace qchopper {
namespace {

constexpr const char* retry_help = "also pieces of which three attempts have failed";
constexpr std::size_t max_edits = 2;  // between a misspelt word and the one that is suggested

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) return command;
    }
    return nullptr;
}

// The name in `known` nearest to a misspelt one, as a question; empty: none is near.
std::string suggestion(const std::string& misspelt, const std::vector<std::string>& known) {
    std::string nearest;
    std::size_t least = max_edits + 1;
    for (const std::string& name : known) {
        const std::size_t edits = edit_distance(name, misspelt);
        if (edits < least) {
            least = edits;
            nearest = name;
        }
    }
    return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;  // an older name
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

InputError unknown_option(const std::string& name, const std::string& said, const CLI::App& command) {
    return {InputFault::use, name + " is no option of " + said + suggestion(name, option_names(command)),
            "see " + said + " --help"};
}

// The error for a command line with a word that is no command, or an option that its command does not have; else the
// one that says `otherwise`.
InputError unknown_word(const CLI::App& app, int argc, const char* const* argv, const std::string& otherwise) {
    const CLI::App* command = &app;
    std::string said = "qchopper";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool is_option = word.size() > 2 && word.compare(0, 2, "--") == 0;
        const std::string name = word.substr(0, word.find('='));
        if (is_option && command->get_option_no_throw(name) == nullptr) return unknown_option(name, said, *command);
        if (word[0] == '-' || command->get_subcommands({}).empty()) continue;
        const CLI::App* next = command_named(*command, word);
        if (next == nullptr) {
            std::vector<std::string> commands;
            for (const CLI::App* c : command->get_subcommands({})) commands.push_back(c->get_name());
            return {InputFault::use, "\"" + word + "\" is no command" + suggestion(word, commands),
                    "see " + said + " --help"};
        }
        command = next;
        said.append(" ").append(word);
    }
    return {InputFault::use, otherwise, "see " + said + " --help"};
}

struct Parser {
    CLI::App app{"From the scan of a bone to carving jobs for a robot cell.", "qchopper"};
    Arguments common;
    SampleArguments sample;
    FuseArguments fuse;
    InspectArguments inspect;
    RepairArguments repair;
    PrepareArguments prepare;
    SegmentArguments segment;
    ExplainArguments explain;
    GuideArguments guide;
    ExportArguments exported;
    CellsListArguments cells_list;
    CellsShowArguments cells_show;
    CellsCheckArguments cells_check;
    CellsReachArguments cells_reach;
    CellsRobotsArguments cells_robots;
    CellsNewArguments cells_new;
    SetupArguments setup;
    WorkArguments work;
    SubmitArguments submit;
    GatherArguments gather;
    VerifyArguments verify;
    std::vector<std::string> tool_lengths;  // of verify
    KeysArguments keys;
    DryRunArguments dry_run;
    CellSimArguments cell_sim;
    DispatchArguments dispatch;
    JournalArguments journal_show;
    JournalArguments journal_verify;
    JournalJobsArguments journal_jobs;
    JournalExportArguments journal_export;
    CellControlArguments cell_control;
    CellCheckArguments cell_check;
    SchemaArguments schema;
    ServeArguments console;
    ConsoleWorkerArguments console_worker;
    ConsoleMeshArguments console_mesh;
    ConsolePaintArguments console_paint;
    ConsoleReplayArguments console_replay;

    Parser() {
        app.footer(examples_of(""));
        app.require_subcommand(1);
        app.set_version_flag("--version", "qchopper " + version());
        add_sample();
        add_fuse();
        add_inspect();
        add_repair(app, repair, common);
        add_prepare(app, prepare, common);
        add_segment(app, segment, common);
        add_explain();
        add_guide();
        add_export();
        add_cells();
        add_setup();
        add_work();
        add_submit();
        add_gather();
        add_verify();
        add_keys();
        add_dry_run();
        add_cell_sim();
        add_dispatch();
        add_journal();
        add_cell();
        add_serve();
        add_schema();
        add_console_worker();
        for (CLI::App* command : app.get_subcommands({})) {
            const std::string examples = examples_of(command->get_name());
            command->footer(examples);
            for (CLI::App* inner : command->get_subcommands({})) inner->footer(examples);
        }
    }

    void add_sample() {
        CLI::App* c =
            app.add_subcommand("sample", "make a synthetic specimen: a bone with everything that makes scans hard");
        c->add_option("SPECIMEN", sample.specimen, "vertebra, femur or skull")
            ->required()
            ->check(one_of({"vertebra", "femur", "skull"}));
        c->add_option("--faces", sample.faces, "how many faces (100000)")
            ->check(number_between(1, many, "a count of faces"));
        c->add_option("--holes", sample.holes, "leave so many holes (0)")
            ->check(number_between(0, 1e6, "a count of holes"));
        const OptionCheck is_count = number_between(0, 1e6, "a count of pen grooves");
        c->add_option("--pen-grooves", sample.pen_grooves,
                      "draw so many grooves, as a marker pen leaves them in a scan (0)")
            ->check(is_count);
        c->add_option("--marks", sample.pen_grooves)->check(is_count)->group("");
        c->add_option("-o,--out", sample.out, "the file to write: .ply, or .stl")->required();
        add_common(c, common, [this] { common.command = sample; });
    }

    void add_fuse() {
        CLI::App* c = app.add_subcommand("fuse", "make one mesh of several range scans, which need not fit exactly");
        c->add_option("SCANS", fuse.list, "list of scans with their poses, as Stanford's .conf files are")->required();
        c->add_option("--voxel", fuse.voxel,
                      "edge of the cells in which scans are merged, in the unit of the scans "
                      "(the spacing of their points)")
            ->check(number_between(0, 1e6, "a length"));
        c->add_option("-o,--out", fuse.out, "the file to write: .ply, or .stl")->required();
        add_common(c, common, [this] { common.command = fuse; });
    }

    void add_inspect() {
        CLI::App* c = app.add_subcommand("inspect", "report what a scan is and what is wrong with it");
        c->add_option("SCAN", inspect.scan, scan_formats + "; - is standard input")->required();
        add_units(c, "file", inspect.units);
        c->add_flag("--deep", inspect.deep, "find faces that run through each other too");
        add_common(c, common, [this] { common.command = inspect; });
    }

    void add_explain() {
        CLI::App* c =
            app.add_subcommand("explain", "explain why a cut lies where it lies, with a plot of what all planes cost");
        add_project(c, explain.project);
        c->add_option("--cut", explain.cut, "the number of the cut (the last)")
            ->check(number_between(1, 1e6, "the number of a cut"));
        c->add_option("-o,--out", explain.out, "the plot to write, .svg (PROJECT/pictures/cut-K.svg)");
        add_common(c, common, [this] { common.command = explain; });
    }

    void add_guide() {
        CLI::App* c = app.add_subcommand("guide", "write a guide to the assembly: pictures, blocks, dowels, steps");
        add_project(c, guide.project);
        add_common(c, common, [this] { common.command = guide; });
    }

    void add_export() {
        CLI::App* c = app.add_subcommand("export", "write pieces as 3MF, STL, PLY or GLB for other programs");
        add_project(c, exported.project);
        c->add_option("--format", exported.format, "3mf, stl, ply or glb")
            ->required()
            ->check(one_of({"3mf", "stl", "ply", "glb"}));
        c->add_option("--pose", exported.pose,
                      "place: as they sit in the scan; setup: as they lie in the stock (place)")
            ->check(one_of({"place", "setup"}));
        c->add_option("--piece", exported.piece, "only this piece");
        c->add_flag("--holes", exported.holes, "cut the holes of the dowels into the pieces");
        c->add_option("--simplify", exported.simplify_mm,
                      "as few faces as a deviation of so many mm allows; caps stay as they are")
            ->check(number_between(1e-9, many, "a length in mm above 0"));
        c->add_option("--max-faces", exported.max_faces,
                      "no more than so many faces a piece; the deviation is reported")
            ->check(number_between(4, many, "a count of faces from 4"));
        const OptionCheck is_length = number_between(1e-9, many, "a length in mm above 0");
        c->add_option("--max-distance", exported.max_distance_mm,
                      "with --max-faces: refuse what moves a surface by more than so many mm (1 % of the piece's "
                      "diagonal)")
            ->check(is_length);
        c->add_option("--max-deviation", exported.max_distance_mm)->check(is_length)->group("");
        c->add_option("-o,--out", exported.out,
                      "the file to make, or for STL and PLY the folder (NAME.3mf, NAME-stl beside the project)");
        add_common(c, common, [this] { common.command = exported; });
    }

    // Not listed: for who writes a program that reads our documents (docs/developer/formats/job-folder.md), and for
    // what is made of the options, as completions.
    void add_schema() {
        CLI::App* c =
            app.add_subcommand("schema", "print the JSON schema of a document, or the table of commands")->group("");
        c->add_option("DOCUMENT", schema.document, "manifest, envelope, ticket, verdict, project or commands")
            ->required()
            ->check(one_of({"manifest", "envelope", "ticket", "verdict", "project", "commands"}));
        add_common(c, common, [this] { common.command = schema; });
    }

    void add_serve() {
        CLI::App* c = app.add_subcommand("serve", "show and decide projects in a browser on this machine");
        c->add_option("FOLDER", console.folder, "of the scans and projects, or the folder NAME.qch of a project (.)");
        c->add_option(
            "--listen", console.listen,
            "HOST:PORT (127.0.0.1:8720); port 0 takes a free one. Beyond this machine no cell is handed work");
        c->add_option("--dispatch", console.dispatch,
                      "to which cells jobs may be handed: none, simulated or real (simulated)")
            ->check(one_of({"none", "simulated", "real"}));
        CLI::Option* to =
            c->add_option("--to", console.to, "HOST:PORT of the cell (from the cell file of each project)");
        c->add_option("--drop", console.drop,
                      "with --to: the folder where that cell fetches job files; none: they go over the link")
            ->needs(to);
        c->add_flag("--open", console.opens, "open the link in the browser of this desktop");
        c->add_flag("--cell-sim", console.has_simulator,
                    "with a simulated cell, to which all jobs go and whose person answers in the page")
            ->excludes(to);
        c->add_flag("--read-only", console.is_read_only, "show, and change nothing");
        c->add_option("--host", console.hosts, "one more name under which browsers reach this server");
        c->add_option("--key-file", console.key_file,
                      "take the key of this file, which only you can read, in place of a new one");
        add_common(c, common, [this] { common.command = console; });
    }

    // Not listed: serve runs it.
    void add_console_worker() {
        CLI::App* c = app.add_subcommand("console-worker", "hold a project for serve")->group("");
        c->add_option("PROJECT", console_worker.project)->required();
        add_common(c, common, [this] { common.command = console_worker; });
        c = app.add_subcommand("console-mesh", "make what serve draws of a scan")->group("");
        c->add_option("SCAN", console_mesh.scan)->required();
        c->add_option("FOLDER", console_mesh.folder)->required();
        add_common(c, common, [this] { common.command = console_mesh; });
        c = app.add_subcommand("console-paint", "mark what was painted in the page of serve")->group("");
        c->add_option("SCAN", console_paint.scan)->required();
        c->add_option("STROKES", console_paint.strokes)->required();
        c->add_option("FOLDER", console_paint.folder)->required();
        c->add_option("--units", console_paint.units);
        add_common(c, common, [this] { common.command = console_paint; });
        c = app.add_subcommand("console-replay", "replay a job for serve")->group("");
        c->add_option("PROJECT", console_replay.project)->required();
        c->add_option("--piece", console_replay.piece)->required();
        c->add_option("--part", console_replay.part);
        add_common(c, common, [this] { common.command = console_replay; });
    }

    void add_cells() {
        CLI::App* c =
            app.add_subcommand("cells", "make, list, show and check cell files, and tell where a block can stand");
        c->require_subcommand(1);
        CLI::App* list = c->add_subcommand("list", "list the cell files of a folder");
        list->add_option("FOLDER", cells_list.folder, "where they lie (cells, or those that came with the program)");
        add_common(list, common, [this] { common.command = cells_list; });
        CLI::App* show = c->add_subcommand("show", "show what a cell file describes");
        takes_cell_name(
            show->add_option("CELL", cells_show.file, "the cell file NAME.toml, or the name of a ready cell"))
            ->required();
        show->add_option("-o,--out", cells_show.out,
                         "a picture to write, .png: what the tool tip reaches at tilts of 0, 30, 60 and 90 degrees");
        show->add_option("--drawing", cells_show.drawing, "a drawing to write, .svg: the lengths a1 to c4 of the arm");
        add_common(show, common, [this] { common.command = cells_show; });
        CLI::App* check = c->add_subcommand(
            "check", "tell what is assumed or missing in a cell file, and whether its jobs may be dispatched");
        takes_cell_name(
            check->add_option("CELL", cells_check.file, "the cell file NAME.toml, or the name of a ready cell"))
            ->required();
        check
            ->add_option("--pose", cells_check.poses,
                         "J1,...,J6=X,Y,Z,A,B,C: joints in degrees and what the controller shows for them, mm and "
                         "degrees, of the flange in the robot's base; twice or more")
            ->check(read_by(taught_pose_from, "not J1,J2,J3,J4,J5,J6=X,Y,Z,A,B,C in degrees and mm"));
        add_common(check, common, [this] { common.command = cells_check; });
        CLI::App* robots = c->add_subcommand("robots", "list the robots of which cells new makes a cell file");
        add_common(robots, common, [this] { common.command = cells_robots; });
        CLI::App* made =
            c->add_subcommand("new", "make a cell file for a robot, to be edited, and a drawing of its arm");
        made->add_option("--robot", cells_new.robot, "one of cells robots, as kr210-r2700")->required();
        made->add_option("--name", cells_new.name, "name of the cell (that of the file)");
        made->add_option("--id", cells_new.id, "CELL_ID that the controller shows on the wire (1)")
            ->check(number_between(1, 65535, "a number from 1 to 65535"));
        made->add_option("-o,--out", cells_new.out, "the cell file to write, .toml (the robot's name)");
        add_common(made, common, [this] { common.command = cells_new; });
        CLI::App* reach = c->add_subcommand(
            "reach",
            "tell where on the table a block can stand so that the machine comes to it at a tilt from all around");
        takes_cell_name(
            reach->add_option("CELL", cells_reach.file, "the cell file NAME.toml, or the name of a ready cell"))
            ->required();
        reach->add_option("--tilt", cells_reach.tilt_deg, "of the tool from the vertical, degrees")
            ->required()
            ->check(number_between(0, 90, "an angle from 0 to 90 degrees"));
        reach->add_option("--block", cells_reach.block, "its size X,Y,Z in mm (the largest block of the cell file)")
            ->check(read_by(lengths_from, "not X,Y,Z in mm"));
        add_common(reach, common, [this] { common.command = cells_reach; });
    }

    void add_setup() {
        CLI::App* c =
            app.add_subcommand("setup", "show how pieces lie and what the tool reaches, and choose otherwise");
        add_project(c, setup.project);
        CLI::Option* piece = c->add_option("--piece", setup.piece, "this piece, with all ways to lay it");
        CLI::Option* base = c->add_option("--base", setup.base, "lay the piece on the base of this number")
                                ->check(number_between(0, 1e6, "the number of a base"))
                                ->needs(piece);
        const OptionCheck is_count = number_between(1, 264, "a count of orientations from 1 to 264");
        CLI::Option* orientations =
            c->add_option("--orientations", setup.max_directions, "carve it in at most so many tool orientations (8)")
                ->check(is_count)
                ->needs(piece);
        CLI::Option* older = c->add_option("--directions", setup.max_directions)
                                 ->check(is_count)
                                 ->needs(piece)
                                 ->excludes(orientations)
                                 ->group("");
        CLI::Option* tools = add_tools(c, setup.tools)->needs(piece);
        c->add_flag("--auto", setup.is_free, "let the program choose again")
            ->needs(piece)
            ->excludes(base)
            ->excludes(orientations)
            ->excludes(older)
            ->excludes(tools);
        add_common(c, common, [this] { common.command = setup; });
    }

    void add_work() {
        CLI::App* c = app.add_subcommand("work",
                                         "make the robot programs of items that prepare --items wrote, beside other "
                                         "processes that make the rest; needs neither scan nor lock");
        c->add_option("INPUT", work.inputs, "the folder NAME.qch of a project with items, or items NAME.qitem")
            ->required();
        CLI::Option* shard =
            c->add_option("--shard", work.shard, "I/N: those of part I of N, from 0 to N - 1 (0/1: all)")
                ->check(read_by(shard_from, "no I/N with I from 0 to N - 1"));
        CLI::Option* status = c->add_flag("--status", work.status, "show what is made, and make nothing");
        status->excludes(shard);
        c->add_flag("--retry", work.has_retry, retry_help)->excludes(status);
        add_common(c, common, [this] { common.command = work; });
    }

    void add_submit() {
        CLI::App* c = app.add_subcommand(
            "submit",
            "hand the items of a project to Slurm: an array of work, and gather after it; again, what is missing");
        add_project(c, submit.project);
        c->add_option("--engine", submit.engine,
                      "slurm, or local: processes of one thread on this machine, then gather")
            ->check(one_of({"slurm", "local"}));
        c->add_option("--shards", submit.shards,
                      "tasks of the array (by the estimated time, a quarter of an hour each), or processes here (as "
                      "many as processors)")
            ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
        c->add_option("--memory", submit.memory_mb,
                      "MB that the processes of --engine local may take together, as estimated (four fifths of what "
                      "is free)")
            ->check(number_between(1, 1e9, "a number of MB from 1"));
        c->add_flag("--retry", submit.has_retry, retry_help);
        c->add_flag("--print", submit.is_only_written, "only write NAME.qch/work/slurm.sh");
        c->add_option("OPTIONS", submit.options, "after --: options of sbatch, such as -- --partition=fast");
        add_common(c, common, [this] { common.command = submit; });
    }

    void add_gather() {
        CLI::App* c =
            app.add_subcommand("gather", "check the programs that work has made, and write the jobs with them");
        add_project(c, gather.project);
        c->add_flag("--make-missing", gather.make_missing,
                    "change here what the arm refuses, and make programs that are missing or damaged");
        add_common(c, common, [this] { common.command = gather; });
    }

    void add_verify() {
        CLI::App* c = app.add_subcommand(
            "verify", "read the robot programs of jobs back, replay them in foam, and write the verdict beside each");
        c->add_option("JOB", verify.input, "a job file NAME.qjob, or the folder NAME.qch of a project")->required();
        takes_cell_name(c->add_option("--cell", verify.cell,
                                      "the cell file of a job file (cell.toml of the project that it lies in)"));
        c->add_option("--piece", verify.piece, "of a project only this piece");
        c->add_option_function<std::string>(
             "--base", [this](const std::string& text) { verify.entered.base = base_from(text); },
             "X,Y,Z,A,B,C: the base that is entered at the controller in place of the planned one, mm and degrees; no "
             "verdict is written")
            ->check(read_by(base_from, "no X,Y,Z,A,B,C: three lengths in mm and three angles in degrees"));
        c->add_option("--tool", tool_lengths,
                      "N=LENGTH: the length of tool N from the spindle nose to the tip that is entered, mm; once for "
                      "each tool")
            ->allow_extra_args(false)
            ->check(read_by(tool_length_from, "no N=LENGTH: the number of a tool and its length in mm"));
        add_list(c, verify.trusted);
        add_common(c, common, [this] {
            for (const std::string& text : tool_lengths) verify.entered.lengths.push_back(*tool_length_from(text));
            common.command = verify;
        });
    }

    static void add_list(CLI::App* c, std::optional<std::filesystem::path>& list) {
        c->add_option("--keys", list, "the list of trusted keys (that of this user)");
    }

    static void add_passphrase(CLI::App* c, std::optional<int>& fd) {
        c->add_option("--passphrase-fd", fd,
                      "read the passphrase as one line from this file descriptor (it is asked for on the terminal)")
            ->check(CLI::Range(0, 1'000'000));
    }

    static CLI::Option* add_signing(CLI::App* c, SigningArguments& signing, const char* about) {
        CLI::Option* key = c->add_option("--key", signing.key, about);
        add_passphrase(c, signing.passphrase_fd);
        return key;
    }

    CLI::App* add_keys_command(CLI::App* keys_app, const std::string& word, const char* about) {
        CLI::App* c = keys_app->add_subcommand(word, about);
        add_common(c, common, [this, word] {
            keys.action = word;
            common.command = keys;
        });
        return c;
    }

    void add_keys() {
        CLI::App* c =
            app.add_subcommand("keys", "make, trust and revoke the keys by which jobs and tickets are signed");
        c->require_subcommand(1);
        CLI::App* make = add_keys_command(c, "make", "make a private key of this user, and trust it on this computer");
        make->add_option("NAME", keys.key, "its name, or a path outside of projects")->required();
        add_passphrase(make, keys.passphrase_fd);
        make->add_flag("--no-passphrase", keys.no_passphrase, "for a computer that nobody else can use");
        add_list(make, keys.list);
        add_list(add_keys_command(c, "show", "show trusted and revoked keys, and the private keys of this user"),
                 keys.list);
        CLI::App* trust = add_keys_command(c, "trust", "trust a public key on this computer");
        trust->add_option("FILE", keys.key, "the public key NAME.pub that keys make has written")->required();
        trust->add_option("--name", keys.name, "whose key it is (the name of the file)");
        add_list(trust, keys.list);
        CLI::App* revoke = add_keys_command(c, "revoke", "refuse what a key has signed, from now on and for good");
        revoke->add_option("KEY", keys.key, "its name or its id")->required();
        add_list(revoke, keys.list);
        CLI::App* sign = add_keys_command(c, "sign", "write the signature file beside each job");
        sign->add_option("INPUT", keys.inputs, "a job file NAME.qjob, or the folder NAME.qch of a project")
            ->required()
            ->expected(1);
        add_signing(sign, keys.signing, "the private key: its name, or its file")->required();
        CLI::App* check = add_keys_command(c, "check", "check the signature files beside jobs, without a replay");
        check->add_option("JOB", keys.inputs, "job files NAME.qjob")->required();
        check->add_option("--cell-id", keys.cell_id, "the id of the cell they are for (the one that each job names)")
            ->check(CLI::Range(1, 65535));
        add_list(check, keys.list);
    }

    void add_dry_run() {
        CLI::App* c = app.add_subcommand("dry-run", "hand every piece to a simulated cell inside, over real TCP");
        add_project(c, dry_run.project);
        c->add_option("--piece", dry_run.piece, "only this piece");
        c->add_option("--speed", dry_run.speed, "simulated seconds per second (100000)")
            ->check(number_between(1e-3, 1e9, "a factor above 0"));
        add_common(c, common, [this] { common.command = dry_run; });
    }

    void add_cell_sim() {
        CLI::App* c = app.add_subcommand("cell-sim", "run a simulated cell until stopped");
        c->add_option("--listen", cell_sim.listen, "HOST:PORT (127.0.0.1:15020); port 0 takes a free one");
        c->add_option("--allow", cell_sim.allow,
                      "ADDRESS,...: the numeric addresses that may connect, besides 127.0.0.1; needed to listen on any "
                      "other address")
            ->delimiter(',');
        c->add_option("--drop", cell_sim.drop, "the folder where job files arrive");
        c->add_option("--consent", cell_sim.consent, "auto, ask (on this terminal) or never (auto)")
            ->check(one_of({"auto", "ask", "never"}));
        c->add_option("--store", cell_sim.store, "the folder of the cell's lasting memory; none: a temporary one");
        takes_cell_name(c->add_option("--cell", cell_sim.cell, "take id, reach and stock from this cell file"));
        c->add_option("--speed", cell_sim.speed, "simulated seconds per second (1)")
            ->check(number_between(1e-3, 1e9, "a factor above 0"));
        c->add_option("--keys", cell_sim.trusted,
                      "the list of keys that it trusts, read again for each job (none: it checks no signature)");
        c->add_option("--script", cell_sim.script, "perform the commands of this file; standard input takes the same");
        c->add_option("--picture", cell_sim.picture,
                      "when the cell ends, write a PNG of the block as its last job has carved it; needs --cell");
        c->add_flag("--list-faults", cell_sim.list_faults, "list the faults that a script can order, and end");
        add_common(c, common, [this] { common.command = cell_sim; });
    }

    void add_dispatch() {
        CLI::App* c = app.add_subcommand("dispatch", "hand the jobs to the cell and follow them to their end");
        add_project(c, dispatch.project);
        c->add_option("--piece", dispatch.piece, "only this piece");
        c->add_option("--from-chunk", dispatch.from_chunk,
                      "restart the job of the piece that was stopped, from the chunk of this number, in the same "
                      "block: that of the program file in which the machine stood, qc_3f09a2_7_012 is 12")
            ->check(number_between(2, 65535, "the number of a chunk but the first"))
            ->needs("--piece");
        c->add_option_function<std::string>(
             "--job", [this](const std::string& digits) { dispatch.job = sha256_from_hex(digits); },
             "only the job file of this SHA-256, as the project records it")
            ->check(read_by(sha256_from_hex, "no SHA-256, which has 64 hexadecimal digits"));
        c->add_option_function<std::string>(
             "--expect", [this](const std::string& kind) { dispatch.expects_simulated = kind == "simulated"; },
             "send nothing unless the cell that answers is one of this kind: real or simulated (any)")
            ->check(one_of({"real", "simulated"}));
        c->add_option("--to", dispatch.to, "HOST:PORT of the cell (from the cell file)");
        c->add_option("--drop", dispatch.drop, "the folder where the cell fetches job files (from the cell file)");
        c->add_flag("--yes", dispatch.is_confirmed, "do not ask before a real cell is set in motion");
        c->add_flag("--accept-unreachable", dispatch.accept_unreachable,
                    "send jobs too of which the tool does not reach more of the surface than the limit allows");
        c->add_flag("--accept-workholding", dispatch.accept_workholding,
                    "do not ask before jobs of pieces that tape, glue and their own foam do not hold safely");
        c->add_flag("--again", dispatch.again, "carve files too that the cell has carved before");
        c->add_flag("--chunks", dispatch.chunks, "send job files over the link, without a drop folder");
        c->add_flag("--rehearse", dispatch.rehearse,
                    "let the cell rehearse each job, without motion, before it asks for consent");
        add_signing(c, dispatch.signing, "the private key that signs the tickets: its name, or its file");
        add_list(c, dispatch.trusted);
        c->add_option("--take-over", dispatch.takeover_code,
                      "end the lease of another dispatcher by the code shown at the cell's panel")
            ->check(number_between(1, 4294967295.0, "a code"));
        add_common(c, common, [this] { common.command = dispatch; });
    }

    void add_journal() {
        CLI::App* c = app.add_subcommand("journal", "show and verify what was sent to cells from this computer");
        c->require_subcommand(1);
        CLI::App* show = c->add_subcommand("show", "show the rows of a journal, which is verified");
        show->add_option("JOURNAL", journal_show.folder, "its folder, or its name in the state folder (all)");
        add_common(show, common, [this] { common.command = journal_show; });
        CLI::App* chain = c->add_subcommand("verify", "verify the hash chain of a journal");
        chain->add_option("JOURNAL", journal_verify.folder, "its folder, or its name in the state folder (all)");
        journal_verify.shows = false;
        add_common(chain, common, [this] { common.command = journal_verify; });
        add_journal_jobs(c);
        add_journal_export(c);
    }

    void add_journal_jobs(CLI::App* journal) {
        CLI::App* c = journal->add_subcommand("jobs", "list the jobs of the journals, with sums by order");
        c->add_option("JOURNAL", journal_jobs.journals, "folders, or names in the state folder (all)");
        c->add_option("--since", journal_jobs.since,
                      "only jobs of this day or time and later, and open ones: 2026-11-22, in UTC");
        CLI::Option* csv =
            c->add_flag("--csv", journal_jobs.is_csv, "comma-separated values, a line for each job, without sums");
        add_common(c, common, [this] { common.command = journal_jobs; });
        csv->excludes("--json");
    }

    void add_journal_export(CLI::App* journal) {
        CLI::App* c = journal->add_subcommand(
            "export", "move the rows of closed jobs to a journal of their own; the chain goes on from there");
        c->add_option("JOURNAL", journal_export.journal, "its folder, or its name in the state folder")->required();
        c->add_option("--before", journal_export.before,
                      "jobs whose last row is older than this day or time: 2026-11-22, in UTC")
            ->required();
        c->add_option("-o,--out", journal_export.out, "the folder to make")->required();
        add_common(c, common, [this] { common.command = journal_export; });
    }

    void add_cell() {
        CLI::App* c = app.add_subcommand("cell", "show the status of a cell, and command it outside of a dispatch");
        c->require_subcommand(1);
        constexpr const char* commands[][2] = {
            {"status", "show what the cell says of itself"},
            {"hold", "hold the running job; works beside a dispatch"},
            {"unhold", "let a held job go on, after consent at the cell"},
            {"stop", "stop the running job for good; works beside a dispatch; this is no emergency stop"},
            {"abort", "abort whatever the cell does; works beside a dispatch; this is no emergency stop"},
            {"clear", "clear an aborted cell, after consent at the cell"},
            {"reset", "bring a stopped cell, or one that has completed a job, to idle"},
            {"take-over", "end the lease of another dispatcher, by the code shown at the cell's panel"},
            {"accept-store", "accept that the cell lost its memory, after a look at the cell"},
        };
        for (const auto& [word, what] : commands) {
            CLI::App* one = c->add_subcommand(word, what);
            one->add_option("--to", cell_control.to, "HOST:PORT of the cell");
            takes_cell_name(one->add_option("--cell", cell_control.cell, "take address and id from this cell file"));
            const std::string action = word;
            if (action == "take-over") {
                one->add_option("--code", cell_control.code, "the code shown at the cell's panel")
                    ->required()
                    ->check(number_between(1, 4294967295.0, "a code"));
            }
            if (action == "accept-store") one->add_flag("--yes", cell_control.yes, "do not ask before it is accepted");
            add_common(one, common, [this, action] {
                cell_control.action = action;
                common.command = cell_control;
            });
        }
        CLI::App* check = c->add_subcommand(
            "check", "take the controller of an integrator through the handshake and say what deviates; never starts");
        check->add_option("HOST:PORT", cell_check.to, "of the cell")->required();
        check->add_flag("--yes", cell_check.yes, "do not ask before Clear, Reset and PREPARE");
        add_common(check, common, [this] { common.command = cell_check; });
    }
};

OptionRow row_of(const CLI::Option& option) {
    OptionRow row;
    for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
    if (option.get_positional()) row.names.push_back(option.get_name());
    row.about = option.get_description();
    row.takes_value = option.get_items_expected_max() > 0;
    row.is_required = option.get_required();
    return row;
}

// Adds the rows of the listed commands below `command`, whose words are `said`.
void add_rows(std::vector<CommandRow>& rows, const CLI::App& command, const std::string& said) {
    for (const CLI::App* sub : command.get_subcommands({})) {
        if (sub->get_group().empty()) continue;
        CommandRow row;
        row.command = said + (said.empty() ? "" : " ") + sub->get_name();
        row.about = sub->get_description();
        for (const CLI::Option* option : sub->get_options()) {
            if (!option->get_positional() && option->get_group().empty()) continue;  // an older name
            (option->get_positional() ? row.arguments : row.options).push_back(row_of(*option));
        }
        rows.push_back(row);
        add_rows(rows, *sub, row.command);
    }
}

}  // namespace

std::vector<CommandRow> command_table() {
    const Parser parser;
    std::vector<CommandRow> rows;
    add_rows(rows, parser.app, "");
    return rows;
}

std::optional<Arguments> parse_arguments(int argc, const char* const* argv) {
    Parser parser;
    try {
        parser.app.parse(argc, argv);
        return parser.common;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) {  // help, version
            parser.app.exit(e, std::cout, std::cerr);
            return std::nullopt;
        }
        throw unknown_word(parser.app, argc, argv, e.what());
    }
}

}  // namespace qchopper
