// Each cut costs the evaluation of one piece, and what the judge asks of the pieces that it makes; its seam a
// search for each edge of the skin among those of the caps.

#include "segment/search/trial.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/text.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/search/rank_piece.h"

namespace qchopper {
namespace {

constexpr double min_share_of_unreachable = 0.1;
constexpr double min_share_of_area = 0.002;
constexpr double mm2_per_cm2 = 100;

// What objectives of reach count: without caps, and without what is ignored.
double counted_area(const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap && !is_ignored(mesh, t)) area += norm(area_vector(mesh, t));
    }
    return area;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // the smaller index first

std::array<Edge, 3> edges_of(const TriangleMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {std::minmax({a, b}), std::minmax({b, c}), std::minmax({c, a})};
}

// The length of the edges between skin and the caps of cuts with the number `first` or a larger one.
double seam_mm(const TriangleMesh& mesh, std::int32_t first) {
    std::vector<Edge> of_caps;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap || cap_of(mesh, t) < first) continue;
        for (const Edge& edge : edges_of(mesh, t)) of_caps.push_back(edge);
    }
    std::ranges::sort(of_caps);
    double length = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        for (const Edge& edge : edges_of(mesh, t)) {
            if (!std::ranges::binary_search(of_caps, edge)) continue;
            length += norm(mesh.points[edge.first] - mesh.points[edge.second]);
        }
    }
    return length;
}

// The segmentation during a trial, and the pieces that the trial made.
class Attempt {
 public:
    Attempt(Segmentation segmentation, const SearchSettings& settings, StopJudge& judge, EvaluationCache& cache,
            const Context& context)
        : segmentation_(std::move(segmentation)),
          settings_(settings),
          judge_(judge),
          cache_(cache),
          context_(context) {}

    Segmentation& segmentation() { return segmentation_; }
    int cuts() const { return cuts_; }

    bool make(const Cut& cut) {
        if (!apply(segmentation_, cut, settings_.objectives.fragment_volume_mm3)) return false;
        ++cuts_;
        std::erase(family_, cut.piece);
        const std::vector<std::string>& made = segmentation_.cuts.back().pieces;
        family_.insert(family_.end(), made.begin(), made.end());
        return true;
    }

    double unreachable_mm2() {
        double sum = 0;
        for (const std::size_t p : family()) sum += judge_.unreachable(segmentation_.pieces[p]).mm2;
        return sum;
    }

    // Of the joints of its cuts, each of which two pieces have.
    double seam_mm() const {
        const std::int32_t first = static_cast<std::int32_t>(segmentation_.cuts.size()) - cuts_ + 1;
        double sum = 0;
        for (const std::size_t p : family()) sum += qchopper::seam_mm(*segmentation_.pieces[p].mesh, first);
        return sum / 2;
    }

    bool does_every_piece_hold() const { return failing().empty(); }

    bool make_next() {
        std::vector<std::size_t> members = failing();
        std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
            return judge_.unreachable(segmentation_.pieces[a]).mm2 > judge_.unreachable(segmentation_.pieces[b]).mm2;
        });
        return std::any_of(members.begin(), members.end(), [&](std::size_t p) { return make_best(p); });
    }

 private:
    // Indices, in the order of the pieces.
    std::vector<std::size_t> family() const {
        std::vector<std::size_t> members;
        for (std::size_t p = 0; p < segmentation_.pieces.size(); ++p) {
            const std::string& name = segmentation_.pieces[p].name;
            if (std::find(family_.begin(), family_.end(), name) != family_.end()) members.push_back(p);
        }
        return members;
    }

    // Those of the family that break a rule.
    std::vector<std::size_t> failing() const {
        std::vector<std::size_t> members = family();
        std::erase_if(members, [&](std::size_t p) { return !judge_.breaks_a_rule(segmentation_.pieces[p]); });
        return members;
    }

    bool make_best(std::size_t piece) {
        const std::vector<Ranked> ranked =
            judge_.planes_on_trial(segmentation_, piece,
                                   rank(segmentation_, piece, settings_, cache_, context_, 1,
                                        judge_.too_large_for(segmentation_.pieces[piece])));
        for (std::size_t k = 0; k < ranked.size(); ++k) {
            if (make(cut_by(segmentation_, piece, ranked, k, settings_))) return true;
        }
        return false;
    }

    Segmentation segmentation_;
    const SearchSettings& settings_;
    StopJudge& judge_;
    EvaluationCache& cache_;
    const Context& context_;
    std::vector<std::string> family_;
    int cuts_ = 0;
};

}  // namespace

double min_fall_mm2(const Piece& piece, double before_mm2, double min_gain_mm2) {
    return std::max(
        {min_share_of_unreachable * before_mm2, min_share_of_area * counted_area(*piece.mesh), min_gain_mm2});
}

std::optional<Trial> try_cuts(const Segmentation& segmentation, const Cut& first, const SearchSettings& settings,
                              StopJudge& judge, EvaluationCache& cache, const Context& context) {
    Attempt attempt(segmentation, settings, judge, cache, context);
    if (!attempt.make(first)) return std::nullopt;
    const auto piece = std::find_if(segmentation.pieces.begin(), segmentation.pieces.end(),
                                    [&](const Piece& p) { return p.name == first.piece; });
    const double before = judge.unreachable(*piece).mm2;
    const double least_to_hold = least_fall_to_hold_mm2(judge.min_gain_mm2());
    const bool are_few = judge.do_few_break_rules(segmentation);
    while (true) {
        const double after = attempt.unreachable_mm2();
        const bool holds = before - after >= least_to_hold && attempt.does_every_piece_hold();
        const double by_hand = judge.seam_width_mm() > 0 ? judge.seam_width_mm() * attempt.seam_mm() : 0;
        const double min_gain = std::max(judge.min_gain_mm2(), by_hand);
        if ((holds && are_few) || before - after >= min_fall_mm2(*piece, before, min_gain)) {
            return Trial{std::move(attempt.segmentation()), {}};
        }
        const bool is_cut_short = attempt.cuts() < trial_cuts &&
                                  static_cast<int>(attempt.segmentation().cuts.size()) >= settings.stop.max_cuts;
        if (attempt.cuts() == trial_cuts || is_cut_short || !attempt.make_next()) {
            return Trial{std::nullopt, {first.piece, attempt.cuts(), before, after, is_cut_short, holds}};
        }
    }
}

std::string describe(const RevertedTrial& trial) {
    constexpr std::array<const char*, trial_cuts> counts{"one cut", "two cuts", "three cuts"};
    if (trial.cuts < 1 || trial.cuts > trial_cuts) return "too little for a cut to count";
    const int decimals = trial.before_mm2 >= 10 * mm2_per_cm2 ? 1 : 3;
    return std::string(counts[static_cast<std::size_t>(trial.cuts) - 1]) + " changed that from " +
           fixed(trial.before_mm2 / mm2_per_cm2, decimals) + " to " + fixed(trial.after_mm2 / mm2_per_cm2, decimals) +
           " cm2" + (trial.holds ? ", less than its joints take by hand" : "");
}

}  // namespace qchopper
