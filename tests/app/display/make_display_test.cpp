#include "app/display/make_display.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <set>

#include "app/display/display_format.h"
#include "app/display/exact_faces.h"
#include "base/error.h"
#include "base/parallel.h"
#include "segment/io/formats/unpack.h"
#include "segment/mesh/triangle_tree.h"
#include "tests/app/display/cut_shapes.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

DisplayMesh mesh_of(const DisplayFile& file) {
    const Bytes bytes = gunzip(file.packed, "test");
    EXPECT_EQ(display_id(bytes), file.id);
    return decode_display_mesh(bytes);
}

std::vector<Piece> pieces_of(const std::vector<TriangleMesh>& meshes) {
    std::vector<Piece> pieces;
    for (const TriangleMesh& mesh : meshes) pieces.push_back(piece_of(mesh));
    return pieces;
}

// 245,000 faces, more than are shown of it.
const TriangleMesh& large_torus() {
    static const TriangleMesh torus = bumpy_torus(350);
    return torus;
}

const std::vector<Piece>& large_pieces() {
    static const std::vector<Piece> pieces = pieces_of(parts_of(large_torus()));
    return pieces;
}

// Corners and middles of the faces of `shown`.
double farthest_from(const DisplayMesh& shown, const TriangleMesh& exact) {
    const TriangleTree tree(exact);
    double farthest = 0;
    for (const Triangle& t : shown.triangles) {
        Vec3 sum;
        for (const std::uint32_t corner : t) {
            const Vec3 p = place(shown.grid, shown.points[corner]);
            farthest = std::max(farthest, tree.nearest(exact, p).distance);
            sum = sum + p;
        }
        farthest = std::max(farthest, tree.nearest(exact, 1.0 / 3 * sum).distance);
    }
    return farthest;
}

TEST(MakeDisplay, ASmallScanKeepsEveryFace) {
    for (const shapes::Named& shape : awkward_shapes()) {
        const DisplayFile file = display_scan(shape.mesh, {});
        EXPECT_EQ(mesh_of(file), display_mesh(shape.mesh, display_grid(bounds(shape.mesh)))) << shape.name;
        EXPECT_LE(file.deviation_mm, 1e-4 * norm(bounds(shape.mesh).size()));
    }
}

TEST(MakeDisplay, ALargeScanHasAboutSoManyFacesAndTheStatedDeviation) {
    const DisplayFile file = display_scan(large_torus(), {});
    const DisplayMesh shown = mesh_of(file);
    EXPECT_GT(shown.triangles.size(), display_faces * 8 / 10);
    EXPECT_LT(shown.triangles.size(), display_faces * 12 / 10);
    EXPECT_LE(farthest_from(shown, large_torus()), file.deviation_mm);
    EXPECT_LT(file.packed.size(), 388'000U);
}

TEST(MakeDisplay, PiecesHaveTheirShareOfTheFacesAndTheStatedDeviation) {
    const std::vector<Piece>& pieces = large_pieces();
    ASSERT_GE(pieces.size(), 4U);
    const std::vector<DisplayFile> files = display_pieces(pieces, bounds(large_torus()), {});
    ASSERT_EQ(files.size(), pieces.size());
    std::size_t faces = 0;
    std::set<double> origins;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const DisplayMesh shown = mesh_of(files[i]);
        faces += shown.triangles.size();
        EXPECT_EQ(shown.grid, display_grid(bounds(large_torus())));
        EXPECT_GE(shown.triangles.size(), min_display_faces * 9 / 10);
        EXPECT_LE(farthest_from(shown, *pieces[i].mesh), files[i].deviation_mm);
    }
    EXPECT_LT(faces, display_faces * 101 / 100);
    EXPECT_GT(faces, display_faces * 90 / 100);
}

