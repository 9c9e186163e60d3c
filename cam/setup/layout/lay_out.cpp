// Turns are tried in the order of their cost (flush_caps.h) until a block fits: of each the piece is put into a block
// of the stock, then turned by a quarter. O(turns x points).

#include "cam/setup/layout/lay_out.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "cam/setup/stock_fit.h"
#include "segment/mesh/footprint.h"

namespace qchopper {
namespace {

// Precondition: the mesh has points.
Box bounds_in(const Pose& piece_in_setup, const TriangleMesh& mesh) {
    Box box{apply(piece_in_setup, mesh.points.front()), apply(piece_in_setup, mesh.points.front())};
    for (const Vec3& p : mesh.points) extend(box, apply(piece_in_setup, p));
    return box;
}

// Lays a direction of the piece's footprint along x, then puts the piece on z = 0 with its box in the middle.
void place(const TriangleMesh& mesh, Point2 along, Setup& setup) {
    const auto [e1, e2] = frame_under(setup.up);
    const Vec3 x = normalized(along.x * e1 + along.y * e2);
    setup.piece_in_setup = {{x, cross(setup.up, x), setup.up}, {}};
    const Box turned = bounds_in(setup.piece_in_setup, mesh);
    const Vec3 middle = turned.centre();
    setup.piece_in_setup.shift = -Vec3{middle.x, middle.y, turned.min.z};
    setup.box = bounds_in(setup.piece_in_setup, mesh);
    assert(std::abs(setup.box.min.z) < 1e-6);
}

// By a quarter turn about z: the short side along x.
void turn(Setup& setup) {
    Pose& pose = setup.piece_in_setup;
    pose = {{pose.row[1], -pose.row[0], pose.row[2]}, {pose.shift.y, -pose.shift.x, pose.shift.z}};
    const Box box = setup.box;
    setup.box = {{box.min.y, -box.max.x, box.min.z}, {box.max.y, -box.min.x, box.max.z}};
}

void describe(Setup& setup) {
    if (setup.base) {
        setup.base_description = "the cap of cut " + std::to_string(*setup.base);
        return;
    }
    setup.base_description =
        "no cap: side " + std::to_string(setup.base_number) + " of its box, bedded on the foam that is left under it";
    setup.warnings.push_back("the piece has no flat cap to lie on: keep it held from below");
}

// The cell without the stock that is not sawn and does not stand in it; the numbers of the rest stay.
Cell with_standing_stock(const Cell& cell) {
    const Vec3 most = largest_block(cell);
    const auto stands = [&](Vec3 size) { return size.x <= most.x && size.y <= most.y && size.z <= most.z; };
    Cell standing = cell;
    for (Stock& stock : standing.stock) {
        const Vec3 size = stock.size;
        if (!stock.is_sawn && !stands(size) && !stands({size.y, size.x, size.z})) stock.size = {};  // holds nothing
    }
    return standing;
}

// The block for a piece that lies in the middle, and the piece against the faces of it that are flush.
void choose_block_for(std::span<const CapPoints> caps, const Cell& stocked, Setup& setup) {
    setup.flush_caps = flush_caps(caps, setup.piece_in_setup, setup.box, setup.base, stocked.saw.flush_tolerance);
    FlushBlock chosen = choose_flush_block(stocked, setup.box.size(), area_at_faces(setup.flush_caps));
    setup.block = std::move(chosen.block);
    const FlushFaces& flush = chosen.flush;
    std::erase_if(setup.flush_caps, [&](const FlushCap& cap) { return !flush[static_cast<std::size_t>(cap.face)]; });
    setup.milled_caps_mm2 = 0;
    for (const CapPoints& cap : caps) setup.milled_caps_mm2 += setup.is_unmilled(cap.cut) ? 0 : cap.area_mm2;
    for (int axis = 0; axis < 2; ++axis) {
        const bool at_min = flush[2 * static_cast<std::size_t>(axis)];
        if (at_min == flush[2 * static_cast<std::size_t>(axis) + 1]) continue;
        const double foam = 0.5 * (setup.block.size[axis] - setup.box.size()[axis]);
        const double by = at_min ? -foam : foam;
        setup.piece_in_setup.shift[axis] += by;
        setup.box.min[axis] += by;
        setup.box.max[axis] += by;
    }
}

// The piece in one turn. It is turned by a quarter where its block fits into the cell only so; where an unsawn one fits
// in neither way, other stock is asked for. The first way if none fits.
Setup laid_along(const Piece& piece, Point2 along, const Cell& cell, std::span<const CapPoints> caps, Setup setup) {
    place(*piece.mesh, along, setup);
    Setup turned = setup;
    turn(turned);
    std::vector<Cell> stocked{cell};
    if (Cell standing = with_standing_stock(cell); standing.stock != cell.stock) stocked.push_back(std::move(standing));
    std::optional<Setup> first;
    for (const Cell& with : stocked) {
        for (const Setup* way : {&setup, &turned}) {
            Setup lying = *way;
            choose_block_for(caps, with, lying);
            if (check_stock_fit(lying, cell).fits()) return lying;
            if (!first) first = std::move(lying);
        }
    }
    return *first;
}

}  // namespace

std::vector<CapPoints> caps_to_saw(const TriangleMesh& mesh, const Cell& cell) {
    return is_any_sawn(cell) ? caps_with_points(mesh) : std::vector<CapPoints>();
}

Setup lay_out(const Piece& piece, const PieceBase& base, const Cell& cell, std::span<const CapPoints> caps) {
    Setup setup;
    setup.base_number = base.number;
    setup.base = base.base.cut;
    setup.up = base.base.up;
    setup.base_mm2 = base.base_mm2;
    setup.projected_area_mm2 = base.projected_mm2;
    describe(setup);
    setup.spoil = margins_of(cell).spoil;
    if (!setup.base) caps = {};
    std::optional<Setup> first;
    for (const Point2& along :
         turns_to_try(caps, piece.mesh->points, setup.up, setup.base, margins_of(cell), cell.saw.flush_tolerance)) {
        Setup laid = laid_along(piece, along, cell, caps, setup);
        if (check_stock_fit(laid, cell).fits()) return laid;
        if (!first) first = std::move(laid);
    }
    return *first;
}

}  // namespace qchopper
