// Why this plane: replays the project up to before a cut, prices the piece again, and shows the candidates.

#include <algorithm>
#include <cmath>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/segment_project.h"
#include "app/project/project.h"
#include "app/report/columns.h"
#include "app/report/explanation.h"
#include "app/report/segment_report.h"
#include "base/file.h"
#include "segment/import/import_scan.h"
#include "segment/score/pricing.h"
#include "segment/search/search.h"

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
    Intake intake = take_in(project.scan.path, options_of(project.scan), context);
    if (to_hex(intake.sha256) != project.scan.sha256) {
        throw InputError(InputFault::mesh,
                         project.scan.path.string() + " is not the scan that the project was made from",
                         "put that scan back");
    }
    return intake;
}

// The settings as they stood when a cut that stands was decided: weights may have changed since.
SearchSettings settings_at(const Project& project, const Cut& cut) {
    SearchSettings settings = project.settings;
    Weights weights = project.history.weights_at_start;
    for (std::size_t i = 0; i < project.history.standing; ++i) {
        const Decision& decision = project.history.decisions[i];
        if (const auto* change = std::get_if<WeightsChange>(&decision)) weights = change->weights;
        // A cut before a reset may be the same; the last one is meant.
        if (const auto* made = std::get_if<Cut>(&decision); made != nullptr && *made == cut) {
            settings.objectives.weights = weights;
        }
    }
    return settings;
}

// The piece as it was before the cut, among the others.
struct Before {
    Segmentation segmentation;
    std::size_t piece = 0;
};

Before before(const Project& project, const Cut& cut, const TriangleMesh& scan) {
    Project shorter = project;
    shorter.cuts.clear();
    for (const Cut& earlier : project.cuts) {
        if (earlier.number < cut.number) shorter.cuts.push_back(earlier);
    }
    Before b{replay(shorter, scan), 0};
    const std::vector<Piece>& pieces = b.segmentation.pieces;
    while (b.piece < pieces.size() && pieces[b.piece].name != cut.piece) ++b.piece;
    if (b.piece == pieces.size()) {
        throw InputError(InputFault::config,
                         "before cut " + std::to_string(cut.number) + " there is no piece " + cut.piece,
                         "restore project.json, or prepare the scan again");
    }
    return b;
}

// The candidates along a normal of the operator's own.
std::vector<Ranked> beside(const Before& b, const Plane& own, const SearchSettings& settings, PieceBook& book,
                           const Context& context) {
    const Piece& piece = b.segmentation.pieces[b.piece];
    PiecePrices along{candidates_along(piece, own.normal, -1, settings.candidates.offsets_per_normal), {}};
    along.prices = price_all(piece, along.candidates, settings.objectives, context);
    const auto others = shares_of_others(b.segmentation, b.piece, settings.objectives, book);
    std::vector<Ranked> planes = rank(along, others, settings.objectives);
    std::sort(planes.begin(), planes.end(), [](const Ranked& x, const Ranked& y) { return x.offset < y.offset; });
    return planes;
}

Explanation explain(const Project& project, const Cut& cut, const TriangleMesh& scan, const Context& context) {
    const SearchSettings settings = settings_at(project, cut);
    const Before b = before(project, cut, scan);
    PieceBook book(settings.objectives, settings.candidates);
    Explanation e;
    e.cut = cut;
    e.objectives = settings.objectives;
    e.chosen = cut.chosen;
    e.ranked = rank(b.segmentation, b.piece, settings, book, context);
    for (std::size_t i = 0; i < e.ranked.size() && !e.place; ++i) {
        if (e.ranked[i].plane == cut.chosen.plane) e.place = i;
    }
    if (e.place) {
        e.chosen = e.ranked[*e.place];
        return e;
    }
    const Candidate own{cut.chosen.plane, cut.chosen.wanted_offset, cut.chosen.normal, cut.chosen.offset};
    const std::optional<Ranked> priced = rank_plane(b.segmentation, b.piece, own, settings, book, context);
    if (priced) e.chosen = *priced;
    e.beside = beside(b, own.plane, settings, book, context);
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
    for (const std::string& line : discarded_lines(project)) terminal.show(line);
    terminal.show(verdict(e));
    for (const std::string& line : columns(table(e))) terminal.show(line);
    terminal.show("plot: " + picture.string());
    terminal.json(document(e, project, picture.string()));
    return exit_done;
}

}  // namespace qchopper
