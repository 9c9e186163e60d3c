// What many tests need of pieces: a whole mesh as one, and directions to cut it along.

#pragma once

#include <memory>
#include <random>
#include <utility>

#include "segment/cut/piece.h"

namespace qchopper {

inline Piece piece_of(TriangleMesh mesh) {
    Piece piece;
    piece.name = "A";
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    return piece;
}

// Evenly spread over all directions; canonical (plane.h).
inline Vec3 random_normal(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    const double z = normal(random);
    return canonical({normalized({x, y, z}), 0}).normal;
}

}  // namespace qchopper
