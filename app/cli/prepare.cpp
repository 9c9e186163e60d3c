// From a scan to job files: takes it in, cuts it, sets every piece up, writes pieces, jobs and pictures.

#include <algorithm>
#include <cmath>
#include <map>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/ordered_job.h"
#include "app/cli/segment_project.h"
#include "app/cli/segment_setups.h"
#include "app/cli/version.h"
#include "app/project/products.h"
#include "app/report/prepare_report.h"
#include "app/report/shell_word.h"
#include "base/text.h"
#include "cam/job/job_file.h"
#include "segment/import/import_scan.h"
#include "segment/import/inspect.h"
#include "segment/picture/exploded.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Options that a new project needs, and that an old one has already.
void check_options(const PrepareArguments& a, bool is_project) {
    const auto fail = [](const std::string& what, const std::string& to_do) {
        throw InputError(InputFault::use, what, to_do);
    };
    if (is_project) {
        const bool has_any = a.units || a.scale || a.preset || a.min_cuts || a.max_faces || a.max_obb || a.fits_cell ||
                             a.stop || a.fragility || a.weights || a.beam || a.crumbs || a.fragment_volume_mm3 ||
                             a.out || is_any_given(a) || (a.cell && fs::exists(a.input / "cell.toml"));
        if (has_any) {
            fail(a.input.string() + " is a project: its settings were fixed when it was made",
                 "leave the options out to go on with it, or prepare the scan again");
        }
        return;
    }
    check_unit(a.input, a);
    if (!a.cell) fail("no cell is named", "say --cell FILE, for example cells/foam-1.toml");
    if (!a.out) fail("no project folder is named", "say -o NAME.qch");
}

// The rest of the way once the scan is in. Every decision is saved before the next is thought about.
class Preparation {
 public:
    Preparation(fs::path folder, Project& project, Intake intake, const Cell& cell, Terminal& terminal,
                std::optional<double> time_limit_s)
        : folder_(std::move(folder)),
          project_(project),
          intake_(std::move(intake)),
          cell_(cell),
          setups_(cell),
          terminal_(terminal),
          time_limit_s_(time_limit_s) {}

    PreparedProject run() {
        segmentation_ = replay(project_, intake_.mesh);
        keep_words();
        if (segmentation_.pieces.empty()) {
            throw InputError(InputFault::mesh, project_.scan.path.string() + " holds nothing but crumbs",
                             "check the scan");
        }
        result_.rules_hold = std::none_of(project_.warnings.begin(), project_.warnings.end(), [](const std::string& w) {
            return w.starts_with(rules_do_not_hold);  // said when the cutting ended
        });
        if (project_.stage == Stage::cutting) make_cuts();
        write_pieces(folder_, segmentation_, project_.crumbs);
        write_jobs();
        write_pictures();
        project_.stage = is_out_of_time_ ? Stage::cutting : Stage::done;
        save_project(folder_, project_);
        result_.folder = folder_;
        result_.project = project_;
        return result_;
    }

 private:
    void make_cuts() {
        take_away_products(folder_, project_);
        const FitsCell fits = [&](const Piece& piece) { return setups_.of(piece).envelope.fits(); };
        BeamProgress progress =
            beam_progress(project_, segmentation_, [&]() -> const TriangleMesh& { return intake_.mesh; });
        const auto save = [&](const Segmentation& s) {
            record(project_, s);
            project_.beam = progress.saved();
            save_project(folder_, project_);
            keep_words();
            terminal_.say(cut_line(s.cuts.back()));
        };
        PieceBook book(project_.settings.objectives, project_.settings.candidates);
        const SearchEnd end =
            search(segmentation_, project_.settings, book, fits, save, terminal_.context(), time_limit_s_, &progress);
        for (const std::string& warning : segmentation_.warnings) terminal_.warn(warning);
        record(project_, segmentation_);
        project_.ended_because = end.reason;
        result_.rules_hold = end.is_finished;
        if (!end.is_finished) {
            project_.warnings.push_back(rules_do_not_hold + end.reason);
            terminal_.warn(project_.warnings.back());
        }
        is_out_of_time_ = end.is_out_of_time && !end.is_finished;
        project_.beam = is_out_of_time_ ? progress.saved() : std::nullopt;
        project_.stage = is_out_of_time_ ? Stage::cutting : Stage::cut;
        save_project(folder_, project_);
    }

    void keep_words() {
        terminal_.unchanged = "The " + std::to_string(segmentation_.cuts.size()) + " cuts made so far are kept in " +
                              folder_.string() + "; go on with: qchopper prepare " + shell_word(folder_) + ".";
    }

