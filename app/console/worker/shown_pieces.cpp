// The grid is that of the box of all that the scan was cut into, fragments and discarded pieces too: it is the same
// after every cut, so that a cut changes the drawing of no piece but the one that it cuts.

#include "app/console/worker/shown_pieces.h"

#include <algorithm>

#include "app/display/make_display.h"
#include "app/store/replay.h"
#include "segment/mesh/measure.h"
#include "segment/search/segmentation.h"

namespace qchopper {
namespace {

Box box_of_scan(const Segmentation& segmentation) {
    Box box = bounds(*segmentation.pieces.front().mesh);
    const auto add = [&](const TriangleMesh& mesh) {
        const Box other = bounds(mesh);
        box.min = {std::min(box.min.x, other.min.x), std::min(box.min.y, other.min.y),
                   std::min(box.min.z, other.min.z)};
        box.max = {std::max(box.max.x, other.max.x), std::max(box.max.y, other.max.y),
                   std::max(box.max.z, other.max.z)};
    };
    for (const Piece& piece : segmentation.pieces) add(*piece.mesh);
    for (const Fragment& fragment : segmentation.fragments) add(*fragment.mesh);
    for (const Discarded& discarded : segmentation.discarded) add(*discarded.piece.mesh);
    return box;
}

std::vector<DisplayFile> displayed(OpenProject& open, const Context& context) {
    const Segmentation& segmentation = open.segmentation();
    if (segmentation.pieces.empty()) return {};
    return display_pieces(segmentation.pieces, box_of_scan(segmentation), display_folder(open.folder()), context);
}

}  // namespace

std::filesystem::path display_folder(const std::filesystem::path& project) {
    return project / "cache" / "display";
}

std::vector<ShownPiece> shown_pieces(OpenProject& open, const Context& context) {
    const std::vector<DisplayFile> files = displayed(open, context);
    const std::vector<Piece>& pieces = open.segmentation().pieces;
    std::vector<ShownPiece> shown;
    for (std::size_t i = 0; i < files.size(); ++i) {
        shown.push_back({pieces[i].name, files[i].id, files[i].deviation_mm});
    }
    return shown;
}

std::string shown_states(OpenProject& open, const std::string& piece, const Context& context) {
    const std::vector<DisplayFile> files = displayed(open, context);
    const std::size_t i = *piece_named(open.segmentation(), piece);
    const Piece& shown = open.segmentation().pieces[i];
    const PlacedSetup& placed = open.setups()->placed(shown);
    const MilledPiece milled{placed.choice.states, placed.setup().base};
    return display_states(files[i], *shown.mesh, milled, display_folder(open.folder()), context).id;
}

}  // namespace qchopper
