// Cuts are found by linear search: O(cuts of the branch * cuts of the tree).

#include "segment/search/beam_state.h"

#include <algorithm>

namespace qchopper {

BeamState::Branch branch_for(BeamState& state, const std::vector<Cut>& cuts,
                             const std::vector<std::string>& passed_over, const std::vector<RevertedTrial>& reverted) {
    BeamState::Branch branch{0, passed_over, reverted};
    for (std::size_t i = state.from; i < cuts.size(); ++i) {
        const auto known = std::find_if(state.cuts.begin(), state.cuts.end(), [&](const BeamState::Node& node) {
            return node.after == branch.last && node.cut == cuts[i];
        });
        const auto place = static_cast<std::size_t>(known - state.cuts.begin());
        if (known == state.cuts.end()) state.cuts.push_back({branch.last, cuts[i]});
        branch.last = place + 1;
    }
    return branch;
}

std::vector<Cut> cuts_of(const BeamState& state, const BeamState::Branch& branch) {
    std::vector<Cut> cuts;
    for (std::size_t at = branch.last; at > 0; at = state.cuts[at - 1].after) cuts.push_back(state.cuts[at - 1].cut);
    std::reverse(cuts.begin(), cuts.end());
    return cuts;
}

}  // namespace qchopper
