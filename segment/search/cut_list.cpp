// Names count up over the cuts, so those after a cut follow from the last name that it gave.

#include "segment/search/cut_list.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <span>

#include "segment/search/piece_names.h"

namespace qchopper {

bool is_last_of_its_pieces(const std::vector<Cut>& cuts, std::int32_t number) {
    const std::vector<std::string>& made = cuts[static_cast<std::size_t>(number - 1)].pieces;
    return std::none_of(cuts.begin() + number, cuts.end(), [&](const Cut& later) {
        return std::find(made.begin(), made.end(), later.piece) != made.end();
    });
}

bool can_replace(const std::vector<Cut>& cuts, const Cut& by) {
    if (by.number < 1 || static_cast<std::size_t>(by.number) > cuts.size() || by.pieces.empty()) return false;
    const Cut& old = cuts[static_cast<std::size_t>(by.number - 1)];
    return old.piece == by.piece && is_piece_name(by.pieces.back()) && !old.pieces.empty() &&
           old.pieces.front() == by.pieces.front() && is_last_of_its_pieces(cuts, by.number);
}

void replace_cut(std::vector<Cut>& cuts, const Cut& by) {
    assert(can_replace(cuts, by));
    const auto place = static_cast<std::size_t>(by.number - 1);
    cuts[place] = by;
    std::size_t next = piece_index(by.pieces.back()) + 1;
    std::map<std::string, std::string> renamed;
    for (Cut& later : std::span(cuts).subspan(place + 1)) {
        if (const auto found = renamed.find(later.piece); found != renamed.end()) later.piece = found->second;
        for (std::string& name : later.pieces) {
            const std::string old = name;
            name = piece_name(next++);
            renamed[old] = name;
        }
    }
}

}  // namespace qchopper
