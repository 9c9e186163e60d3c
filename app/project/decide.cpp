#include "app/project/decide.h"

#include <array>
#include <cstdio>

#include "app/project/replay_plan.h"
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
    Deciding(OpenProject& project, const ProjectRequest& request, const Context& context, SegmentAnswer answer)
        : project_(project),
          request_(request),
          fits_cell_(project.fits_cell()),
          context_(context),
          answer_(std::move(answer)) {}

    SegmentAnswer answer(const SearchListener& listener) {
        if (request_.discard) discard_piece();
        if (request_.undo || request_.redo) go_back_or_forth();
        if (request_.reset) reset();
        if (request_.propose) answer_.proposal = propose();
        if (request_.accept) accept();
        if (request_.plane) cut_by_plane();
        if (request_.preview) preview();
        if (request_.plan) write_plan();
        if (request_.search) search(*request_.search, listener);
        return std::move(answer_);
    }

 private:
    void refuse(const std::string& why) {
        answer_.notes.push_back(why);
        answer_.is_demand_met = false;
    }

    void go_back_or_forth() {
        const std::optional<Decision> decision = request_.undo ? project_.undo() : project_.redo();
        if (!decision) return refuse(request_.undo ? "There is nothing to undo." : "There is nothing to redo.");
        answer_.done = (request_.undo ? "Undo " : "Redo ") + words(*decision) + ": done.";
    }

    void reset() {
        if (!project_.decide_reset()) return refuse("There is no cut to take back.");
        answer_.done = "All cuts and discarded pieces are taken back; --undo brings them again.";
    }

    void discard_piece() {
        const std::size_t p = piece_named(*request_.discard);
        const std::string name = project_.segmentation().pieces[p].name;
        if (!project_.decide_discard(name)) {
            return refuse("Piece " + name + " is the only one, nothing would be left. Nothing was discarded.");
        }
        answer_.warnings.push_back(project_.segmentation().warnings.back());
        answer_.done = "Piece " + name + " is discarded; --undo brings it again.";
    }

    std::size_t piece_named(const std::string& name) {
        if (const auto named = project_.piece_named(name)) return *named;
        std::string names;
        for (const Piece& p : project_.segmentation().pieces) names += (names.empty() ? "" : ", ") + p.name;
        throw InputError(InputFault::use, "there is no piece " + name + " now", "the pieces are " + names);
    }

    std::size_t piece() {
        if (request_.piece) return piece_named(*request_.piece);
        const OpenProject::Next next = project_.next(fits_cell_);
        if (!next.piece) {
            throw InputError(InputFault::mesh, "the scan holds nothing but fragments",
                             "check the scan, or make the project again with a smaller --fragment-volume");
        }
        rules_hold_ = next.rules_hold;
        return *next.piece;
    }

    Proposal propose() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        Proposal proposal{
            target.name, target.mesh->triangles.size(), rules_hold_, project_.ranking(p, context_), request_.top, {}};
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
        const std::vector<Ranked> ranked = project_.ranking(p, context_);
        place(ranked, *request_.accept);
        cut(p, ranked, *request_.accept - 1);
    }

    void cut_by_plane() {
        const std::size_t p = piece();
        const Plane plane = *request_.plane;
        const std::optional<Ranked> own = project_.own_plane(p, plane, context_);
        if (!own) return tell_why_not(p, plane);
        cut(p, {*own}, 0);
    }

    void tell_why_not(std::size_t p, const Plane& plane) {
        const Piece& target = project_.segmentation().pieces[p];
        const Extent range = extent(*target.mesh, plane.normal);
        const double limit = project_.project().settings.objectives.fragment_volume_mm3;
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
                          ", although its evaluation says so: the scan runs through itself there. Nothing was cut.");
        }
        const std::vector<std::string>& warnings = project_.segmentation().warnings;
        for (std::size_t i = warned; i < warnings.size(); ++i) answer_.warnings.push_back(warnings[i]);
        answer_.done = cut_line(project_.segmentation().cuts.back());
    }

    void preview() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        Preview preview;
        preview.piece = target.name;
        if (const auto* k = std::get_if<std::size_t>(&*request_.preview)) {
            preview.plane = place(project_.ranking(p, context_), *k);
        } else {
            const Plane plane = std::get<Plane>(*request_.preview);
            const auto own = project_.own_plane(p, plane, context_);
            if (!own) return tell_why_not(p, plane);
            preview.plane = *own;
        }
        const Ranked& r = preview.plane;
        const Candidate candidate{r.plane, r.wanted_offset, r.normal, r.offset};
        preview.solids = project_.book().evaluation_of(target, candidate, context_)->solids;
        preview.outline = outline(*target.mesh, r.plane);
        preview.sections_cross = crossing_regions(*target.mesh, r.plane) > 0;
        answer_.preview = std::move(preview);
    }

    void write_plan() {
        std::error_code error;
        if (fs::exists(*request_.plan, error)) {
            const Bytes old =
                fs::is_regular_file(*request_.plan, error) ? read_file(*request_.plan, record_limit) : Bytes{};
            if (!looks_like_a_plan({reinterpret_cast<const char*>(old.data()), old.size()})) {
                throw InputError(InputFault::create, request_.plan->string() + " exists already and is no plan",
                                 "choose another name");
            }
        }
        write_file(*request_.plan, to_text(make_plan(project_.project(), project_.scan())));
        answer_.plan = request_.plan;
    }

    StopRules rules_of(const SearchRequest& request) const {
        StopRules rules = request.rules.value_or(project_.project().settings.stop);
        rules.combine = request.combine.value_or(rules.combine);
        if (!rules.is_any_set() && fits_cell_) rules.fits_cell = true;
        if (!rules.is_any_set()) {
            throw InputError(InputFault::use, "no stop rule is set, so the search would never end",
                             "pass --min-cuts N, --max-faces N or --max-obb X,Y,Z");
        }
        if (rules.fits_cell && !fits_cell_) {
            throw InputError(InputFault::use, "the project knows no cell, so fits-cell cannot be a stop rule",
                             "name the cell: --cell FILE");
        }
        return rules;
    }

    void search(const SearchRequest& request, const SearchListener& listener) {
        project_.set_search(rules_of(request), request.beam.value_or(project_.project().settings.beam));
        if (listener.on_kept) listener.on_kept(project_.project().cuts.size());
        const auto on_round = [&](const Segmentation& best) {
            if (listener.on_kept) listener.on_kept(best.cuts.size());
            if (listener.on_round) listener.on_round(best);
        };
        const SearchEnd end = project_.search(fits_cell_, on_round, context_, request.time_limit_s);
        answer_.warnings = project_.segmentation().warnings;
        answer_.done = "The search ended: " + end.sentence + "; cost " + fixed(end.cost, 4) + ".";
        if (!end.is_finished()) refuse("The stop rules do not hold.");
        if (end.is_out_of_time()) answer_.notes.emplace_back("All cuts are kept; go on by --auto.");
    }

    OpenProject& project_;
    const ProjectRequest& request_;
    const FitsCell fits_cell_;
    const Context& context_;
    SegmentAnswer answer_;
    bool rules_hold_ = false;
};

}  // namespace

