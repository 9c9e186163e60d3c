// Pieces for the tests of this folder: shapes that were really cut, and a cell to mill them in.

#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cam/cell/cell.h"
#include "segment/cut/cut_piece.h"
#include "tests/shapes.h"

namespace qchopper::test_pieces {

inline Piece uncut(TriangleMesh mesh) {
    return {"A", std::make_shared<TriangleMesh>(std::move(mesh)), {}};
}

// The bottom of an axis-parallel box made the cap of a cut.
inline Piece standing_box(Vec3 min, Vec3 max, std::int32_t cut, int n = 1) {
    TriangleMesh mesh = shapes::box(min, max, n);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        mesh.cap_of.push_back(area_vector(mesh, t).z < 0 ? cut : no_cap);
    }
    return {"A", std::make_shared<TriangleMesh>(mesh), {{cut, {{0, 0, 1}, min.z}, true}}};
}

// All closed shapes cut by three skew planes near their middles.
inline std::vector<Piece> cut_shapes() {
    std::vector<Piece> all;
    for (const shapes::Named& shape : shapes::all_closed()) {
        std::vector<Piece> pieces{uncut(shape.mesh)};
        const Vec3 middle = bounds(shape.mesh).centre();
        const std::vector<Vec3> normals{{0.61, 0.31, 0.83}, {0.83, -0.47, 0.23}, {0.29, 0.93, -0.11}};
        for (std::size_t cut = 0; cut < normals.size(); ++cut) {
            const Plane plane = canonical({normals[cut], dot(normals[cut], middle) + 0.01317});
            std::vector<Piece> next;
            for (const Piece& piece : pieces) {
                const auto fallen = cut_piece(piece, plane, static_cast<std::int32_t>(cut));
                if (!fallen) next.push_back(piece);
                if (fallen) next.insert(next.end(), fallen->pieces.begin(), fallen->pieces.end());
            }
            pieces = next;
        }
        for (Piece& piece : pieces) {
            piece.name = shape.name;
            all.push_back(piece);
        }
    }
    return all;
}

inline Piece rotated(const Piece& piece, Vec3 axis, double angle_rad, Vec3 shift) {
    Piece turned = piece;
    turned.mesh = std::make_shared<TriangleMesh>(shapes::moved(shapes::rotated(*piece.mesh, axis, angle_rad), shift));
    for (HalfSpace& half_space : turned.half_spaces) {
        TriangleMesh normal;
        normal.points = {half_space.plane.normal};
        half_space.plane.normal = shapes::rotated(normal, axis, angle_rad).points[0];
        half_space.plane.offset += dot(half_space.plane.normal, shift);
    }
    return turned;
}

inline Cell cell() {
    Cell cell;
    cell.name = "test";
    cell.id = 1;
    cell.workspace = {{-1000, -1000, 0}, {1000, 1000, 1000}};
    cell.table = {0, 0, 1500, 1200, 100};
    cell.stock = {{"small", {100, 60, 50}, Material::eps},
                  {"flat", {400, 300, 60}, Material::pu_foam},
                  {"tall", {200, 200, 400}, Material::pu_foam}};
    cell.margins = {5, 5, 0};
    cell.clearance = 20;
    cell.tool = {1, "ball", 20, 18000, 9000, 24000};
    return cell;
}

}  // namespace qchopper::test_pieces
