// Why this plane: replays the project up to before a cut, prices the piece again, and shows the candidates.

#include <algorithm>

#include "cli/columns.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/explanation.h"
#include "segment/files/file.h"
#include "segment/intake/intake.h"
#include "segment/score/pricing.h"
#include "segment/search/project.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

const Cut& cut_to_explain(const Project& project, std::optional<int> number) {
    if (project.cuts.empty()) {
        throw InputError(InputFault::use, "the project has no cuts yet", "make one, then ask again");
    }
    if (!number) return project.cuts.back();
    for (const Cut& cut : project.cuts) {
        if (cut.number == *number) return cut;
    }
    throw InputError(InputFault::use, "the project has no cut " + std::to_string(*number),
                     "its cuts are 1 to " + std::to_string(project.cuts.size()));
}

Intake intake_of(const Project& project, const Context& context) {
    IntakeOptions options;
    options.mm_per_unit = mm_per(project.scan.unit);
    options.scale = project.scan.scale;
    Intake intake = take_in(project.scan.path, options, context);
    if (to_hex(intake.sha256) != project.scan.sha256) {
        throw InputError(InputFault::mesh,
                         project.scan.path.string() + " is not the scan that the project was made from",
                         "put that scan back");
    }
    return intake;
}

// The candidates along a normal of the operator's own, and the plane itself.
void price_own(Explanation& e, const Segmentation& before, std::size_t piece, const SearchSettings& settings,
               const RayTree& rays, const Context& context) {
    const Piece& target = before.pieces[piece];
    const int number =
        1 + (e.ranked.empty()
                 ? 0
                 : std::max_element(e.ranked.begin(), e.ranked.end(), [](const Ranked& a, const Ranked& b) {
                       return a.normal < b.normal;
                   })->normal);
    std::vector<Candidate> planes =
        candidates_along(target, e.chosen.plane.normal, number, settings.candidates.offsets_per_normal);
    planes.push_back({e.chosen.plane, e.chosen.wanted_offset, number, 0});
    std::vector<PieceShare> others;
    for (std::size_t p = 0; p < before.pieces.size(); ++p) {
        if (p != piece) others.push_back(share(measure(before.pieces[p]), settings.objectives));
    }
    const auto prices = price_all(target, planes, settings.objectives, rays, context);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const std::optional<Terms> t = prices[i] ? terms(*prices[i], others, settings.objectives) : std::nullopt;
        const bool is_own = i + 1 == planes.size();
        if (t && !is_own) {
            const Candidate& c = planes[i];
            e.beside.push_back({c.plane, c.wanted_offset, c.normal, c.offset, *t});
        }
        if (t && is_own) e.chosen.terms = *t;
    }
}

Explanation explain(Project project, const Cut& cut, const TriangleMesh& scan, const Context& context) {
    Explanation e;
    e.cut = cut;
    e.chosen = cut.chosen;
    e.objectives = project.settings.objectives;
    const auto at = std::find(project.cuts.begin(), project.cuts.end(), cut);
    project.cuts.erase(at, project.cuts.end());
    const Segmentation before = replay(project, scan);
    const auto target =
        std::find_if(before.pieces.begin(), before.pieces.end(), [&](const Piece& p) { return p.name == cut.piece; });
    if (target == before.pieces.end()) {
        throw InputError(InputFault::config,
                         "before cut " + std::to_string(cut.number) + " there is no piece " + cut.piece,
                         "restore project.json, or prepare the scan again");
    }
    const auto piece = static_cast<std::size_t>(target - before.pieces.begin());
    const RayTree rays(scan);
    e.ranked = rank(before, piece, project.settings, rays, context);
    for (std::size_t i = 0; i < e.ranked.size() && !e.place; ++i) {
        if (e.ranked[i].plane == cut.chosen.plane) e.place = i;
    }
    if (e.place)
        e.chosen = e.ranked[*e.place];
    else
        price_own(e, before, piece, project.settings, rays, context);
    return e;
}

fs::path picture_path(const ExplainArguments& a, std::int32_t cut) {
    if (!a.out) return a.project / "pictures" / ("cut-" + std::to_string(cut) + ".svg");
    if (a.out->extension() != ".svg") {
        throw InputError(InputFault::use, a.out->string() + " does not end in .svg", "name a .svg file");
    }
    return *a.out;
}

}  // namespace

int run(const ExplainArguments& arguments, Terminal& terminal) {
    terminal.unchanged = "The project is unchanged.";
    const Project project = load_project(arguments.project);
    const Cut cut = cut_to_explain(project, arguments.cut);
    const fs::path picture = picture_path(arguments, cut.number);
    const Intake intake = intake_of(project, terminal.context());
    const Explanation e = explain(project, cut, intake.mesh, terminal.context());
    if (std::abs(e.chosen.terms.total - cut.chosen.terms.total) > 1e-6 * (1 + std::abs(e.chosen.terms.total))) {
        terminal.warn("cut " + std::to_string(cut.number) + " was decided at a total of " +
                      std::to_string(cut.chosen.terms.total) + ", which now comes out as " +
                      std::to_string(e.chosen.terms.total));
    }
    const fs::path name = arguments.project.has_filename() ? arguments.project : arguments.project.parent_path();
    write_file(picture, to_svg(plot(e, name.filename().string())));
    std::string made;
    for (const std::string& piece : cut.pieces) made += (made.empty() ? "" : ", ") + piece;
    terminal.show("cut " + std::to_string(cut.number) + " on piece " + cut.piece + " makes " + made +
                  (cut.crumbs > 0 ? " and " + std::to_string(cut.crumbs) + " crumbs" : ""));
    terminal.show(verdict(e));
    for (const std::string& line : columns(table(e))) terminal.show(line);
    terminal.show("plot: " + picture.string());
    terminal.json(document(e, picture.string()));
    return exit_done;
}

}  // namespace qchopper
