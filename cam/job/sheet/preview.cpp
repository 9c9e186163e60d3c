// One node with notes; segment/io writes the file.

#include "cam/job/sheet/preview.h"

#include "segment/io/write_glb.h"

namespace qchopper {

Bytes preview_glb(const TriangleMesh& mesh, const PreviewNotes& notes) {
    GlbNode node;
    node.name = "piece/" + notes.piece;
    node.mesh = &mesh;
    node.notes = {{"piece", notes.piece},
                  {"piece_no", notes.piece_no},
                  {"piece_count", notes.piece_count},
                  {"unit", std::string("mm")},
                  {"fits", notes.fits}};
    if (notes.base >= 0) node.notes.emplace_back("base", notes.base);
    return to_glb({"qchopper " + notes.program_version, "setup", {node}});
}

}  // namespace qchopper
