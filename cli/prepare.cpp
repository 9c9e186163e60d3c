// From a scan to job files: takes it in, cuts it, sets every piece up, writes pieces, jobs and pictures.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cam/job/job.h"
#include "cam/job/text.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/prepare_report.h"
#include "cli/version.h"
#include "segment/intake/inspect.h"
#include "segment/intake/intake.h"
#include "segment/intake/write_ply.h"
#include "segment/picture/exploded.h"
#include "segment/search/presets.h"
#include "segment/search/project.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double crumb_share = 1e-5;  // of the scan's volume

SearchSettings settings_of(const PrepareArguments& a, double scan_volume_mm3) {
    SearchSettings settings = a.preset ? *preset(*a.preset) : SearchSettings{};
    if (a.min_cuts || a.max_faces || a.max_obb || a.fits_cell) settings.stop = {};  // own rules replace the preset's
    settings.stop.min_cuts = a.min_cuts ? a.min_cuts : settings.stop.min_cuts;
    settings.stop.max_faces = a.max_faces ? a.max_faces : settings.stop.max_faces;
    settings.stop.max_obb = a.max_obb ? a.max_obb : settings.stop.max_obb;
    settings.stop.fits_cell = a.fits_cell || !settings.stop.is_any_set();
    if (a.stop) settings.stop.combine = *a.stop == "any" ? Stop::any : Stop::all;
    if (a.fragility) {
        settings.objectives.fragility_form = *a.fragility == "thesis" ? FragilityForm::thesis : FragilityForm::thinness;
    }
    settings.objectives.crumb_volume_mm3 = crumb_share * scan_volume_mm3;
    return settings;
}

// Options that a new project needs, and that an old one has already.
void check_options(const PrepareArguments& a, bool is_project) {
    const auto fail = [](const std::string& what, const std::string& to_do) {
        throw InputError(InputFault::use, what, to_do);
    };
    if (is_project) {
        const bool has_any = a.units || a.scale || a.cell || a.preset || a.min_cuts || a.max_faces || a.max_obb ||
                             a.fits_cell || a.stop || a.fragility || a.crumbs || a.out;
        if (has_any) {
            fail(a.input.string() + " is a project: its settings were fixed when it was made",
                 "leave the options out to go on with it, or prepare the scan again");
        }
        return;
    }
    if (!a.units) fail("the scan has no unit", "say --units mm, cm, m or in");
    if (!a.cell) fail("no cell is named", "say --cell FILE, for example cells/foam-1.toml");
    if (!a.out) fail("no project folder is named", "say -o NAME.qch");
}

void check_output(const fs::path& out) {
    std::error_code error;
    if (fs::exists(out, error)) {
        throw InputError(InputFault::create, out.string() + " exists already",
                         fs::exists(out / "project.json", error)
                             ? "go on with it by: qchopper prepare " + out.string() + ", or choose another name"
                             : "choose another name");
    }
    const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, error)) {
        throw InputError(InputFault::create, out.string() + " cannot be made: there is no folder " + parent.string(),
                         "make that folder first");
    }
    if (::access(parent.c_str(), W_OK) != 0) {
        throw InputError(InputFault::create,
                         out.string() + " cannot be made: " + parent.string() + " cannot be written",
                         "choose another place");
    }
}

// The folder appears whole or not at all.
void create_project(const fs::path& folder, const Project& project, const Bytes& cell_file) {
    const fs::path aside = folder.string() + ".tmp." + std::to_string(::getpid());
    std::error_code ignored;
    try {
        fs::create_directories(aside / "pieces");
        fs::create_directory(aside / "jobs");
        fs::create_directory(aside / "pictures");
        write_file(aside / "cell.toml", cell_file);
        save_project(aside, project);
        fs::rename(aside, folder);
    } catch (const fs::filesystem_error& e) {
        fs::remove_all(aside, ignored);
        throw InputError(InputFault::create, folder.string() + " cannot be made: " + e.code().message(),
                         "choose another place");
    } catch (...) {
        fs::remove_all(aside, ignored);
        throw;
    }
}

IntakeOptions intake_options(Unit unit, double scale) {
    IntakeOptions options;
    options.mm_per_unit = mm_per(unit);
    options.scale = scale;
    return options;
}

