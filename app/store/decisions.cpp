// A history is one list; everything in force is derived by going through it from the start. O(decisions), and for each
// replacement O(cuts log cuts) more.

#include "app/store/decisions.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "base/text.h"
#include "segment/search/cut_list.h"
#include "segment/search/rank.h"

namespace qchopper {

Weights GivenWeights::over(const Weights& weights) const {
    Weights result = weights;
    for (std::size_t i = 0; i < all_objectives.size(); ++i) {
        if (weight[i]) result.*all_objectives[i].weight = *weight[i];
    }
    return result;
}

namespace {

// "piece C", "pieces C, D".
std::string describe_pieces(const Discards& discards) {
    std::string names;
    for (const Discard& discard : discards) names += (names.empty() ? "" : ", ") + discard.piece;
    return (discards.size() == 1 ? "piece " : "pieces ") + names;
}

}  // namespace

std::string describe(const Decision& decision) {
    if (const Cut* cut = std::get_if<Cut>(&decision)) {
        return "cut " + std::to_string(cut->number) + " on piece " + cut->piece;
    }
    if (const auto* discards = std::get_if<Discards>(&decision)) return "discard of " + describe_pieces(*discards);
    if (const auto* order = std::get_if<SetupOrder>(&decision)) return "setup of piece " + order->piece;
    if (const auto* other = std::get_if<Replacement>(&decision)) return "replacement of " + describe(other->cut);
    return std::holds_alternative<WeightsChange>(decision) ? "change of weights" : "reset";
}

std::size_t max_judged_planes(const SearchSettings& settings) {
    constexpr std::size_t of_box = 3;
    constexpr std::size_t of_sphere = 129 + of_box;  // the octahedron's
    const Objectives& objectives = settings.objectives;
    const bool is_by_access = objectives.weights.unreachable > 0;
    if (!is_by_access && !objectives.needs_connector() && !objectives.needs_symmetry()) return 0;
    const CandidateNormals usual = is_by_access ? CandidateNormals::sphere : CandidateNormals::box;
    const bool is_box = settings.candidates.normals.value_or(usual) == CandidateNormals::box;
    return (is_box ? of_box : of_sphere) * static_cast<std::size_t>(max_offsets(settings.candidates));
}

std::string describe_planes(std::size_t evaluated, const SearchSettings& settings) {
    const std::size_t judged = max_judged_planes(settings);
    if (judged == 0) return with_commas(evaluated) + (evaluated == 1 ? " plane" : " planes");
    return "up to " + with_commas(judged) + " planes, " + with_commas(evaluated) + " of them evaluated whole";
}

namespace {

// What is said of a plane that is along none of the normals.
std::string kind_of(const Ranked& plane) {
    if (plane.normal_index == refined_index) return ", refined";
    if (plane.normal_index == symmetry_index) return ", the symmetry plane";
    if (plane.normal_index == given_index) return ", a given one";
    if (plane.normal_index == refined_given_index) return ", a given one, refined";
    if (plane.normal_index == mirror_index) return ", the mirror image of cut " + std::to_string(plane.offset_index);
    return "";
}

// ", seam 0.213": of those that have a weight.
std::string terms_of_chopper(const Terms& t, const Weights& weights) {
    std::string text;
    for (std::size_t i = first_of_chopper; i < all_objectives.size(); ++i) {
        const ObjectiveField& field = all_objectives[i];
        if (weights.*field.weight > 0) text += ", " + std::string(field.key) + " " + fixed(t.*field.value, 3);
    }
    return text;
}

std::string coarse_sections(const Ranked& chosen) {
    if (chosen.coarse_sections == 0) return "";
    return ". " + counted(chosen.coarse_sections, "section") + " under 3 voxels thick: too coarse for its structure";
}

}  // namespace

std::string cut_line(const Cut& cut, const SearchSettings& settings) {
    const Terms& t = cut.chosen.terms;
    // If another than the best was accepted, the best is among the runners-up. Of totals that differ by a tie none is
    // better.
    const bool is_best = std::all_of(cut.runners_up.begin(), cut.runners_up.end(),
                                     [&](const Ranked& r) { return r.terms.total + tie >= t.total; });
    const std::string which =
        cut.chosen.normal_index == own_index
            ? "given plane"
            : (is_best ? "best of " : "one of ") + describe_planes(cut.candidates, settings) + kind_of(cut.chosen);
    return "cut " + std::to_string(cut.number) + " on piece " + cut.piece + ": " + which + ", total " +
           fixed(t.total, 3) + " (face ratio " + fixed(t.face_ratio, 2) + ", fragility " + fixed(t.fragility, 3) +
           ", piece count " + fixed(t.piece_count, 0) + ", undercut " + fixed(t.undercut, 3) +
           (t.unreachable > 0 ? ", unreachable " + fixed(100 * t.unreachable, 2) + " %" : "") +
           terms_of_chopper(t, settings.objectives.weights) + "); makes " + makes(cut) + coarse_sections(cut.chosen) +
           (is_forbidden(t, settings.objectives) ? ". No plane without a forbidden value was left" : "");
}

std::string makes(const Cut& cut) {
    std::string made;
    for (const std::string& name : cut.pieces) made += (made.empty() ? "" : ", ") + name;
    return made + (cut.fragments > 0 ? " and " + std::to_string(cut.fragments) + " fragments" : "");
}

std::vector<Cut> committed_cuts(const History& history) {
    assert(history.committed <= history.decisions.size());
    std::vector<Cut> cuts;
    for (std::size_t i = 0; i < history.committed; ++i) {
        const Decision& decision = history.decisions[i];
        if (std::holds_alternative<Reset>(decision)) cuts.clear();
        if (const Cut* cut = std::get_if<Cut>(&decision)) cuts.push_back(*cut);
        if (const auto* other = std::get_if<Replacement>(&decision)) replace_cut(cuts, other->cut);
    }
    return cuts;
}

bool are_replacements_possible(const History& history) {
    std::vector<Cut> cuts;
    for (const Decision& decision : history.decisions) {
        if (std::holds_alternative<Reset>(decision)) cuts.clear();
        if (const Cut* cut = std::get_if<Cut>(&decision)) cuts.push_back(*cut);
        const auto* other = std::get_if<Replacement>(&decision);
        if (other == nullptr) continue;
        if (!can_replace(cuts, other->cut)) return false;
        replace_cut(cuts, other->cut);
    }
    return true;
}

std::vector<Discard> committed_discards(const History& history) {
    std::vector<Discard> discards;
    std::size_t cuts = 0;
    for (std::size_t i = 0; i < history.committed; ++i) {
        const Decision& decision = history.decisions[i];
        if (std::holds_alternative<Cut>(decision)) ++cuts;
        if (const auto* together = std::get_if<Discards>(&decision)) {
            for (const Discard& discard : *together) discards.push_back({discard.piece, cuts});
        }
        if (!std::holds_alternative<Reset>(decision)) continue;
        discards.clear();
        cuts = 0;
    }
    return discards;
}

Weights committed_weights(const History& history) {
    Weights weights = history.weights_at_start;
    for (std::size_t i = 0; i < history.committed; ++i) {
        if (const auto* change = std::get_if<WeightsChange>(&history.decisions[i])) weights = change->weights;
    }
    return weights;
}

std::vector<SetupOrder> committed_setup_orders(const History& history) {
    std::map<std::string, SetupOrder> orders;
    for (std::size_t i = 0; i < history.committed; ++i) {
        const Decision& decision = history.decisions[i];
        if (std::holds_alternative<Reset>(decision)) orders.clear();
        if (const Cut* cut = std::get_if<Cut>(&decision)) orders.erase(cut->piece);
        if (const auto* discards = std::get_if<Discards>(&decision)) {
            for (const Discard& discard : *discards) orders.erase(discard.piece);
        }
        const auto* order = std::get_if<SetupOrder>(&decision);
        if (order == nullptr) continue;
        orders.erase(order->piece);
        if (!order->is_free()) orders.emplace(order->piece, *order);
    }
    std::vector<SetupOrder> list;
    list.reserve(orders.size());
    for (auto& [piece, order] : orders) list.push_back(std::move(order));
    return list;
}

SetupOrder committed_setup_order(const History& history, const std::string& piece) {
    for (const SetupOrder& order : committed_setup_orders(history)) {
        if (order.piece == piece) return order;
    }
    return {piece, {}, {}};
}

void decide(History& history, Decision decision) {
    assert(history.committed <= history.decisions.size());
    history.decisions.resize(history.committed, Reset{});
    history.decisions.push_back(std::move(decision));
    ++history.committed;
}

const Decision* to_undo(const History& history) {
    return history.committed > 0 ? &history.decisions[history.committed - 1] : nullptr;
}

const Decision* to_redo(const History& history) {
    return history.committed < history.decisions.size() ? &history.decisions[history.committed] : nullptr;
}

std::string undo_text(const History& history) {
    const Decision* const decision = to_undo(history);
    return decision == nullptr ? "" : "Undo " + describe(*decision);
}

std::string redo_text(const History& history) {
    const Decision* const decision = to_redo(history);
    return decision == nullptr ? "" : "Redo " + describe(*decision);
}

void follow(History& history, const std::vector<Cut>& cuts) {
    const std::vector<Cut> before = committed_cuts(history);
    std::size_t same = 0;
    while (same < before.size() && same < cuts.size() && before[same] == cuts[same]) ++same;
    for (std::size_t given_up = before.size(); given_up > same; --given_up) {
        assert(std::holds_alternative<Cut>(history.decisions[history.committed - 1]));
        --history.committed;
    }
    for (std::size_t i = same; i < cuts.size(); ++i) decide(history, cuts[i]);
    assert(committed_cuts(history) == cuts);
}

}  // namespace qchopper
