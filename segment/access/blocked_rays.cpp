// A sample's ends are the largest and the smallest of distance x slope over its directions.

#include "segment/access/blocked_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace qchopper {
namespace {

constexpr std::size_t lanes = 16;  // samples of a block

// Four numbers, for which compilers take one instruction; their own vectorising gives up here.
using Four = float __attribute__((vector_size(4 * sizeof(float))));
static_assert(lanes % 4 == 0);

// Sorts alike normals together.
std::array<int, 3> rough(Vec3 normal) {
    constexpr double steps = 3;
    return {static_cast<int>(std::lround(steps * normal.x)), static_cast<int>(std::lround(steps * normal.y)),
            static_cast<int>(std::lround(steps * normal.z))};
}

}  // namespace

BlockedRays::BlockedRays(const JudgedPiece& piece, std::vector<std::uint32_t> rows, std::vector<Vec3> directions,
                         const Distance& distance)
    : rows_(std::move(rows)), directions_(std::move(directions)) {
    std::stable_sort(rows_.begin(), rows_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return rough(piece.sample(a).normal) < rough(piece.sample(b).normal);
    });
    for (std::size_t first = 0; first < rows_.size(); first += lanes) {
        const std::size_t count = std::min(lanes, rows_.size() - first);
        for (std::uint32_t d = 0; d < directions_.size(); ++d) {
            std::array<float, lanes> of_samples{};
            for (std::size_t lane = 0; lane < count; ++lane) of_samples[lane] = distance(rows_[first + lane], d);
            if (std::all_of(of_samples.begin(), of_samples.end(), [](float t) { return t == 0; })) continue;
            direction_.push_back(d);
            distance_.insert(distance_.end(), of_samples.begin(), of_samples.end());
        }
        first_slot_.push_back(static_cast<std::uint32_t>(direction_.size()));
    }
}

BlockedRays::Ends BlockedRays::ends(Vec3 normal) const {
    std::vector<float> slope;
    slope.reserve(directions_.size());
    for (const Vec3& d : directions_) slope.push_back(static_cast<float>(dot(normal, d)));
    const std::size_t blocks = first_slot_.size() - 1;
    Ends ends{std::vector<float>(blocks * lanes), std::vector<float>(blocks * lanes)};
    for (std::size_t block = 0; block < blocks; ++block) {
        std::array<Four, lanes / 4> highest{};
        std::array<Four, lanes / 4> lowest{};
        for (std::uint32_t slot = first_slot_[block]; slot < first_slot_[block + 1]; ++slot) {
            const float* distance = distance_.data() + slot * lanes;
            const float of_slot = slope[direction_[slot]];
            for (std::size_t i = 0; i < lanes / 4; ++i) {
                Four end;
                std::memcpy(&end, distance + 4 * i, sizeof end);
                end *= of_slot;
                highest[i] = end > highest[i] ? end : highest[i];
                lowest[i] = end < lowest[i] ? end : lowest[i];
            }
        }
        std::memcpy(ends.highest.data() + block * lanes, highest.data(), sizeof highest);
        std::memcpy(ends.lowest.data() + block * lanes, lowest.data(), sizeof lowest);
    }
    ends.highest.resize(rows_.size());
    ends.lowest.resize(rows_.size());
    return ends;
}

}  // namespace qchopper
