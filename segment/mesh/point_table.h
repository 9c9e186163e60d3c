// A hash table that finds the first of equal points.
//
// Open addressing with linear probing, at most 70 % full; a slot holds the upper half of the hash, so that points are
// compared only where they are almost surely equal. Precondition: no coordinate is -0.0, which equals 0.0 but has
// another hash; positive_zeros() replaces it. O(1) per point on average; 8 bytes per slot.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/huge_pages.h"
#include "base/vec3.h"

namespace qchopper {

// The same point with 0.0 for -0.0: -0.0 + 0.0 is 0.0, and every other number stays.
inline Vec3 positive_zeros(Vec3 p) {
    return p + Vec3{};
}

class PointTable {
 public:
    // `points` is the number of points expected; with more the table grows.
    explicit PointTable(std::size_t points) { slots_ = slots_for(points); }

    // Both halves are well mixed, by the finalizer of SplitMix64: the lower one selects the slot, the upper one is
    // stored.
    static std::uint64_t hash_of(Vec3 p) {
        std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15U;
        h ^= std::rotl(std::bit_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fU, 21);
        h ^= std::rotl(std::bit_cast<std::uint64_t>(p.z) * 0x165667b19e3779f9U, 43);
        h ^= h >> 30;
        h *= 0xbf58476d1ce4e5b9U;
        h ^= h >> 27;
        h *= 0x94d049bb133111ebU;
        return h ^ h >> 31;
    }

    std::size_t size() const { return size_; }

    // Loads the slot into the cache for a call of find_or_note a little later.
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }

    // Returns the number under which a point equal to p is stored; if there is none, stores p under `number` and
    // returns that. `hash` is hash_of(p), and points[n] the point stored under n.
    std::uint32_t find_or_note(const std::vector<Vec3>& points, Vec3 p, std::uint64_t hash, std::uint32_t number) {
        if (10 * size_ >= 7 * slots_.size()) widen(points, 2 * size_);
        const auto tag = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t at = hash & (slots_.size() - 1);; at = (at + 1) & (slots_.size() - 1)) {
            Slot& slot = slots_[at];
            if (slot.point == none) {
                slot = {number, tag};
                ++size_;
                return number;
            }
            if (slot.tag == tag && points[slot.point] == p) return slot.point;
        }
    }

    // Makes the table large enough for so many points in all.
    void widen(const std::vector<Vec3>& points, std::size_t to_points) {
        std::vector<Slot> old = slots_for(to_points);
        if (old.size() <= slots_.size()) return;
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.point == none) continue;
            std::size_t at = hash_of(points[slot.point]) & (slots_.size() - 1);
            while (slots_[at].point != none) at = (at + 1) & (slots_.size() - 1);
            slots_[at] = slot;
        }
    }

 private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    struct Slot {
        std::uint32_t point = none;
        std::uint32_t tag = 0;
    };

    static std::vector<Slot> slots_for(std::size_t points) {
        return huge<Slot>(std::bit_ceil(points + points / 2 + 16));
    }

    std::vector<Slot> slots_;
    std::size_t size_ = 0;
};

}  // namespace qchopper
