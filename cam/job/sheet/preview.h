// Writes the piece as it will be milled as GLB, for any viewer.
//
// glTF is in metres with Y up: the root node turns and scales; coordinates below it are millimetres in setup
// coordinates in single precision. The node piece/<name> has extras {"qchopper": {...}}
// (tests/cam/job/sheet/preview_test.cpp).

#pragma once

#include <string>

#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct PreviewNotes {
    std::string piece;
    std::string program_version;
    int piece_no = 0;
    int piece_count = 0;
    int base = -1;  // number of the cut whose cap lies on the table; -1: none
    bool fits = true;
};

// The mesh is in setup coordinates. Its caps are a second primitive with a colour of their own. Throws InputError (use)
// for a mesh beyond 4 GiB.
Bytes preview_glb(const TriangleMesh& mesh, const PreviewNotes& notes);

}  // namespace qchopper
