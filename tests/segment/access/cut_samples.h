// Specimens of few faces, whole and after two cuts, each piece with a direction: where fast evaluations are held to
// cutting.

#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/pieces.h"

namespace qchopper {

struct SampleCut {
    std::string name;
    Piece piece;
    Vec3 normal;
    double piece_size = 0;  // diagonal of its box
};

// The second cut parts the largest piece of the first one, so that it goes through a cap. To make a skull
// takes some seconds.
inline std::vector<SampleCut> cut_samples(const std::vector<Specimen>& specimens) {
    std::vector<SampleCut> all;
    std::mt19937 random(61);
    const auto add = [&](const std::string& name, const Piece& piece) {
        all.push_back({name, piece, random_normal(random), norm(bounds(*piece.mesh).size())});
    };
    for (const Specimen specimen : specimens) {
        const std::string name = specimen == Specimen::skull   ? "skull"
                                 : specimen == Specimen::femur ? "femur"
                                                               : "vertebra";
        SampleOptions options;
        options.faces = specimen == Specimen::skull ? 5'000 : 2'400;
        Piece piece = piece_of(sample(specimen, options));
        add(name, piece);
        std::vector<Piece> pieces;
        for (std::int32_t cut = 1; cut <= 2; ++cut) {
            const Vec3 n = random_normal(random);
            const Extent range = extent(*piece.mesh, n);
            const auto nudged = nudge(piece, n, std::array{range.low + 0.45 * range.size()});
            auto made = cut_piece(piece, {n, nudged[0]->offset}, cut);
            std::sort(made->pieces.begin(), made->pieces.end(), [](const Piece& a, const Piece& b) {
                return a.mesh->triangles.size() > b.mesh->triangles.size();
            });
            piece = made->pieces.front();
            pieces.insert(pieces.end(), made->pieces.begin() + (cut == 1 ? 1 : 0), made->pieces.end());
        }
        for (const Piece& part : pieces) {
            if (part.mesh->triangles.size() >= 40) add("part of " + name, part);
        }
    }
    return all;
}

}  // namespace qchopper
