// Makes what the browser draws: the scan, the pieces on the grid of the scan, and what becomes of their surface.
//
// mm about the scan's centre. Each is found in the cache by a SHA-256 over all that goes in, or made and kept there; an
// empty folder keeps nothing. Same input, same bytes, whatever the number of threads
// (tests/app/display/make_display_test.cpp). All throw Cancelled (base/context.h).

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "app/display/display_mesh.h"
#include "app/display/display_store.h"
#include "app/pictures/unreachable_picture.h"
#include "base/box.h"
#include "base/context.h"
#include "segment/cut/piece.h"

namespace qchopper {

constexpr std::size_t display_faces = 100'000;  // of the scan, or of all pieces together
constexpr std::size_t min_display_faces = 200;  // of a piece

// Any mesh, open or damaged too; with more than display_faces its points are clustered (vertex_clustering.h). Throws
// InputError (mesh) if it is larger than numbers are. Precondition: coordinates are finite.
DisplayFile display_scan(const TriangleMesh& scan, const std::filesystem::path& cache, const Context& context = {});

// One per piece, in their order, all on the grid over `scan_box`, in which they lie. Pieces with more than
// display_faces together are simplified as by `export --max-faces`, their caps stay: each to its share of display_faces
// by the area of its skin, so that as a rule a cut changes no piece but the one it cuts. Where caps and their rims take
// more than half of the share, the skin keeps half of it besides. Throws what simplify() (segment/simplify/simplify.h)
// throws.
std::vector<DisplayFile> display_pieces(std::span<const Piece> pieces, const Box& scan_box,
                                        const std::filesystem::path& cache, const Context& context = {});

// For each face of `mesh`, which was made of `piece`, the state of the triangle that it shows (exact_faces.h).
DisplayFile display_states(const DisplayFile& mesh, const TriangleMesh& piece, const MilledPiece& milled,
                           const std::filesystem::path& cache, const Context& context = {});

// A surface that is drawn as it is, and is so far from the one that it shows at most; of `key` it follows.
DisplayFile display_surface(const TriangleMesh& surface, double deviation_mm, const DisplayGrid& grid,
                            const CacheWriter& key, const std::filesystem::path& cache);

// Of a piece alone on a grid, simplified if it has more than display_faces; and for each of its faces the class of the
// triangle that it shows. Precondition: classes are at most base_state, one per triangle.
struct ClassedDisplay {
    DisplayFile mesh;
    DisplayFile classes;
};
ClassedDisplay display_classes(const TriangleMesh& piece, const std::vector<std::uint8_t>& classes,
                               const DisplayGrid& grid, const std::filesystem::path& cache,
                               const Context& context = {});

}  // namespace qchopper