void tell_intake(const std::string& name, const Intake& intake, Terminal& terminal) {
    const IntakeReport& r = intake.report;
    std::string line = name + ": " + with_commas(intake.mesh.triangles.size()) + " faces, " +
                       size_in_words(bounds(intake.mesh).size()) + ".";
    if (r.holes_filled > 0) line += " " + with_commas(r.holes_filled) + " holes closed.";
    if (r.collapsed_dropped > 0) line += " " + with_commas(r.collapsed_dropped) + " collapsed faces dropped.";
    if (r.pinched_split > 0) line += " " + with_commas(r.pinched_split) + " pinched points split.";
    if (r.shells_turned > 0) line += " " + with_commas(r.shells_turned) + " shells turned outwards.";
    terminal.say(line);
}

std::string cut_line(const Cut& cut) {
    const Terms& t = cut.chosen.terms;
    std::string made;
    for (const std::string& name : cut.pieces) made += (made.empty() ? "" : ", ") + name;
    return "cut " + std::to_string(cut.number) + " on piece " + cut.piece + ": best of " +
           std::to_string(cut.candidates) + " planes, total " + fixed(t.total, 3) + " (face ratio " +
           fixed(t.face_ratio, 2) + ", fragility " + fixed(t.fragility, 3) + ", piece count " +
           fixed(t.piece_count, 0) + ", undercut " + fixed(t.undercut, 3) + "); makes " + made +
           (cut.crumbs > 0 ? " and " + std::to_string(cut.crumbs) + " crumbs" : "");
}

// How every piece would be carved; asked by the stop rule and again for the jobs.
class Setups {
 public:
    explicit Setups(const Cell& cell) : cell_(cell) {}
    const Carving& of(const Piece& piece) {
        const auto [it, is_new] = known_.try_emplace(piece.mesh.get());
        if (is_new) {
            it->second.setup = choose_setup(piece, cell_);
            it->second.envelope = check_envelope(it->second.setup, cell_);
            it->second.keeps_alive = piece.mesh;
        }
        return it->second;
    }

 private:
    const Cell& cell_;
    std::map<const TriangleMesh*, Carving> known_;
};

// First 16 bytes of a SHA-256 over the scan and the decisions: the same cuts of the same scan, the same id.
Uuid project_id(const Project& project) {
    std::string text = project.scan.sha256;
    char line[128];
    for (const Cut& cut : project.cuts) {
        const Plane& p = cut.chosen.plane;
        std::snprintf(line, sizeof line, "\n%s %a %a %a %a", cut.piece.c_str(), p.normal.x, p.normal.y, p.normal.z,
                      p.offset);
        text += line;
    }
    std::snprintf(line, sizeof line, "\n%a %s", project.scan.scale, name_of(project.scan.unit).c_str());
    text += line;
    const Sha256 digest = sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    Uuid id{};
    std::copy_n(digest.begin(), id.size(), id.begin());
    return id;
}

// The rest of the way once the scan is in. Every decision is saved before the next is thought about.
class Preparation {
 public:
    Preparation(fs::path folder, Project& project, Intake intake, const Cell& cell, Terminal& terminal)
        : folder_(std::move(folder)),
          project_(project),
          intake_(std::move(intake)),
          cell_(cell),
          setups_(cell),
          terminal_(terminal) {}

    PreparedProject run() {
        segmentation_ = replay(project_, intake_.mesh);
        keep_words();
        if (segmentation_.pieces.empty()) {
            throw InputError(InputFault::mesh, project_.scan.path.string() + " holds nothing but crumbs",
                             "check the scan");
        }
        if (project_.stage == Stage::cutting) make_cuts();
        write_pieces();
        write_jobs();
        write_pictures();
        project_.stage = Stage::done;
        save_project(folder_, project_);
        result_.folder = folder_;
        result_.project = project_;
        return result_;
    }

 private:
    void make_cuts() {
        const RayTree rays(intake_.mesh);
        const FitsCell fits = [&](const Piece& piece) { return setups_.of(piece).envelope.fits(); };
        const auto save = [&](const Segmentation& s) {
            record(project_, s);
            save_project(folder_, project_);
            keep_words();
            terminal_.say(cut_line(s.cuts.back()));
        };
        const SearchEnd end = search(segmentation_, project_.settings, rays, fits, save, terminal_.context());
        project_.ended_because = end.reason;
        for (const std::string& warning : segmentation_.warnings) {
            terminal_.warn(warning);
            project_.warnings.push_back(warning);
        }
        if (!end.is_finished) {
            result_.rules_hold = false;
            project_.warnings.push_back("the stop rules do not hold: " + end.reason);
            terminal_.warn(project_.warnings.back());
        }
        record(project_, segmentation_);
        project_.stage = Stage::cut;
        save_project(folder_, project_);
    }