SegmentAnswer change_weights(OpenProject& project, const Weights& weights) {
    SegmentAnswer answer;
    if (project.decide_weights(weights)) {
        answer.done = "The weights are changed.";
    } else {
        answer.notes.emplace_back("These weights stand already.");
    }
    return answer;
}

SegmentAnswer decide(OpenProject& project, const ProjectRequest& request, const SearchListener& listener,
                     const Context& context, SegmentAnswer answer) {
    return Deciding(project, request, context, std::move(answer)).answer(listener);
}

SegmentAnswer make_cuts_of(const Plan& plan, OpenProject& project,
                           const std::function<void(const Segmentation&)>& on_decision, const Context& context) {
    Segmentation segmentation = project.segmentation();
    const auto keep = [&](const Segmentation& s) {
        project.adopt(s);
        on_decision(s);
    };
    const Project& p = project.project();
    const PlanReplay replay = replay_plan(plan, p.scan, segmentation, p.settings, project.book(), keep, context);
    SegmentAnswer answer;
    answer.notes = replay.notes;
    const std::string until = std::to_string(segmentation.cuts.size()) + " of " + std::to_string(plan.cuts.size());
    const std::string left_out =
        std::to_string(segmentation.discarded.size()) + " of " + std::to_string(plan.discards.size());
    answer.done = until + " cuts of the plan are made" +
                  (plan.discards.empty() ? "" : ", " + left_out + " pieces of it discarded") +
                  "; the volumes of the pieces differ by at most " + significant(100 * replay.largest_volume_off, 3) +
                  " %.";
    if (!replay.applies) {
        answer.is_demand_met = false;
        answer.notes.push_back("The plan does not apply: " + replay.why + ". " +
                               kept_cuts(segmentation.cuts.size(), project.folder()) + ".");
    }
    return answer;
}

std::string kept_cuts(std::size_t cuts, const fs::path& folder, bool is_beam) {
    return "The " + std::to_string(cuts) + " cuts " + (is_beam ? "of the best segmentation so far" : "made so far") +
           " are kept in " + folder.string();
}

}  // namespace qchopper
