// A scan: O(points + faces). Pieces: the cost of simplify(), on several threads. States: that of exact_faces(). Beside
// it O(faces) for the SHA-256 of the input.

#include "app/display/make_display.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "app/display/display_format.h"
#include "app/display/exact_faces.h"
#include "base/files/gzip.h"
#include "base/parallel.h"
#include "base/shared_progress.h"
#include "base/timings.h"
#include "segment/io/formats/unpack.h"
#include "segment/mesh/measure.h"
#include "segment/simplify/simplify.h"
#include "segment/simplify/vertex_clustering.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever other bytes are made of the same.
constexpr std::uint32_t version_of_display = 1;

constexpr std::size_t kept_files = 1'000;  // of each kind: a piece of a project of 20 takes 15 kB

CacheWriter key_of(const char* what, const TriangleMesh& mesh) {
    CacheWriter key;
    key.put(version_of_display);
    key.put(std::string(what));
    key.put_all(mesh.points);
    key.put_all(mesh.triangles);
    key.put_all(mesh.cap_of);
    return key;
}

DisplayFile packed(const DisplayMesh& mesh, double deviation_mm) {
    const Bytes encoded = encode_display_mesh(mesh);
    const double of_grid = std::sqrt(3.0) / 2 * mesh.grid.step;
    return {display_id(encoded), deviation_mm + of_grid, gzip(encoded)};
}

struct Skin {
    double area = 0;
    std::size_t faces = 0;
};

Skin skin_of(const TriangleMesh& mesh) {
    Skin skin;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) continue;
        skin.area += norm(area_vector(mesh, t));
        ++skin.faces;
    }
    return skin;
}

// Rounded down to seven binary digits: it stays when the sum of all changes a little, because a cut leaves fragments.
std::size_t rounded(std::size_t share) {
    const int dropped = std::max(0, static_cast<int>(std::bit_width(share)) - 7);
    return share >> dropped << dropped;
}

// How many faces each piece keeps, caps included. The share is that of the skin, which no cut changes: other pieces
// stay as they are shown. Caps stay whole, and at their rim there are about as many faces of the skin; these take at
// most half of the share, else nothing of the skin would be left but a fan to each rim.
std::vector<std::size_t> faces_of(std::span<const Piece> pieces) {
    std::vector<Skin> skins;
    double area = 0;
    std::size_t all_faces = 0;
    for (const Piece& piece : pieces) {
        skins.push_back(skin_of(*piece.mesh));
        area += skins.back().area;
        all_faces += piece.mesh->triangles.size();
    }
    std::vector<std::size_t> faces;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t whole = pieces[i].mesh->triangles.size();
        const double part = area > 0 ? skins[i].area / area : 0;
        const std::size_t share = rounded(static_cast<std::size_t>(part * display_faces));
        const std::size_t caps = whole - skins[i].faces;
        const std::size_t most = std::max({min_display_faces, share, 2 * caps + share / 2});
        faces.push_back(all_faces <= display_faces ? whole : std::min(whole, most));
    }
    return faces;
}

DisplayFile made_of_piece(const TriangleMesh& piece, const DisplayGrid& grid, std::size_t faces,
                          const Context& context) {
    if (piece.triangles.size() <= faces) return packed(display_mesh(piece, grid), 0);
    TriangleMesh fewer = piece;
    SimplifyOptions options;
    options.max_faces = faces;
    options.is_quick = true;
    const SimplifyReport report = simplify(fewer, options, context);
    return packed(display_mesh(fewer, grid), report.deviation());
}

// For each face of a mesh the state of the triangle that it shows.
DisplayFile states_on(const DisplayFile& mesh, const TriangleMesh& piece, const std::vector<std::uint8_t>& exact,
                      const fs::path& cache, const Context& context) {
    const auto make = [&] {
        const DisplayMesh shown = decode_display_mesh(gunzip(mesh.packed, "display mesh"));
        std::vector<std::uint8_t> states;
        for (const std::uint32_t triangle : exact_faces(shown, piece, context)) states.push_back(exact[triangle]);
        const Bytes encoded = encode_display_states({mesh.id, std::move(states)});
        return DisplayFile{display_id(encoded), 0, gzip(encoded)};
    };
    if (cache.empty()) return make();
    CacheWriter key = key_of("states", piece);
    key.put(mesh.id);
    key.put_all(exact);
    return kept_or_made(cache, DisplayKind::states, key, make);
}

}  // namespace

DisplayFile display_scan(const TriangleMesh& scan, const fs::path& cache, const Context& context) {
    const StageTimer stage(context, "scan made ready for display");
    context.check_cancelled();
    const auto make = [&] {
        const ClusteredMesh fewer = cluster_to(display_faces, scan, context);
        return packed(display_mesh(fewer.mesh, display_grid(bounds(scan))), fewer.largest_shift);
    };
    if (cache.empty()) return make();
    DisplayFile file = kept_or_made(cache, DisplayKind::mesh, key_of("scan", scan), make);
    remove_oldest_display(cache, kept_files);
    return file;
}

std::vector<DisplayFile> display_pieces(std::span<const Piece> pieces, const Box& scan_box, const fs::path& cache,
                                        const Context& context) {
    const StageTimer stage(context, "pieces made ready for display");
    const DisplayGrid grid = display_grid(scan_box);
    const std::vector<std::size_t> faces = faces_of(pieces);
    std::vector<DisplayFile> files(pieces.size());
    SharedProgress progress(context, "pieces made ready for display", pieces.size());
    Context of_piece;
    of_piece.cancelled = context.cancelled;
    parallel_for(0, pieces.size(), [&](std::size_t i) {
        of_piece.check_cancelled();
        const TriangleMesh& piece = *pieces[i].mesh;
        const auto make = [&] { return made_of_piece(piece, grid, faces[i], of_piece); };
        CacheWriter key;
        if (!cache.empty()) key = key_of("piece", piece);
        key.put(grid.origin);
        key.put(grid.step);
        key.put(faces[i]);
        files[i] = kept_or_made(cache, DisplayKind::mesh, key, make);
        progress.add(1);
    });
    remove_oldest_display(cache, kept_files + pieces.size());
    return files;
}

DisplayFile display_states(const DisplayFile& mesh, const TriangleMesh& piece, const MilledPiece& milled,
                           const fs::path& cache, const Context& context) {
    const StageTimer stage(context, "states made ready for display");
    DisplayFile file = states_on(mesh, piece, surface_states(piece, milled), cache, context);
    remove_oldest_display(cache, kept_files);
    return file;
}

DisplayFile display_surface(const TriangleMesh& surface, double deviation_mm, const DisplayGrid& grid,
                            const CacheWriter& key, const fs::path& cache) {
    return kept_or_made(cache, DisplayKind::mesh, key,
                        [&] { return packed(display_mesh(surface, grid), deviation_mm); });
}

ClassedDisplay display_classes(const TriangleMesh& piece, const std::vector<std::uint8_t>& classes,
                               const DisplayGrid& grid, const fs::path& cache, const Context& context) {
    CacheWriter key = key_of("classed", piece);
    key.put(grid.origin);
    key.put(grid.step);
    ClassedDisplay shown;
    shown.mesh =
        kept_or_made(cache, DisplayKind::mesh, key, [&] { return made_of_piece(piece, grid, display_faces, context); });
    shown.classes = states_on(shown.mesh, piece, classes, cache, context);
    return shown;
}

}  // namespace qchopper
