// Each request is a few calls of OpenProject; the cost is that of ranking a piece (segment/search) or of the search.

#include "app/engine/decide.h"

#include <array>
#include <cstdio>

#include "app/engine/loop.h"
#include "app/store/plan.h"
#include "app/store/project_lines.h"
#include "app/store/replay.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/text.h"
#include "base/timings.h"
#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

Sentence go_on_by_search(const std::string& kept) {
    return Sentence::with_key("go_on_by_search", {kept}, kept + "; the search can go on.");
}

class RequestHandler {
 public:
    RequestHandler(OpenProject& project, const ProjectRequest& request, const ProjectContext& context)
        : project_(project), request_(request), checks_(project.checks()), context_(context) {}

    SegmentAnswer answer() {
        const Project before = project_.project();
        if (request_.weights) change_weights();
        if (request_.tried_weights) {
            answer_.tried_weights = request_.tried_weights->over(project_.project().settings.objectives.weights);
        }
        if (request_.discard) discard_pieces(*request_.discard);
        if (request_.undo || request_.redo) undo_or_redo();
        if (request_.reset) reset();
        if (request_.propose) answer_.proposal = propose();
        if (request_.accept) accept();
        if (request_.plane) cut_by_plane();
        if (request_.preview) preview();
        if (request_.plan) write_plan();
        if (request_.regions) answer_.regions = show_regions(project_.scan(), *request_.regions, context_);
        if (request_.search) search(*request_.search);
        tell_of_jobs(before);
        return std::move(answer_);
    }

 private:
    void refuse(const std::string& why) {
        answer_.notes.push_back(why);
        answer_.is_demand_met = false;
    }

    // What has become of jobs that were written before, and whether jobs of now came back.
    void tell_of_jobs(const Project& before) {
        const Project& now = project_.project();
        if (before.cuts == now.cuts && before.discards == now.discards) return;
        if (before.stage == Stage::done && are_outputs_kept(project_.folder(), before)) {
            const char* decision = request_.undo ? "redo" : "undo";
            answer_.notes.push_back("Kept aside: " + counted(before.jobs.size(), "job") + " with " +
                                    "pictures and sheets; " + decision + " brings them back.");
        }
        if (now.stage == Stage::done) answer_.notes.push_back(counted(now.jobs.size(), "job") + " came back.");
    }

    void change_weights() {
        if (!project_.decide_weights(request_.weights->over(project_.project().settings.objectives.weights))) {
            answer_.notes.emplace_back("These weights are in force already.");
            return;
        }
        answer_.done = "The weights are changed.";
        context_.saved("The weights are changed; the cuts are unchanged.");
    }

    void undo_or_redo() {
        const std::optional<Decision> decision = request_.undo ? project_.undo() : project_.redo();
        if (!decision) return refuse(request_.undo ? "There is nothing to undo." : "There is nothing to redo.");
        answer_.done = (request_.undo ? "Undo " : "Redo ") + describe(*decision) + ": done.";
    }

    void reset() {
        if (!project_.decide_reset()) return refuse("There is no cut to take back.");
        answer_.done = Sentence::with_key("taken_back", {},
                                          "All cuts and discarded pieces are taken back; undo brings them again.");
    }

    void discard_pieces(const DiscardRequest& request) {
        const std::vector<std::string> names = pieces_meant(request, project_.segmentation());
        if (names.empty()) {
            answer_.notes.push_back(none_is_below(request));
            return;
        }
        if (!project_.decide_discard(names)) return refuse(nothing_would_be_left());
        const std::vector<SegmentationWarning>& warnings = project_.segmentation().warnings;
        answer_.warnings = texts(warnings, warnings.size() - names.size());
        std::string list;
        for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
        answer_.done = Sentence::with_key("discarded", {list},
                                          "Discarded: " + list + "; undo brings back what this decision left out.");
    }

    std::size_t piece() {
        if (request_.piece) return index_of_piece(project_.segmentation(), *request_.piece);
        const OpenProject::Next next = project_.next(checks_);
        if (!next.piece) {
            throw InputError(
                InputFault::mesh, "the scan holds nothing but fragments",
                Sentence::with_key("smaller_fragments", {},
                                   "check the scan, or make the project again with a smaller volume of fragments"));
        }
        rules_hold_ = next.rules_hold;
        return *next.piece;
    }

