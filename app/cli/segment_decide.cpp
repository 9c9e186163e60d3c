#include "app/cli/segment_decide.h"

#include <array>
#include <cstdio>

#include "app/cli/segment_project.h"
#include "app/cli/segment_values.h"
#include "app/project/plan.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

class Deciding {
 public:
    Deciding(OpenProject& project, const SegmentArguments& arguments, const FitsCell& fits_cell, Terminal& terminal)
        : project_(project), a_(arguments), fits_cell_(fits_cell), terminal_(terminal) {}

    SegmentAnswer answer() {
        if (a_.weights) change_weights();
        if (a_.discard) discard_piece();
        if (a_.undo || a_.redo) go_back_or_forth();
        if (a_.reset) reset();
        if (a_.step) answer_.proposal = propose();
        if (a_.accept) accept();
        if (a_.plane) cut_by_plane();
        if (a_.preview) preview();
        if (a_.plan) write_plan();
        if (a_.goes_on) search();
        return std::move(answer_);
    }

 private:
    void refuse(const std::string& why) {
        answer_.notes.push_back(why);
        answer_.is_demand_met = false;
    }

    void change_weights() {
        const Weights weights = weights_from(*a_.weights)->over(project_.project().settings.objectives.weights);
        if (!project_.decide_weights(weights)) {
            answer_.notes.emplace_back("These weights stand already.");
            return;
        }
        answer_.done = "The weights are changed.";
        terminal_.unchanged = "The weights are changed; the cuts are unchanged.";
    }

    void go_back_or_forth() {
        const std::optional<Decision> decision = a_.undo ? project_.undo() : project_.redo();
        if (!decision) return refuse(a_.undo ? "There is nothing to undo." : "There is nothing to redo.");
        answer_.done = (a_.undo ? "Undo " : "Redo ") + words(*decision) + ": done.";
    }

    void reset() {
        if (!project_.decide_reset()) return refuse("There is no cut to take back.");
        answer_.done = "All cuts and discarded pieces are taken back; --undo brings them again.";
    }

    void discard_piece() {
        const std::size_t p = piece_named(*a_.discard);
        const std::string name = project_.segmentation().pieces[p].name;
        if (!project_.decide_discard(name)) {
            return refuse("Piece " + name + " is the only one, nothing would be left. Nothing was discarded.");
        }
        terminal_.warn(project_.segmentation().warnings.back());
        answer_.done = "Piece " + name + " is discarded; --undo brings it again.";
    }

    std::size_t piece_named(const std::string& name) {
        if (const auto named = project_.piece_named(name)) return *named;
        std::string names;
        for (const Piece& p : project_.segmentation().pieces) names += (names.empty() ? "" : ", ") + p.name;
        throw InputError(InputFault::use, "there is no piece " + name + " now", "the pieces are " + names);
    }

    std::size_t piece() {
        if (a_.piece) return piece_named(*a_.piece);
        const OpenProject::Next next = project_.next(fits_cell_);
        if (!next.piece) {
            throw InputError(InputFault::mesh, "the scan holds nothing but crumbs",
                             "check the scan, or make the project again with a smaller --fragment-volume");
        }
        rules_hold_ = next.rules_hold;
        return *next.piece;
    }