    void keep_words() {
        terminal_.unchanged = "The " + std::to_string(segmentation_.cuts.size()) + " cuts made so far are kept in " +
                              folder_.string() + "; go on with: qchopper prepare " + folder_.string() + ".";
    }

    void write_pieces() {
        for (const Piece& piece : segmentation_.pieces) {
            write_file(folder_ / "pieces" / (piece.name + ".ply"), to_ply(*piece.mesh));
        }
        if (segmentation_.crumbs.empty() || project_.crumbs == CrumbChoice::drop) return;
        TriangleMesh all;
        for (const Crumb& crumb : segmentation_.crumbs) {
            const auto first = static_cast<std::uint32_t>(all.points.size());
            all.points.insert(all.points.end(), crumb.mesh->points.begin(), crumb.mesh->points.end());
            for (std::size_t t = 0; t < crumb.mesh->triangles.size(); ++t) {
                const Triangle& v = crumb.mesh->triangles[t];
                all.triangles.push_back({v[0] + first, v[1] + first, v[2] + first});
                all.cap_of.push_back(cap_of(*crumb.mesh, t));
            }
        }
        write_file(folder_ / "pieces" / "crumbs.ply", to_ply(all));
    }

    void write_jobs() {
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
            PreparedPiece row;
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
                write_file(file, job_file(input));
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
    Segmentation segmentation_;
    PreparedProject result_;
};

int report(const PreparedProject& prepared, const Cell& cell, Terminal& terminal) {
    for (const std::string& line : table(prepared, cell)) terminal.show(line);
    terminal.json(document(prepared, cell));
    return prepared.rules_hold && prepared.all_fit() ? exit_done : exit_demand_broken;
}

int start(const PrepareArguments& a, Terminal& terminal) {
    const fs::path out = a.out->has_filename() ? *a.out : a.out->parent_path();  // NAME.qch/ is NAME.qch
    check_output(out);
    const Cell cell = read_cell(*a.cell);
    const Bytes cell_file = read_file(*a.cell);
    Project project;
    project.scan.path = fs::absolute(a.input);
    project.scan.unit = unit_named(*a.units);
    project.scan.scale = a.scale.value_or(1);
    Intake intake = take_in(a.input, intake_options(project.scan.unit, project.scan.scale), terminal.context());
    tell_intake(a.input.filename().string(), intake, terminal);
    for (const std::string& warning : intake.report.warnings) terminal.warn(warning);
    project.scan.sha256 = to_hex(intake.sha256);
    project.scan.centre = intake.centre;
    project.scan.faces = intake.mesh.triangles.size();
    project.scan.volume_mm3 = volume_mm3(intake.mesh);
    project.preset = a.preset.value_or("");
    project.settings = settings_of(a, project.scan.volume_mm3);
    project.crumbs = a.crumbs && *a.crumbs == "drop" ? CrumbChoice::drop : CrumbChoice::keep;
    project.warnings = intake.report.warnings;
    create_project(out, project, cell_file);
    const ProjectLock lock(out);
    return report(Preparation(out, project, std::move(intake), cell, terminal).run(), cell, terminal);
}

// A program that was killed while it wrote may have left files with names like A.ply.tmp.4711. Whoever holds the lock
// knows that nobody writes them any more.
void clear_leftovers(const fs::path& folder) {
    std::vector<fs::path> left;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().filename().string().find(".tmp.") != std::string::npos) left.push_back(entry.path());
    }
    for (const fs::path& file : left) fs::remove(file);
}

int go_on(const fs::path& folder, Terminal& terminal) {
    const ProjectLock lock(folder);
    Project project = load_project(folder);
    clear_leftovers(folder);
    const Cell cell = read_cell(folder / "cell.toml");
    terminal.unchanged = "The project is unchanged.";
    Intake intake =
        take_in(project.scan.path, intake_options(project.scan.unit, project.scan.scale), terminal.context());
    if (to_hex(intake.sha256) != project.scan.sha256) {
        throw InputError(InputFault::mesh,
                         project.scan.path.string() + " is not the scan that the project was made from",
                         "put that scan back, or prepare this one as a new project");
    }
    tell_intake(project.scan.path.filename().string(), intake, terminal);
    terminal.say(folder.string() + ": goes on after " + std::to_string(project.cuts.size()) + " cuts");
    return report(Preparation(folder, project, std::move(intake), cell, terminal).run(), cell, terminal);
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
    return go_on(arguments.input.has_filename() ? arguments.input : arguments.input.parent_path(), terminal);
}

}  // namespace qchopper
