// A program of somebody else: halves a mesh and prints the volumes of both parts and of the whole.

#include <cstdio>
#include <memory>

#include "segment/cut/cut_piece.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"

int main(int argc, char** argv) {
    using namespace qchopper;
    if (argc != 2) return 64;
    Piece piece;
    piece.mesh = std::make_shared<TriangleMesh>(read_mesh(argv[1]).mesh);
    const Box box = bounds(*piece.mesh);
    const auto cut = cut_piece(piece, {{0, 0, 1}, box.centre().z + 0.1234}, 1);
    if (!cut) return 1;
    double sum = 0;
    for (const Piece& part : cut->pieces) sum += volume_mm3(*part.mesh);
    std::printf("%zu pieces, %.6f of the volume\n", cut->pieces.size(), sum / volume_mm3(*piece.mesh));
    return 0;
}