    Proposal propose() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        Proposal proposal{target.name,         target.mesh->triangles.size(),
                          rules_hold_,         project_.ranking(p, terminal_.context()),
                          a_.top.value_or(10), {}};
        if (proposal.ranked.empty()) refuse("No plane parts piece " + target.name + ".");
        for (std::size_t k = 1; k <= std::min(proposal.top, proposal.ranked.size()); ++k) {
            if (crossing_regions(*target.mesh, proposal.ranked[k - 1].plane) > 0) proposal.crossing.push_back(k);
        }
        return proposal;
    }

    // The k-th of a ranking, from 1.
    static const Ranked& place(const std::vector<Ranked>& ranked, std::size_t k) {
        if (k > ranked.size()) {
            throw InputError(
                InputFault::use,
                "the ranking has no place " + std::to_string(k) + ", it ends at " + std::to_string(ranked.size()),
                "see it by --step");
        }
        return ranked[k - 1];
    }

    void accept() {
        const std::size_t p = piece();
        const std::vector<Ranked> ranked = project_.ranking(p, terminal_.context());
        place(ranked, *a_.accept);
        cut(p, ranked, *a_.accept - 1);
    }

    void cut_by_plane() {
        const std::size_t p = piece();
        const Plane plane = *plane_from(*a_.plane);
        const std::optional<Ranked> own = project_.own_plane(p, plane, terminal_.context());
        if (!own) return tell_why_not(p, plane);
        cut(p, {*own}, 0);
    }

    void tell_why_not(std::size_t p, const Plane& plane) {
        const Piece& target = project_.segmentation().pieces[p];
        const Extent range = extent(*target.mesh, plane.normal);
        const double limit = project_.project().settings.objectives.crumb_volume_mm3;
        const std::string why = project_.misses(p, plane)
                                    ? "misses piece " + target.name
                                    : "makes only fragments of piece " + target.name + " on one side (solids below " +
                                          fixed(limit / 1000, 6) + " ml)";
        std::array<char, 32> offset{};  // of any size
        std::snprintf(offset.data(), offset.size(), "%.9g", plane.offset);
        refuse("The plane at " + std::string(offset.data()) + " mm " + why + ", which extends from " +
               fixed(range.low, 3) + " to " + fixed(range.high, 3) + " mm along that direction. Nothing was cut.");
    }

    void cut(std::size_t p, const std::vector<Ranked>& ranked, std::size_t k) {
        const std::size_t warned = project_.segmentation().warnings.size();
        if (!project_.decide_cut(
                cut_by(project_.segmentation(), p, ranked, k, project_.project().settings.runners_up))) {
            return refuse("The plane does not part piece " + project_.segmentation().pieces[p].name +
                          ", although its price says so: the scan runs through itself there. Nothing was cut.");
        }
        const std::vector<std::string>& warnings = project_.segmentation().warnings;
        for (std::size_t i = warned; i < warnings.size(); ++i) terminal_.warn(warnings[i]);
        answer_.done = cut_line(project_.segmentation().cuts.back());
    }

    void preview() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        Preview preview;
        preview.piece = target.name;
        if (const auto k = place_from(*a_.preview)) {
            preview.plane = place(project_.ranking(p, terminal_.context()), *k);
        } else {
            const Plane plane = *plane_from(*a_.preview);
            const auto own = project_.own_plane(p, plane, terminal_.context());
            if (!own) return tell_why_not(p, plane);
            preview.plane = *own;
        }
        const Ranked& r = preview.plane;
        const Candidate candidate{r.plane, r.wanted_offset, r.normal, r.offset};
        preview.solids = project_.book().price_of(target, candidate, terminal_.context())->solids;
        preview.outline = outline(*target.mesh, r.plane);
        preview.sections_cross = crossing_regions(*target.mesh, r.plane) > 0;
        answer_.preview = std::move(preview);
    }

    void write_plan() {
        std::error_code error;
        if (fs::exists(*a_.plan, error)) {
            const Bytes old = fs::is_regular_file(*a_.plan, error) ? read_file(*a_.plan, record_limit) : Bytes{};
            if (!looks_like_a_plan({reinterpret_cast<const char*>(old.data()), old.size()})) {
                throw InputError(InputFault::create, a_.plan->string() + " exists already and is no plan",
                                 "choose another name");
            }
        }
        write_file(*a_.plan, to_text(make_plan(project_.project(), project_.scan())));
        answer_.plan = a_.plan;
    }

    void search() {
        const SearchSettings& settings = project_.project().settings;
        StopRules rules = given_rules(a_).value_or(settings.stop);
        if (a_.stop) rules.combine = *a_.stop == "any" ? Stop::any : Stop::all;
        if (!rules.is_any_set() && fits_cell_) rules.fits_cell = true;
        if (!rules.is_any_set()) {
            throw InputError(InputFault::use, "no stop rule is set, so the search would never end",
                             "say --min-cuts N, --max-faces N or --max-obb X,Y,Z");
        }
        if (rules.fits_cell && !fits_cell_) {
            throw InputError(InputFault::use, "the project knows no cell, so fits-cell cannot be a stop rule",
                             "name the cell: --cell FILE");
        }
        project_.set_search(rules, a_.beam ? static_cast<std::size_t>(*a_.beam) : settings.beam);
        const bool is_beam = project_.project().settings.beam > 1;
        const auto on_round = [&](const Segmentation& best) {
            keep_words(best.cuts.size(), is_beam);
            terminal_.say((is_beam ? "best so far: " : "") + cut_line(best.cuts.back()));
        };
        keep_words(project_.project().cuts.size(), is_beam);
        const SearchEnd end = project_.search(fits_cell_, on_round, terminal_.context(), a_.time_limit_s);
        for (const std::string& warning : project_.segmentation().warnings) terminal_.warn(warning);
        answer_.done = "The search ended: " + end.reason + "; cost " + fixed(end.cost, 4) + ".";
        if (!end.is_finished) refuse("The stop rules do not hold.");
        if (end.is_out_of_time && !end.is_finished) {
            answer_.notes.emplace_back("All cuts are kept; go on by --auto.");
        }
    }

    void keep_words(std::size_t cuts, bool is_beam) {
        terminal_.unchanged = "The " + std::to_string(cuts) + " cuts " +
                              (is_beam ? "of the best segmentation so far" : "made so far") + " are kept in " +
                              project_.folder().string() + "; go on by --auto.";
    }

    OpenProject& project_;
    const SegmentArguments& a_;
    const FitsCell& fits_cell_;
    Terminal& terminal_;
    SegmentAnswer answer_;
    bool rules_hold_ = false;
};

}  // namespace

SegmentAnswer decide(OpenProject& project, const SegmentArguments& arguments, const FitsCell& fits_cell,
                     Terminal& terminal) {
    return Deciding(project, arguments, fits_cell, terminal).answer();
}

}  // namespace qchopper
