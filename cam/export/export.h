// Pieces as files for other programs: where they sit in the scan, or as they lie in their stock.
//
// Millimetres; GLB turns them into metres for whoever reads it. In 3MF and GLB the mesh of a piece is the same in
// either pose and the file says where it goes; STL and PLY hold the points as they come to lie. Same pieces, same bytes
// (tests/app/cli/export_test.cpp). docs/export.md tells it to operators.

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/file.h"
#include "base/pose.h"
#include "segment/cut/piece.h"

namespace qchopper {

enum class ExportFormat { threemf, stl, ply, glb };

// "3mf", "stl", "ply" or "glb"; it is also the ending of the file. Throws InputError (use) for anything else.
ExportFormat export_format_named(std::string_view name);
// 3MF and GLB hold all pieces; of STL and PLY every piece has one of its own.
bool holds_many(ExportFormat format);

struct ExportPiece {
    std::string name;
    std::shared_ptr<const TriangleMesh> mesh;        // as it sits in the scan
    Pose pose;                                       // from there to where it is to lie
    std::int32_t step = 0;                           // the cut that made it; 0: none did
    std::string parent;                              // the piece that it was cut from; empty: none
    std::optional<bool> fits;                        // the cell, where one was asked
    std::array<double, 3> colour{0.80, 0.72, 0.56};  // linear red, green, blue
};

struct ExportNotes {
    std::string title;  // of the project
    std::string program_version;
    std::string scan_sha256;
    Vec3 centre;  // mm: what was subtracted from the scan's points
};

// Puts pieces that lie in setup coordinates beside each other along x, this far apart, so that none covers another.
void stand_in_a_row(std::span<ExportPiece> pieces, double gap);

// All pieces as one file, 3MF or GLB.
Bytes export_file(ExportFormat format, std::span<const ExportPiece> pieces, const ExportNotes& notes);

// One piece, STL or PLY.
Bytes export_file(ExportFormat format, const ExportPiece& piece);

}  // namespace qchopper