TEST(MakeDisplay, CapsStayWholeAndMeet) {
    const std::vector<Piece> pieces = pieces_of(halves_of(large_torus(), 7, {0.61, 0.31, 0.83}));
    const std::vector<DisplayFile> files = display_pieces(pieces, bounds(large_torus()), {});
    const DisplayGrid grid = display_grid(bounds(large_torus()));
    std::vector<std::multiset<std::set<DisplayPoint>>> caps(2);
    for (std::size_t i = 0; i < 2; ++i) {
        const DisplayMesh shown = mesh_of(files[i]);
        const DisplayMesh whole = display_mesh(*pieces[i].mesh, grid);
        ASSERT_EQ(shown.groups.size(), 2U);
        EXPECT_LT(shown.groups[0].faces, whole.groups[0].faces);
        EXPECT_EQ(shown.groups[1].faces, whole.groups[1].faces);
        for (std::uint32_t t = shown.groups[1].first; t < shown.triangles.size(); ++t) {
            const Triangle& c = shown.triangles[t];
            caps[i].insert({shown.points[c[0]], shown.points[c[1]], shown.points[c[2]]});
        }
    }
    EXPECT_GT(caps[0].size(), 100U);
    EXPECT_EQ(caps[0], caps[1]);
}

TEST(MakeDisplay, ACutChangesNoOtherPiece) {
    const std::vector<TriangleMesh> halves = halves_of(large_torus(), 1, {0.61, 0.31, 0.83});
    const std::vector<TriangleMesh> parts = halves_of(halves[1], 2, {0.83, -0.47, 0.23});
    const Box box = bounds(large_torus());
    const std::string before = display_pieces(pieces_of(halves), box, {})[0].id;
    EXPECT_EQ(display_pieces(pieces_of({halves[0], parts[0], parts[1]}), box, {})[0].id, before);
}

TEST(MakeDisplay, AFragmentThatIsLeftOutChangesNoPiece) {
    std::vector<TriangleMesh> halves = halves_of(large_torus(), 1, {0.61, 0.31, 0.83});
    const Box box = bounds(large_torus());
    const std::vector<DisplayFile> without = display_pieces(pieces_of(halves), box, {});
    halves.push_back(shapes::ball(box.centre(), 0.3));
    const std::vector<DisplayFile> with = display_pieces(pieces_of(halves), box, {});
    for (std::size_t i = 0; i < without.size(); ++i) EXPECT_EQ(with[i], without[i]);
}

TEST(MakeDisplay, PiecesThatHaveFewEnoughFacesStayWhole) {
    const std::vector<Piece> pieces = pieces_of(parts_of(bumpy_torus(45)));
    const Box box = bounds(bumpy_torus(45));
    const std::vector<DisplayFile> files = display_pieces(pieces, box, {});
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_EQ(mesh_of(files[i]), display_mesh(*pieces[i].mesh, display_grid(box)));
    }
}

TEST(MakeDisplay, StatesAreThoseOfTheTrianglesThatAreShown) {
    const Piece& piece = large_pieces()[0];
    std::vector<SurfaceState> states;
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        states.push_back(static_cast<SurfaceState>(corners_of(*piece.mesh, t)[0].z > 0 ? t % 3 : 4));
    }
    const MilledPiece milled{states, 1};
    const DisplayFile file = display_pieces(std::span(&piece, 1), bounds(large_torus()), {})[0];
    const DisplayFile made = display_states(file, *piece.mesh, milled, {});
    const Bytes bytes = gunzip(made.packed, "test");
    EXPECT_EQ(display_id(bytes), made.id);
    const DisplayStates read = decode_display_states(bytes);
    EXPECT_EQ(read.mesh, file.id);
    const DisplayMesh shown = mesh_of(file);
    const std::vector<std::uint32_t> exact = exact_faces(shown, *piece.mesh);
    const std::vector<std::uint8_t> expected = surface_states(*piece.mesh, milled);
    ASSERT_EQ(read.faces.size(), shown.triangles.size());
    for (std::size_t t = 0; t < read.faces.size(); ++t) EXPECT_EQ(read.faces[t], expected[exact[t]]);
    ASSERT_EQ(shown.groups.at(1).cut, 1);
    EXPECT_EQ(read.faces[shown.groups[1].first], base_state);
    EXPECT_EQ(std::set<std::uint8_t>(read.faces.begin(), read.faces.end()), (std::set<std::uint8_t>{0, 1, 2, 4, 6}));
}