    void write_jobs() {
        project_.jobs.clear();
        JobInput input;
        input.piece_no = 0;
        input.piece_count = static_cast<std::uint16_t>(segmentation_.pieces.size());
        input.program_version = version;
        input.project_id = project_id(project_);
        input.scan_sha256 = intake_.sha256;
        input.cell = cell_;
        input.warnings = project_.warnings;
        for (const Piece& piece : segmentation_.pieces) {
            terminal_.context().check_cancelled();
            ++input.piece_no;
            terminal_.context().progress("jobs written", input.piece_no - 1U, segmentation_.pieces.size());
            const Carving& carving = setups_.of(piece);
            PieceReport row;
            row.name = piece.name;
            row.faces = piece.mesh->triangles.size();
            row.volume_mm3 = volume_mm3(*piece.mesh);
            row.carving = carving;
            row.carving.keeps_alive.reset();
            const fs::path file = folder_ / "jobs" / job_file_name(piece.name);
            if (carving.envelope.fits()) {
                input.piece = piece;
                input.setup = carving.setup;
                input.envelope = carving.envelope;
                const Bytes bytes = job_file(input);
                write_file(file, bytes);
                project_.jobs.push_back(written_job(piece.name, bytes, input.project_id));
                row.job = file;
            } else {
                fs::remove(file);  // a job that cannot be carved must not lie around
                terminal_.warn(envelope_words(piece.name, carving.envelope) + "; it gets no job");
            }
            result_.pieces.push_back(std::move(row));
        }
    }

    void write_pictures() {
        const std::vector<Vec3> shifts = exploded_shifts(segmentation_.pieces);
        const Context context = terminal_.context();
        write_file(folder_ / "pictures" / "segmentation.png", render_png(coloured(segmentation_.pieces), {}, context));
        write_file(folder_ / "pictures" / "exploded.png",
                   render_png(coloured(segmentation_.pieces, shifts), {}, context));
    }

    fs::path folder_;
    Project& project_;
    Intake intake_;
    const Cell& cell_;
    Setups setups_;
    Terminal& terminal_;
    std::optional<double> time_limit_s_;
    Segmentation segmentation_;
    bool is_out_of_time_ = false;
    PreparedProject result_;
};

int report(const PreparedProject& prepared, const Cell& cell, Terminal& terminal) {
    for (const std::string& line : table(prepared, cell)) terminal.show(line);
    terminal.json(document(prepared, cell));
    return prepared.rules_hold && prepared.all_fit() ? exit_done : exit_demand_broken;
}

int start(const PrepareArguments& a, Terminal& terminal) {
    const fs::path out = without_slash(*a.out);
    check_output(out);
    const Cell cell = read_cell(*a.cell);
    const Bytes cell_file = read_file(*a.cell, settings_limit);
    Intake intake = take_in_scan(a.input, a, terminal);
    Project project = new_project(a.input, intake, a);
    if (!project.settings.stop.is_any_set()) project.settings.stop.fits_cell = true;
    create_project(out, project, cell_file);
    const ProjectLock lock(out);
    return report(Preparation(out, project, std::move(intake), cell, terminal, a.time_limit_s).run(), cell, terminal);
}

int go_on(const fs::path& folder, const PrepareArguments& a, Terminal& terminal) {
    const ProjectLock lock(folder);
    Project project = load_project(folder);
    clear_leftovers(folder);
    if (!fs::exists(folder / "cell.toml")) {  // segment may have made it
        if (!a.cell) {
            throw InputError(InputFault::use, folder.string() + " knows no cell yet",
                             "say --cell FILE, for example cells/foam-1.toml");
        }
        take_cell(folder, *a.cell, terminal);
    }
    const Cell cell = read_cell(folder / "cell.toml");
    terminal.unchanged = "The project is unchanged.";
    Intake intake = take_in_scan(project, terminal);
    terminal.say(folder.string() + ": goes on after " + std::to_string(project.cuts.size()) + " cuts");
    if (project.beam) terminal.say("The beam of " + std::to_string(project.beam->branches.size()) + " goes on.");
    return report(Preparation(folder, project, std::move(intake), cell, terminal, a.time_limit_s).run(), cell,
                  terminal);
}

}  // namespace

int run(const PrepareArguments& arguments, Terminal& terminal) {
    std::error_code error;
    const bool is_project = fs::is_directory(arguments.input, error);
    if (is_project && !fs::exists(arguments.input / "project.json", error)) {
        throw InputError(InputFault::missing, arguments.input.string() + " is a folder, but no project",
                         "name a scan, or a folder that prepare has made");
    }
    check_options(arguments, is_project);
    if (!is_project) return start(arguments, terminal);
    return go_on(without_slash(arguments.input), arguments, terminal);
}

}  // namespace qchopper