    Proposal propose() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        const StageTimer stage(context_, "planes ranked");
        const std::vector<Ranked> ranked = project_.ranking(p, request_.top, context_, answer_.tried_weights);
        Proposal proposal{target.name, target.mesh->triangles.size(), rules_hold_, ranked.size(), {}, request_.top, {}};
        for (const std::size_t i : project_.listed(p, ranked, request_.top)) proposal.listed.push_back(ranked[i]);
        if (proposal.listed.empty()) refuse("No plane parts piece " + target.name + ".");
        for (std::size_t k = 1; k <= proposal.listed.size(); ++k) {
            if (crossing_regions(*target.mesh, proposal.listed[k - 1].plane) > 0) proposal.crossing.push_back(k);
        }
        return proposal;
    }

    // The index in a ranking of the k-th plane of the list that --step shows, from 1.
    std::size_t place(std::size_t p, const std::vector<Ranked>& ranked, std::size_t k) {
        const std::vector<std::size_t> listed = project_.listed(p, ranked, k);
        if (k > listed.size()) {
            throw InputError(
                InputFault::use,
                "the ranking has no place " + std::to_string(k) + ", it ends at " + std::to_string(listed.size()),
                Sentence::with_key("see_ranking", {}, "see the ranking"));
        }
        return listed[k - 1];
    }

    void accept() {
        const std::size_t p = piece();
        const std::vector<Ranked> ranked = project_.ranking(p, *request_.accept, context_);
        const std::size_t k = place(p, ranked, *request_.accept);
        if (request_.expected_plane && ranked[k].plane != *request_.expected_plane) {
            return refuse("Another plane stands at place " + std::to_string(*request_.accept) +
                          " of the ranking of piece " + project_.segmentation().pieces[p].name + ": normal " +
                          significant(ranked[k].plane.normal.x, 17) + ", " + significant(ranked[k].plane.normal.y, 17) +
                          ", " + significant(ranked[k].plane.normal.z, 17) + ", offset " +
                          significant(ranked[k].plane.offset, 17) + " mm. Nothing was cut.");
        }
        cut(p, ranked, k);
    }

    void cut_by_plane() {
        const std::size_t p = piece();
        const Plane plane = *request_.plane;
        const std::optional<Ranked> own = project_.own_plane(p, plane, context_);
        if (!own) return refuse_plane(p, plane);
        cut(p, {*own}, 0);
    }

    void refuse_plane(std::size_t p, const Plane& plane) {
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
        if (!project_.decide_cut(cut_by(project_.segmentation(), p, ranked, k, project_.project().settings))) {
            return refuse("The plane does not part piece " + project_.segmentation().pieces[p].name +
                          ", although its evaluation says so: the scan runs through itself there. Nothing was cut.");
        }
        for (std::string& text : texts(project_.segmentation().warnings, warned)) {
            answer_.warnings.push_back(std::move(text));
        }
        answer_.done = cut_line(project_.segmentation().cuts.back(), project_.project().settings);
    }

    void preview() {
        const std::size_t p = piece();
        const Piece& target = project_.segmentation().pieces[p];
        Preview preview;
        preview.piece = target.name;
        if (const auto* k = std::get_if<std::size_t>(&*request_.preview)) {
            const std::vector<Ranked> ranked = project_.ranking(p, *k, context_, answer_.tried_weights);
            preview.plane = ranked[place(p, ranked, *k)];
        } else {
            const Plane plane = std::get<Plane>(*request_.preview);
            const auto own = project_.own_plane(p, plane, context_, answer_.tried_weights);
            if (!own) return refuse_plane(p, plane);
            preview.plane = *own;
        }
        const Ranked& r = preview.plane;
        const Candidate candidate{r.plane, r.wanted_offset, r.normal_index, r.offset_index};
        preview.solids = project_.cache().evaluation_of(target, candidate, context_)->solids;
        preview.outline = outline(*target.mesh, r.plane);
        preview.sections_cross = crossing_regions(*target.mesh, r.plane) > 0;
        if (request_.preview_setups) preview.setups = setups_of_plane(project_, p, r, context_);
        answer_.preview = std::move(preview);
    }

    void write_plan() {
        std::error_code error;
        if (fs::exists(*request_.plan, error)) {
            const Bytes old =
                fs::is_regular_file(*request_.plan, error) ? read_file(*request_.plan, record_limit) : Bytes{};
            if (!has_plan_header({reinterpret_cast<const char*>(old.data()), old.size()})) {
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
        rules.max_cuts = request.max_cuts.value_or(project_.project().settings.stop.max_cuts);
        if (!rules.is_any_set() && checks_.fits_cell) rules.fits_cell = true;
        if (!rules.is_any_set()) {
            throw InputError(
                InputFault::use, "no stop rule is set, so the search would never end",
                Sentence::with_key("set_stop_rule", {},
                                   "set one: a number of cuts, a number of faces, a size or a share out of reach"));
        }
        if (rules.fits_cell && !checks_.fits_cell) {
            throw InputError(InputFault::use, "the project has no cell, so fits-cell cannot be a stop rule",
                             Sentence::with_key("name_cell", {}, "name the cell"));
        }
        return rules;
    }

    void search(const SearchRequest& request) {
        project_.set_search(rules_of(request), request.beam.value_or(project_.project().settings.beam));
        LoopObserver observer;
        observer.on_decision =
            told_decisions(project_, go_on_by_search, project_.project().settings.beam > 1, context_);
        LoopOptions options;
        options.last = LoopStep::cut;
        if (request.time_limit_s) options.time_limit.emplace(TimeLimit{*request.time_limit_s});
        const SearchEnd end = *run_loop(project_, options, observer, context_).end;
        answer_.warnings = texts(project_.segmentation().warnings);
        answer_.done = "The search ended: " + end.sentence + "; cost " + fixed(end.cost, 4) + ".";
        if (!end.is_finished()) refuse("The stop rules do not hold.");
        if (end.is_out_of_time()) answer_.notes.push_back(go_on_by_search("All cuts are kept"));
    }

    OpenProject& project_;
    const ProjectRequest& request_;
    const PieceChecks checks_;
    const ProjectContext& context_;
    SegmentAnswer answer_;
    bool rules_hold_ = false;
};

}  // namespace

SegmentAnswer decide(OpenProject& project, const ProjectRequest& request, const ProjectContext& context) {
    project.setups();  // a cell file that is wrong is refused before anything is decided
    if (request.write_pieces) project.keep_pieces_written();
    return RequestHandler(project, request, context).answer();
}

}  // namespace qchopper
