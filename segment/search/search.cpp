// Each round evaluates the next pieces of the beam, ranks their candidates and merges the children (beam.h). The cost
// of a round is that of the evaluations and of cutting at most b children; the memory that of b segmentations, which
// share the meshes of their pieces.

#include "segment/search/search.h"

#include <algorithm>

#include "base/timings.h"
#include "segment/search/access_rank.h"
#include "segment/search/beam.h"
#include "segment/search/further_candidates.h"
#include "segment/search/late_rank.h"
#include "segment/search/trial.h"

namespace qchopper {
namespace {

constexpr std::size_t evaluated_together = 2;  // one piece alone leaves cores idle towards its end

std::string decimal(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

// One search from its start to its end.
class Search {
 public:
    Search(const SearchSettings& settings, EvaluationCache& cache, const PieceChecks& checks, const Context& context,
           BeamProgress* progress)
        : settings_(settings),
          cache_(cache),
          judge_(judge_for(settings, checks, cache)),
          context_(context),
          progress_(settings.has_state() ? progress : nullptr) {}

    SearchEnd run(Segmentation& segmentation, const std::function<void(const Segmentation&)>& on_round,
                  const std::optional<TimeLimit>& time_limit) {
        if (progress_ != nullptr && !progress_->state.branches.empty()) {
            resume();
        } else {
            from_ = segmentation.cuts.size();
            beam_.push_back(bsp(segmentation, {}, {}, settings_.objectives, cache_));
        }
        while (true) {
            context_.check_cancelled();
            find_next_pieces();
            const bool is_late = time_limit && time_limit->has_passed();
            const bool has_decided = rounds_ > 0 || (time_limit && time_limit->seconds <= 0);
            if (is_late && has_decided && is_any_live()) return end(segmentation, time_limit);
            rank_children();
            if (!is_any_live()) return end(segmentation, std::nullopt);
            make_cuts();
            ++rounds_;
            drop_unused_entries();
            store_progress();
            report(segmentation, on_round);
        }
    }

 private:
    // Makes the beam of an interrupted search again.
    void resume() {
        const BeamState& state = progress_->state;
        const std::vector<Segmentation> grown = grow(state, progress_->root, settings_.objectives.fragment_volume_mm3);
        const auto bsp_of = [&](const BeamState::Branch& b) {
            return bsp(b.last == 0 ? progress_->root : grown[b.last - 1], b.passed_over, b.reverted,
                       settings_.objectives, cache_);
        };
        from_ = state.from;
        for (const BeamState::Branch& b : state.branches) beam_.push_back(bsp_of(b));
        if (state.stuck) stuck_ = bsp_of(*state.stuck);
    }

    void store_progress() {
        if (progress_ == nullptr) return;
        if (settings_.beam == 1) from_ = beam_.front().segmentation.cuts.size();  // no cut is to be saved twice
        BeamState state;
        state.from = from_;
        const auto saved = [&](const Bsp& b) {
            return branch_for(state, b.segmentation.cuts, b.passed_over, b.reverted);
        };
        for (const Bsp& b : beam_) state.branches.push_back(saved(b));
        if (stuck_) state.stuck = saved(*stuck_);
        progress_->state = std::move(state);
    }

    void make_cuts() {
        const StageTimer stage(context_, "cuts made");
        context_.progress("cuts made", beam_.front().segmentation.cuts.size(), 0);
        beam_ = next_round(std::move(beam_), settings_, judge_, cache_, context_);
    }

    void find_next_pieces() {
        for (Bsp& b : beam_) find_next_piece(b);
    }

    // Passes pieces over of which so little is out of reach that no cut can gain enough.
    void find_next_piece(Bsp& b) {
        while (true) {
            b.next = judge_.next(b.segmentation, b.passed_over);
            if (!b.next.is_trial && (b.next.piece || b.next.is_finished || !takes_up_again(b))) return;
            if (!b.next.is_trial) continue;
            const Piece& piece = b.segmentation.pieces[*b.next.piece];
            const double unreachable = judge_.unreachable(piece).mm2;
            if (unreachable >= least_fall_to_hold_mm2(judge_.min_gain_mm2())) return;
            b.passed_over.push_back(piece.name);
            b.reverted.push_back({piece.name, 0, unreachable, unreachable});
        }
    }

    // At the end: pieces whose trial was reverted though all held the rules then, because many others broke one. False:
    // there is none, or many still do. Such a trial is kept now, so that none is taken up twice.
    bool takes_up_again(Bsp& b) {
        const bool is_full = static_cast<int>(b.segmentation.cuts.size()) >= settings_.stop.max_cuts;
        if (is_full || std::none_of(b.reverted.begin(), b.reverted.end(), holds)) return false;
        if (!judge_.do_few_break_rules(b.segmentation)) return false;
        for (const RevertedTrial& trial : b.reverted) {
            if (holds(trial)) std::erase(b.passed_over, trial.piece);
        }
        std::erase_if(b.reverted, holds);
        return true;
    }

    static bool holds(const RevertedTrial& trial) { return trial.holds; }

    bool is_any_live() const {
        return std::any_of(beam_.begin(), beam_.end(), [](const Bsp& b) { return b.is_live(); });
    }

    // Evaluates the next pieces that are not evaluated yet and ranks the children of every live BSP; a piece without
    // candidates is passed over. BSPs that are neither live nor finished leave the beam; the cheapest of them is kept.
    void rank_children() {
        for (bool is_ready = false; !is_ready;) {
            evaluate_next_pieces();
            is_ready = true;
            for (Bsp& b : beam_) {
                if (!b.is_live() || !b.ranked.empty()) continue;
                const Piece& piece = b.segmentation.pieces[*b.next.piece];
                rank_children(b, piece);
                if (!b.ranked.empty()) continue;
                b.passed_over.push_back(piece.name);
                find_next_piece(b);
                is_ready = false;
            }
        }
        for (Bsp& b : beam_) {
            if (b.is_live() || b.next.is_finished) continue;
            if (!stuck_ || b.cost < stuck_->cost) stuck_ = b;
        }
        std::erase_if(beam_, [](const Bsp& b) { return !b.is_live() && !b.next.is_finished; });
    }

    // Of planes near to each other only the best is a child: where not all are ranked, more are until each place of the
    // beam has a child.
    void rank_children(Bsp& b, const Piece& piece) {
        constexpr std::size_t more = 16;
        for (std::size_t best = 1;; best *= more) {
            b.ranked =
                rank(b.segmentation, *b.next.piece, settings_, cache_, context_, best, judge_.too_large_for(piece));
            if (b.next.is_trial) {
                b.ranked = judge_.planes_on_trial(b.segmentation, *b.next.piece, std::move(b.ranked));
            }
            b.children = settings_.candidates.normals == CandidateNormals::sphere
                             ? without_near_planes(b.ranked, piece, cache_.box(piece))
                             : without_near_duplicates(b.ranked, max_offsets(settings_.candidates), settings_.near);
            const bool is_part = is_ranked_late(settings_) && !is_ranked_by_access(piece, settings_);
            if (!is_part || b.children.size() >= settings_.beam || b.ranked.size() < best) return;
        }
    }

    void evaluate_next_pieces() {
        std::vector<const Piece*> pieces;
        for (const Bsp& b : beam_) {
            if (!b.is_live() || !b.ranked.empty()) continue;
            const std::size_t count = settings_.beam > 1 ? 1 : evaluated_together;
            for (std::size_t i = 0; i < std::min(count, b.next.waiting.size()); ++i) {
                const Piece& piece = b.segmentation.pieces[b.next.waiting[i]];
                // The next piece is evaluated already: no reason to evaluate others early.
                if (i > 0 && cache_.is_evaluated(b.segmentation.pieces[b.next.waiting.front()])) break;
                if (is_ranked_by_access(piece, settings_) || is_ranked_late(settings_))
                    continue;  // evaluated as far as needed, by rank()
                if (!contains(pieces, piece)) pieces.push_back(&piece);
            }
        }
        cache_.evaluate(pieces, context_);
    }

    static bool contains(const std::vector<const Piece*>& pieces, const Piece& piece) {
        return std::any_of(pieces.begin(), pieces.end(), [&](const Piece* p) { return p->mesh == piece.mesh; });
    }

    void drop_unused_entries() {
        std::vector<const Segmentation*> held;
        for (const Bsp& b : beam_) held.push_back(&b.segmentation);
        cache_.keep_only(held);
    }

    void report(Segmentation& segmentation, const std::function<void(const Segmentation&)>& on_round) {
        const Segmentation& best = beam_.front().segmentation;
        if (best.cuts == segmentation.cuts) return;
        segmentation = best;
        on_round(segmentation);
    }

    SearchEnd end(Segmentation& segmentation, const std::optional<TimeLimit>& time_limit) {
        const auto finished = std::find_if(beam_.begin(), beam_.end(), [](const Bsp& b) { return b.next.is_finished; });
        const Bsp& best = finished != beam_.end() ? *finished : beam_.empty() ? *stuck_ : beam_.front();
        SearchEnd result = end_with(best, finished != beam_.end(), time_limit);
        result.cost = best.cost;
        result.reverted = best.reverted;
        segmentation = best.segmentation;
        return result;
    }

    SearchEnd end_with(const Bsp& best, bool is_finished, const std::optional<TimeLimit>& time_limit) {
        const std::string time = time_limit ? end_of_time(*time_limit).sentence : "";
        if (is_finished) {
            const EndReason reason = settings_.stop.is_any_set() ? EndReason::rules_hold : EndReason::no_rule;
            return {reason, describe(reason) + (time_limit ? "; " + time : "")};
        }
        if (time_limit) return end_of_time(*time_limit);
        const std::string pieces = settings_.stop.max_unreachable ? passed_over_pieces(best) : "";
        const int most = settings_.stop.max_cuts;
        const bool is_cut_short = std::any_of(best.reverted.begin(), best.reverted.end(),
                                              [](const RevertedTrial& trial) { return trial.is_cut_short; });
        if (static_cast<int>(best.segmentation.cuts.size()) >= most || is_cut_short) {
            const std::string sentence = describe(EndReason::max_cuts, std::to_string(most));
            return {EndReason::max_cuts, sentence + (pieces.empty() ? "" : "; " + pieces)};
        }
        if (pieces.empty()) return {EndReason::no_plane, describe(EndReason::no_plane)};
        return {EndReason::passed_over, describe(EndReason::passed_over, pieces)};
    }

    // "piece B: 7.4 % of its surface is out of reach (2 % may be), three cuts changed that from 812 to 790 cm2", for
    // every piece that breaks a rule and is passed over.
    std::string passed_over_pieces(const Bsp& b) {
        std::string text;
        for (const Piece& piece : b.segmentation.pieces) {
            if (std::find(b.passed_over.begin(), b.passed_over.end(), piece.name) == b.passed_over.end()) continue;
            const std::string why = judge_.why(piece);
            if (why.empty()) continue;
            const auto trial = std::find_if(b.reverted.begin(), b.reverted.end(),
                                            [&](const RevertedTrial& t) { return t.piece == piece.name; });
            text += (text.empty() ? "" : "; ") + ("piece " + piece.name + ": " + why + ", ") +
                    (trial == b.reverted.end() ? "no plane parts it" : describe(*trial));
        }
        return text;
    }

    const SearchSettings& settings_;
    EvaluationCache& cache_;
    StopJudge judge_;
    const Context& context_;
    std::vector<Bsp> beam_;     // cheapest first
    std::optional<Bsp> stuck_;  // as in BeamState
    std::size_t rounds_ = 0;
    std::size_t from_ = 0;  // as in BeamState
    BeamProgress* progress_;
};

}  // namespace

StopJudge judge_for(const SearchSettings& settings, const PieceChecks& checks, EvaluationCache& cache) {
    std::function<double(const Piece&)> priority;
    if (settings.objectives.weights.unreachable > 0) {
        priority = [&cache, tilt = settings.objectives.tilt_deg](const Piece& p) {
            return cache.unreachable_mm2(p, tilt);
        };
    }
    return {settings.stop, checks, [&cache](const Piece& p) { return cache.box(p).size(); }, std::move(priority)};
}

bool TimeLimit::has_passed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >= seconds;
}

SearchEnd end_of_time(const TimeLimit& limit) {
    return {EndReason::time_limit, describe(EndReason::time_limit, decimal(limit.seconds))};
}

SearchEnd search(Segmentation& segmentation, const SearchSettings& settings, EvaluationCache& cache,
                 const PieceChecks& checks, const std::function<void(const Segmentation&)>& on_round,
                 const Context& context, const std::optional<TimeLimit>& time_limit, BeamProgress* progress) {
    return Search(settings, cache, checks, context, progress).run(segmentation, on_round, time_limit);
}

}  // namespace qchopper
