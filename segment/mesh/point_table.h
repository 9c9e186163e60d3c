// Finds the first of equal points, by hash.
//
// Open addressing; a slot holds a part of the hash, so that points are compared only where they are almost surely
// equal. 0.0 and -0.0 are equal but hash differently: whoever asks makes one of them first (positive_zeros).

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/huge_pages.h"
#include "base/vec3.h"

namespace qchopper {

// -0.0 + 0.0 is 0.0; every other number stays.
inline Vec3 positive_zeros(Vec3 p) {
    return p + Vec3{};
}

class PointTable {
 public:
    // How many points it will hold, about: with more it widens itself.
    explicit PointTable(std::size_t points) { slots_ = slots_for(points); }

    // Both halves are mixed well: one names the slot, the other is kept in it.
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

    // So that the slot is there when it is asked for a little later.
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }

    // The number under which a point equal to p was noted; if there is none, p is noted under `number` and that is the
    // answer. points[n] is the point noted under n.
    std::uint32_t find_or_note(const std::vector<Vec3>& points, Vec3 p, std::uint64_t hash, std::uint32_t number) {
        if (10 * size_ >= 7 * slots_.size()) widen(points, 2 * size_);
        const auto mark = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t at = hash & (slots_.size() - 1);; at = (at + 1) & (slots_.size() - 1)) {
            Slot& slot = slots_[at];
            if (slot.point == nobody) {
                slot = {number, mark};
                ++size_;
                return number;
            }
            if (slot.mark == mark && points[slot.point] == p) return slot.point;
        }
    }

    // Makes room for so many points in all.
    void widen(const std::vector<Vec3>& points, std::size_t to_points) {
        std::vector<Slot> old = slots_for(to_points);
        if (old.size() <= slots_.size()) return;
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.point == nobody) continue;
            std::size_t at = hash_of(points[slot.point]) & (slots_.size() - 1);
            while (slots_[at].point != nobody) at = (at + 1) & (slots_.size() - 1);
            slots_[at] = slot;
        }
    }

 private:
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    struct Slot {
        std::uint32_t point = nobody;
        std::uint32_t mark = 0;
    };

    static std::vector<Slot> slots_for(std::size_t points) {
        std::vector<Slot> slots;
        const std::size_t count = std::bit_ceil(points + points / 2 + 16);
        reserve_huge(slots, count);
        slots.resize(count);
        return slots;
    }

    std::vector<Slot> slots_;
    std::size_t size_ = 0;
};

}  // namespace qchopper
