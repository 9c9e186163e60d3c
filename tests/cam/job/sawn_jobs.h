// Jobs of pieces whose caps are faces of their blocks: a ball cut around its middle, in a cell whose stock may be sawn.

#pragma once

#include <random>
#include <string>
#include <vector>

#include "cam/job/job_caps.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/stock_fit.h"
#include "tests/cam/job/some_job.h"
#include "tests/segment/joint/cut_pieces.h"

namespace qchopper::test_pieces {

inline Cell sawn_cell() {
    Cell sawn = cell();
    sawn.stock = {{"sheet", {1000, 600, 500}, Material::pu_foam, true, 3}};
    sawn.margins = {5, 3, 10};
    return sawn;
}

struct SawnJobs {
    Segmentation segmentation;
    std::vector<PieceJoint> joints;
    std::vector<JobInput> inputs;  // one per piece
    std::size_t middle = 0;        // the piece that the saw alone makes: a cube of 66 mm
};

// Seven pieces with one to six caps.
inline const SawnJobs& sawn_jobs() {
    static const SawnJobs all = [] {
        SawnJobs made;
        made.segmentation = uncut(shapes::ball({0, 0, 0}, 100, 24), 0);
        std::string in_the_middle = "A";
        const auto has_the_middle = [](const Piece& piece) {
            const Box box = bounds(*piece.mesh);
            return box.min.x < 0 && box.max.x > 0 && box.min.y < 0 && box.max.y > 0 && box.min.z < 0 && box.max.z > 0;
        };
        for (const double offset : {-33.0, 33.0}) {
            for (const Vec3 normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                EXPECT_TRUE(cut_at(made.segmentation, in_the_middle, {normal, offset}));
                for (const Piece& piece : made.segmentation.pieces) {
                    if (has_the_middle(piece)) in_the_middle = piece.name;
                }
            }
        }
        const std::vector<Piece>& pieces = made.segmentation.pieces;
        made.joints = piece_joints(pieces, {});
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (pieces[p].name == in_the_middle) made.middle = p;
            JobInput input = some_job();
            input.cell = sawn_cell();
            input.piece = pieces[p];
            input.piece_no = static_cast<std::uint16_t>(p + 1);
            input.piece_count = static_cast<std::uint16_t>(pieces.size());
            SetupOptions options;
            options.mapped = 0;
            options.samples = 400;
            input.setup = choose_setup(pieces[p], input.cell, options).setups.front();
            input.stock_fit = check_stock_fit(input.setup, input.cell);
            input.caps = caps_of(pieces, p, made.joints, input.setup, input.cell);
            decide_holes(input.caps, {}, {}, "there is no program");
            made.inputs.push_back(std::move(input));
        }
        return made;
    }();
    return all;
}

inline std::vector<JobCap> job_caps(const JobInput& input) {
    std::vector<JobCap> caps;
    for (const DrawnCap& drawn : input.caps) caps.push_back(drawn.cap);
    return caps;
}

}  // namespace qchopper::test_pieces
