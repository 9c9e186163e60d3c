// Only the pieces of one cut are new; the lists of pieces, fragments and warnings are in the order of the cuts.

#include "segment/search/recut.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "segment/search/cut_list.h"
#include "segment/search/piece_names.h"

namespace qchopper {
namespace {

// Replaces the elements of one cut by others, before those of later cuts. `number` returns the cut of an element.
template <typename Element, typename Number>
void replace_part(std::vector<Element>& list, const std::vector<Element>& by, std::int32_t cut, Number number) {
    std::erase_if(list, [&](const Element& e) { return number(e) == cut; });
    const auto later = std::find_if(list.begin(), list.end(), [&](const Element& e) { return number(e) > cut; });
    list.insert(later, by.begin(), by.end());
}

}  // namespace

std::optional<Segmentation> cut_alone(const Segmentation& segmentation, const Piece& piece, Cut by,
                                      double fragment_volume_mm3) {
    assert(is_last_of_its_pieces(segmentation.cuts, by.number) && by.piece == piece.name);
    Segmentation alone;
    alone.pieces = {piece};
    alone.names_given = piece_index(segmentation.cuts[static_cast<std::size_t>(by.number - 1)].pieces.front());
    if (!apply(alone, std::move(by), fragment_volume_mm3) || alone.pieces.empty()) return std::nullopt;
    return alone;
}

Segmentation recut(Segmentation segmentation, const Segmentation& alone) {
    const Cut& by = alone.cuts.front();
    const std::vector<Cut> before = segmentation.cuts;
    replace_cut(segmentation.cuts, by);
    std::map<std::string, std::string> renamed;
    for (std::size_t c = static_cast<std::size_t>(by.number); c < before.size(); ++c) {
        for (std::size_t p = 0; p < before[c].pieces.size(); ++p) {
            renamed[before[c].pieces[p]] = segmentation.cuts[c].pieces[p];
        }
    }
    replace_part(segmentation.pieces, alone.pieces, by.number, made_by);
    for (Piece& piece : segmentation.pieces) {
        if (made_by(piece) > by.number) piece.name = renamed.at(piece.name);
    }
    replace_part(segmentation.fragments, alone.fragments, by.number, [](const Fragment& f) { return f.cut; });
    replace_part(segmentation.warnings, alone.warnings, by.number, [](const SegmentationWarning& w) { return w.cut; });
    const Cut& old = before[static_cast<std::size_t>(by.number - 1)];
    segmentation.names_given = segmentation.names_given - old.pieces.size() + by.pieces.size();
    return segmentation;
}

}  // namespace qchopper
