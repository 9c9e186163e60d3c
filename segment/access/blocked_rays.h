// Samples that are blocked along each of some directions, and how far along any normal their rays get.
//
// mm. Held in blocks of alike normals, so that one pass over a block's directions serves all its samples side by side
// (tests/segment/access/blocked_rays_test.cpp).

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "segment/access/unreachable.h"

namespace qchopper {

class BlockedRays {
 public:
    // From a sample to its hit along a direction, given by its index: mm; 0: blocked at once.
    using Distance = std::function<float(std::uint32_t row, std::uint32_t direction)>;

    // `rows` are rows of the piece. O(rows x directions).
    BlockedRays(const JudgedPiece& piece, std::vector<std::uint32_t> rows, std::vector<Vec3> directions,
                const Distance& distance);

    const std::vector<std::uint32_t>& rows() const { return rows_; }  // in the order of the blocks
    const std::vector<Vec3>& directions() const { return directions_; }

    // Per entry of rows(), along the normal from the sample: the highest end of its rays, at least 0, and the lowest,
    // at most 0.
    struct Ends {
        std::vector<float> highest;
        std::vector<float> lowest;
    };
    // O(rows x directions along which a sample of the block is not blocked at once).
    Ends ends(Vec3 normal) const;

 private:
    std::vector<std::uint32_t> rows_;
    std::vector<Vec3> directions_;
    // Per block the directions along which one of its samples has a distance, and these distances.
    std::vector<std::uint32_t> first_slot_{0};  // per block, and the end
    std::vector<std::uint32_t> direction_;      // per slot
    std::vector<float> distance_;               // slots x samples of a block
};

}  // namespace qchopper
