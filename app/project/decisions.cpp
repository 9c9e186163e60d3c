#include "app/project/decisions.h"

#include <algorithm>
#include <cassert>

namespace qchopper {

std::string words(const Decision& decision) {
    if (const Cut* cut = std::get_if<Cut>(&decision)) {
        return "cut " + std::to_string(cut->number) + " on piece " + cut->piece;
    }
    if (const auto* discard = std::get_if<Discard>(&decision)) return "discard of piece " + discard->piece;
    return std::holds_alternative<WeightsChange>(decision) ? "change of weights" : "reset";
}

std::vector<Cut> standing_cuts(const History& history) {
    assert(history.standing <= history.decisions.size());
    std::vector<Cut> cuts;
    for (std::size_t i = 0; i < history.standing; ++i) {
        const Decision& decision = history.decisions[i];
        if (std::holds_alternative<Reset>(decision)) cuts.clear();
        if (const Cut* cut = std::get_if<Cut>(&decision)) cuts.push_back(*cut);
    }
    return cuts;
}

std::vector<Discard> standing_discards(const History& history) {
    std::vector<Discard> discards;
    std::size_t cuts = 0;
    for (std::size_t i = 0; i < history.standing; ++i) {
        const Decision& decision = history.decisions[i];
        if (std::holds_alternative<Cut>(decision)) ++cuts;
        if (const auto* discard = std::get_if<Discard>(&decision)) discards.push_back({discard->piece, cuts});
        if (!std::holds_alternative<Reset>(decision)) continue;
        discards.clear();
        cuts = 0;
    }
    return discards;
}

Weights standing_weights(const History& history) {
    Weights weights = history.weights_at_start;
    for (std::size_t i = 0; i < history.standing; ++i) {
        if (const auto* change = std::get_if<WeightsChange>(&history.decisions[i])) weights = change->weights;
    }
    return weights;
}

void decide(History& history, Decision decision) {
    assert(history.standing <= history.decisions.size());
    history.decisions.resize(history.standing, Reset{});
    history.decisions.push_back(std::move(decision));
    ++history.standing;
}

const Decision* to_undo(const History& history) {
    return history.standing > 0 ? &history.decisions[history.standing - 1] : nullptr;
}

const Decision* to_redo(const History& history) {
    return history.standing < history.decisions.size() ? &history.decisions[history.standing] : nullptr;
}

void follow(History& history, const std::vector<Cut>& cuts) {
    const std::vector<Cut> before = standing_cuts(history);
    std::size_t same = 0;
    while (same < before.size() && same < cuts.size() && before[same] == cuts[same]) ++same;
    for (std::size_t given_up = before.size(); given_up > same; --given_up) {
        assert(std::holds_alternative<Cut>(history.decisions[history.standing - 1]));
        --history.standing;
    }
    for (std::size_t i = same; i < cuts.size(); ++i) decide(history, cuts[i]);
    assert(standing_cuts(history) == cuts);
}

}  // namespace qchopper