TEST(MakeDisplay, WithoutStatesAllIsReached) {
    const Piece& piece = large_pieces()[0];
    const DisplayFile file = display_pieces(std::span(&piece, 1), bounds(large_torus()), {})[0];
    const DisplayStates read = decode_display_states(gunzip(display_states(file, *piece.mesh, {}, {}).packed, "test"));
    EXPECT_EQ(std::set<std::uint8_t>(read.faces.begin(), read.faces.end()), (std::set<std::uint8_t>{0}));
}

TEST(MakeDisplay, AnyNumberOfThreadsGivesTheSameBytes) {
    std::vector<std::vector<DisplayFile>> results;
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        std::vector<DisplayFile> made = display_pieces(large_pieces(), bounds(large_torus()), {});
        made.push_back(display_scan(large_torus(), {}));
        made.push_back(display_states(made[0], *large_pieces()[0].mesh, {}, {}));
        results.push_back(made);
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST(MakeDisplay, FromTheCacheItIsTheSameAndIsFoundByItsId) {
    const Folder folder;
    const TriangleMesh torus = bumpy_torus(45);
    const std::vector<Piece> pieces = pieces_of(parts_of(torus));
    const DisplayFile scan = display_scan(torus, folder.path);
    EXPECT_EQ(scan, display_scan(torus, {}));
    EXPECT_EQ(scan, display_scan(torus, folder.path));
    EXPECT_EQ(kept_display(folder.path, DisplayKind::mesh, scan.id), scan.packed);
    const std::vector<DisplayFile> files = display_pieces(pieces, bounds(torus), folder.path);
    EXPECT_EQ(files, display_pieces(pieces, bounds(torus), folder.path));
    EXPECT_EQ(files, display_pieces(pieces, bounds(torus), {}));
    for (const DisplayFile& file : files) {
        EXPECT_EQ(kept_display(folder.path, DisplayKind::mesh, file.id), file.packed);
    }
    Box other = bounds(torus);
    other.max.x += 5;
    EXPECT_NE(display_pieces(pieces, other, folder.path)[0].id, files[0].id) << "another grid";
    const DisplayFile reached = display_states(files[0], *pieces[0].mesh, {}, folder.path);
    const DisplayFile based = display_states(files[0], *pieces[0].mesh, {{}, 1}, folder.path);
    EXPECT_NE(reached.id, based.id) << "other states";
    EXPECT_EQ(reached, display_states(files[0], *pieces[0].mesh, {}, folder.path));
    EXPECT_EQ(kept_display(folder.path, DisplayKind::states, based.id), based.packed);
}

TEST(MakeDisplay, AnOpenOrEmptyOrFlatScanIsShown) {
    TriangleMesh open = shapes::ball({0, 0, 0}, 30);
    open.triangles.resize(open.triangles.size() / 2);
    EXPECT_FALSE(mesh_of(display_scan(open, {})).triangles.empty());
    EXPECT_TRUE(mesh_of(display_scan({}, {})).triangles.empty());
    TriangleMesh place{std::vector<Vec3>(3, {1, 2, 3}), {{0, 1, 2}, {0, 0, 1}}, {}};
    EXPECT_TRUE(mesh_of(display_scan(place, {})).triangles.empty());
    place.points[1].x = 1e308;
    place.points[2].x = -1e308;
    EXPECT_THROW(display_scan(place, {}), InputError);
}

TEST(MakeDisplay, ItIsCancelledAndReportsItsProgress) {
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(display_scan(large_torus(), {}, context), Cancelled);
    EXPECT_THROW(display_pieces(large_pieces(), bounds(large_torus()), {}, context), Cancelled);
    std::size_t done = 0;
    Context reporting;
    reporting.on_progress = [&](const Progress& p) { done = p.done; };
    display_pieces(large_pieces(), bounds(large_torus()), {}, reporting);
    EXPECT_EQ(done, large_pieces().size());
}

}  // namespace
}  // namespace qchopper
