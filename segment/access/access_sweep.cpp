// The new base: rays within 90 degrees of its up never meet the plane, so a sample's state is the same for all offsets
// and follows from sets of samples, one per direction, 64 samples a word. An old base: a sample that is open along none
// of its directions has an offset on either side from which on its rays leave through the plane, the largest and the
// smallest of distance x slope over the directions (blocked_rays.h). Per normal O(samples + samples x allowed
// directions / 64), and per old base O(blocked samples x allowed directions + edges of its cap).
//
// The height of a sample stands for that of its ray's origin, 1e-6 of the scan's diagonal off the surface.

#include "segment/access/access_sweep.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "segment/access/blocked_rays.h"
#include "segment/access/cap_outline.h"
#include "segment/access/offset_counts.h"
#include "segment/access/row_set.h"
#include "segment/access/sampled_piece.h"
#include "segment/access/up_column.h"
#include "segment/mesh/plane.h"

namespace qchopper {
namespace {

using RowSet = std::vector<Word>;

// A base that the piece has already.
struct OldBase {
    TiltBase base;
    std::vector<std::uint8_t> cap_out_of_reach;  // per cap
    // Samples blocked along all allowed directions; below steep_counts_from_deg without the steep ones.
    BlockedRays blocked;
    // Samples that face up and are blocked along it.
    struct BlockedUp {
        std::uint32_t row = 0;
        float distance = 0;
        double facing = 0;  // cosine between normal and up
    };
    std::vector<BlockedUp> blocked_up;
};

// Replaces each entry by the sum of those up to it.
template <class Number>
void sum_up(std::vector<Number>& values) {
    for (std::size_t i = 1; i < values.size(); ++i) values[i] += values[i - 1];
}

// What one base has of the samples on one side of all planes of a normal, one entry per offset.
struct SideSums {
    std::vector<double> unreachable;  // samples
    std::vector<double> projected;    // sum of cosines
};
struct BothSides {
    SideSums below;
    SideSums above;
};

}  // namespace

struct AccessSweep::Prepared {
    JudgedPiece judged;
    double tilt_deg;
    bool steep_counts;
    std::size_t rows;
    std::size_t words;
    std::vector<Vec3> point;   // per row
    std::vector<Vec3> normal;  // per row
    std::vector<Word> open;    // directions x words: a RowSet each
    std::vector<Word> steep;   // the same where steep samples do not count, or empty
    std::vector<CapOutline> caps;
    std::vector<OldBase> bases;
    std::vector<double> facing_up;  // rows x bases: cosine between normal and up where it is open, else 0

    Prepared(const Piece& piece, const JudgedPiece& judged_piece, double tilt)
        : judged(judged_piece),
          tilt_deg(tilt),
          steep_counts(tilt >= steep_counts_from_deg),
          rows(judged.accessibility.sample.size()),
          words(words_for(rows)),
          caps(outlines(*piece.mesh, judged.caps)),
          facing_up(rows * caps.size()) {
        for (std::size_t row = 0; row < rows; ++row) {
            point.push_back(judged.sample(row).point);
            normal.push_back(judged.sample(row).normal);
        }
        find_open();
        if (!steep_counts) find_steep();
        for (std::size_t c = 0; c < caps.size(); ++c) add_base(c);
    }

    std::size_t directions() const { return judged.scan.directions.size(); }
    std::span<const Word> open_along(std::size_t k) const { return {open.data() + k * words, words}; }
    std::span<const Word> steep_along(std::size_t k) const { return {steep.data() + k * words, words}; }

    void find_open() {
        open.resize(directions() * words);
        std::vector<Word> word(directions());
        for (std::size_t w = 0; w < words; ++w) {
            std::fill(word.begin(), word.end(), 0);
            const std::size_t end = std::min(word_bits, rows - w * word_bits);
            for (std::size_t bit = 0; bit < end; ++bit) {
                const float* distance = judged.accessibility.distances(w * word_bits + bit).data();
                for (std::size_t k = 0; k < word.size(); ++k) {
                    const bool is_open = distance[k] == std::numeric_limits<float>::infinity();
                    word[k] |= static_cast<Word>(is_open ? 1 : 0) << bit;
                }
            }
            for (std::size_t k = 0; k < word.size(); ++k) open[k * words + w] = word[k];
        }
    }

    void find_steep() {
        steep.resize(directions() * words);
        for (std::size_t k = 0; k < directions(); ++k) {
            const RowSet set = steep_to(judged.scan.directions[k]);
            std::copy(set.begin(), set.end(), steep.begin() + static_cast<std::ptrdiff_t>(k * words));
        }
    }

    RowSet steep_to(Vec3 direction) const {
        RowSet set(words);
        for (std::size_t row = 0; row < rows; ++row) {
            if (std::abs(dot(normal[row], direction)) < min_facing) set_bit(set, row);
        }
        return set;
    }

    // The samples that count where they are open along no allowed direction, and are.
    RowSet blocked(Vec3 up, std::span<const std::uint32_t> allowed, std::span<const Word> open_up) const {
        RowSet set(open_up.begin(), open_up.end());
        for (const std::uint32_t k : allowed) add_bits(set, open_along(k));
        if (!steep_counts) {
            add_bits(set, steep_to(up));
            for (const std::uint32_t k : allowed) add_bits(set, steep_along(k));
        }
        for (Word& word : set) word = ~word;
        if (rows % word_bits != 0) set.back() &= (Word{1} << (rows % word_bits)) - 1;
        return set;
    }

    // Of the scan, and up if it is none of them.
    std::vector<Vec3> directions_from(Vec3 up, std::span<const std::uint32_t> allowed) const {
        const std::vector<Vec3>& known = judged.scan.directions;
        std::vector<Vec3> directions;
        directions.reserve(allowed.size() + 1);
        for (const std::uint32_t k : allowed) directions.push_back(known[k]);
        if (index_of(known, up) == known.size()) directions.push_back(up);
        return directions;
    }

    // Each cap in turn is a base, so that bases and caps have the same numbers.
    void add_base(std::size_t cap) {
        const TiltBase base = lying_on(caps[cap].cap());
        const std::vector<std::uint32_t> allowed = allowed_directions(judged.scan.directions, base.up, tilt_deg);
        const std::vector<Vec3> directions = directions_from(base.up, allowed);
        const UpColumn column(judged.scan, judged.accessibility, base.up);
        std::vector<OldBase::BlockedUp> blocked_up;
        RowSet open_up(words);
        for (std::uint32_t row = 0; row < rows; ++row) {
            const float distance = column.distance(row);
            const double facing = dot(normal[row], base.up);
            if (std::isinf(distance)) {
                set_bit(open_up, row);
                facing_up[row * caps.size() + cap] = facing;
            } else if (distance > 0) {
                blocked_up.push_back({row, distance, facing});
            }
        }
        const RowSet set = blocked(base.up, allowed, open_up);
        std::vector<std::uint32_t> blocked_rows;
        for (std::uint32_t row = 0; row < rows; ++row) {
            if (has_bit(set, row)) blocked_rows.push_back(row);
        }
        const auto distance = [&](std::uint32_t row, std::uint32_t d) {
            return d < allowed.size() ? judged.accessibility.distances(row)[allowed[d]] : column.distance(row);
        };
        bases.push_back({base, caps_out_of_reach(base, directions),
                         BlockedRays(judged, std::move(blocked_rows), directions, distance), std::move(blocked_up)});
    }

    std::vector<std::uint8_t> caps_out_of_reach(const TiltBase& base, std::span<const Vec3> directions) const {
        std::vector<std::uint8_t> result;
        for (const CapOutline& c : caps) result.push_back(is_out_of_reach(c.cap(), base, directions) ? 1 : 0);
        return result;
    }
};

const SideOnBase& best_base(std::span<const SideOnBase> bases) {
    assert(!bases.empty());
    const bool one_is_stable =
        std::any_of(bases.begin(), bases.end(), [](const SideOnBase& b) { return b.is_stable(); });
    const SideOnBase* best = nullptr;
    for (const SideOnBase& b : bases) {
        if (one_is_stable && !b.is_stable()) continue;
        if (best == nullptr || b.unreachable_mm2 < best->unreachable_mm2) best = &b;
    }
    return *best;
}

// All planes of one normal.
class AccessSweep::PlaneSweep {
 public:
    PlaneSweep(const Prepared& prepared, Vec3 normal, std::span<const double> offsets)
        : p_(prepared), normal_(normal), offsets_(offsets), counts_(offsets), height_(p_.rows), planes_(p_.rows) {
        for (std::size_t row = 0; row < p_.rows; ++row) height_[row] = height(normal, p_.point[row]);
        counts_.at_most(height_, planes_);
        for (const CapOutline& c : p_.caps) cap_below_.push_back(c.area_below(normal, offsets));
    }

    std::vector<PlaneAccess> run() {
        std::vector<PlaneAccess> result(offsets_.size());
        add_new_base(result);
        if (!p_.bases.empty()) {
            const std::vector<double> open_up = open_up_sums();
            for (std::size_t b = 0; b < p_.bases.size(); ++b) add_old_base(result, b, open_up);
        }
        return result;
    }

 private:
    // The new base of one side.
    struct NewBase {
        std::vector<std::uint8_t> cap_out_of_reach;
        RowSet blocked;
        RowSet open_up;
    };

    NewBase new_base(Vec3 up) const {
        const std::vector<Vec3>& known = p_.judged.scan.directions;
        const std::vector<std::uint32_t> allowed = allowed_directions(known, up, p_.tilt_deg);
        const std::size_t k = index_of(known, up);
        NewBase base;
        if (k < known.size()) {
            const std::span<const Word> open_up = p_.open_along(k);
            base.open_up.assign(open_up.begin(), open_up.end());
        } else {
            base.open_up.resize(p_.words);
            const PieceRays rays(p_.judged.scan, p_.judged.accessibility);
            for (std::size_t row = 0; row < p_.rows; ++row) {
                if (std::isinf(rays.distance(row, up))) set_bit(base.open_up, row);
            }
        }
        base.cap_out_of_reach = p_.caps_out_of_reach({up, new_cut}, p_.directions_from(up, allowed));
        base.blocked = p_.blocked(up, allowed, base.open_up);
        return base;
    }

    // Per number of offsets at or below a sample: how many samples are blocked below and above, and the sums of the
    // cosines with the normal of those that are open along neither up, that below, and that above.
    struct Histogram {
        explicit Histogram(std::size_t offsets) : blocked(offsets + 1), cosine(offsets + 1) {}
        std::vector<std::array<std::uint32_t, 4>> blocked;  // neither, below, above, both
        std::vector<std::array<double, 4>> cosine;          // the last is not used
    };

    Histogram histogram(const NewBase& below, const NewBase& above) const {
        Histogram result(offsets_.size());
        for (std::size_t w = 0; w < p_.words; ++w) {
            Word blocked_below = below.blocked[w];
            Word blocked_above = above.blocked[w];
            Word open_below = below.open_up[w];
            Word open_above = above.open_up[w];
            const std::size_t end = std::min(p_.rows, (w + 1) * word_bits);
            for (std::size_t row = w * word_bits; row < end; ++row) {
                const std::uint32_t bin = planes_[row];
                ++result.blocked[bin][(blocked_below & 1) + 2 * (blocked_above & 1)];
                result.cosine[bin][(open_below & 1) + 2 * (open_above & 1)] += dot(normal_, p_.normal[row]);
                blocked_below >>= 1;
                blocked_above >>= 1;
                open_below >>= 1;
                open_above >>= 1;
            }
        }
        return result;
    }

    void add_new_base(std::vector<PlaneAccess>& result) {
        const NewBase below = new_base(-normal_);
        const NewBase above = new_base(normal_);
        const Histogram all = histogram(below, above);
        find_new_cap(all);
        std::uint32_t blocked_above = 0;
        double projected_above = 0;
        for (std::size_t bin = 0; bin <= offsets_.size(); ++bin) {
            blocked_above += all.blocked[bin][2] + all.blocked[bin][3];
            projected_above += all.cosine[bin][2];
        }
        std::uint32_t blocked_below = 0;
        double projected_below = 0;
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            blocked_below += all.blocked[j][1] + all.blocked[j][3];
            blocked_above -= all.blocked[j][2] + all.blocked[j][3];
            projected_below -= all.cosine[j][1];
            projected_above -= all.cosine[j][2];
            const auto side = [&](const NewBase& base, bool is_above, std::uint32_t blocked, double projected) {
                SideOnBase s;
                s.cut = new_cut;
                for (std::size_t c = 0; c < p_.caps.size(); ++c) {
                    if (base.cap_out_of_reach[c] != 0) s.caps_mm2 += cap_area(c, j, is_above);
                }
                s.unreachable_mm2 = area_each() * blocked + s.caps_mm2;
                s.base_mm2 = new_cap_[j];
                const double caps = caps_facing(is_above ? normal_ : -normal_, j, is_above);
                s.projected_mm2 = std::max(0.0, area_each() * projected) + caps;
                return s;
            };
            result[j].below.push_back(side(below, false, blocked_below, projected_below));
            result[j].above.push_back(side(above, true, blocked_above, projected_above));
        }
    }

    // The area vectors of what lies below, the new cap's included, add up to zero. What those of the whole piece lack,
    // because samples are few, is taken from the sum below by its share of the samples.
    void find_new_cap(const Histogram& all) {
        double lack = 0;
        for (const std::array<double, 4>& c : all.cosine) lack += area_each() * (c[0] + c[1] + c[2]);
        for (const CapOutline& c : p_.caps) lack += c.cap().area_mm2 * dot(normal_, c.cap().outward);
        new_cap_.resize(offsets_.size());
        double samples = 0;
        double below = 0;
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            for (const std::uint32_t count : all.blocked[j]) samples += count;
            below += area_each() * (all.cosine[j][0] + all.cosine[j][1] + all.cosine[j][2]);
            double sum = below;
            for (std::size_t c = 0; c < p_.caps.size(); ++c) {
                sum += cap_below_[c][j] * dot(normal_, p_.caps[c].cap().outward);
            }
            const double share = p_.rows > 0 ? samples / static_cast<double>(p_.rows) : 0;
            new_cap_[j] = std::max(0.0, share * lack - sum);
        }
    }

    // Per number of offsets at or below a sample, then per old base: the cosines of the samples open along its up.
    std::vector<double> open_up_sums() const {
        const std::size_t bases = p_.bases.size();
        std::vector<double> sums((offsets_.size() + 1) * bases);
        for (std::size_t row = 0; row < p_.rows; ++row) {
            double* sum = sums.data() + planes_[row] * bases;
            const double* facing = p_.facing_up.data() + row * bases;
            for (std::size_t b = 0; b < bases; ++b) sum[b] += facing[b];
        }
        return sums;
    }

    void add_old_base(std::vector<PlaneAccess>& result, std::size_t number, std::span<const double> open_up) const {
        const OldBase& old = p_.bases[number];
        const BothSides sums = old_base_sums(number, open_up);
        const OwnedCap below{new_cut, normal_, 0};
        const OwnedCap above{new_cut, -normal_, 0};
        const std::vector<Vec3>& directions = old.blocked.directions();
        add_old_side(result, number, sums.below, false, is_out_of_reach(below, old.base, directions));
        add_old_side(result, number, sums.above, true, is_out_of_reach(above, old.base, directions));
    }

    void add_old_side(std::vector<PlaneAccess>& result, std::size_t number, const SideSums& sums, bool is_above,
                      bool is_new_cap_out_of_reach) const {
        const OldBase& old = p_.bases[number];
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            SideOnBase s;
            s.cut = p_.caps[number].cap().cut;
            s.base_mm2 = cap_area(number, j, is_above);
            if (s.base_mm2 <= 0) continue;
            if (is_new_cap_out_of_reach) s.caps_mm2 += new_cap_[j];
            for (std::size_t c = 0; c < p_.caps.size(); ++c) {
                if (old.cap_out_of_reach[c] != 0) s.caps_mm2 += cap_area(c, j, is_above);
            }
            s.unreachable_mm2 = area_each() * sums.unreachable[j] + s.caps_mm2;
            s.projected_mm2 = std::max(0.0, area_each() * sums.projected[j]) + caps_facing(old.base.up, j, is_above);
            (is_above ? result[j].above : result[j].below).push_back(s);
        }
    }

    // The projected area along `up` of the caps of a side, the new one's included: no cap is hidden along a direction
    // that it faces.
    double caps_facing(Vec3 up, std::size_t j, bool is_above) const {
        double sum = new_cap_[j] * std::max(0.0, dot(is_above ? -normal_ : normal_, up));
        for (std::size_t c = 0; c < p_.caps.size(); ++c) {
            sum += cap_area(c, j, is_above) * std::max(0.0, dot(p_.caps[c].cap().outward, up));
        }
        return sum;
    }

    BothSides old_base_sums(std::size_t number, std::span<const double> open_up) const {
        const OldBase& old = p_.bases[number];
        const std::size_t planes = offsets_.size();
        BothSides sums;
        // Below, a sample counts from its entry on; above, before its entry.
        std::vector<double> up_below(planes + 1);
        std::vector<double> up_above(planes + 1);
        for (std::size_t bin = 0; bin <= planes; ++bin) {
            up_below[bin] += open_up[bin * p_.bases.size() + number];
            up_above[bin] += open_up[bin * p_.bases.size() + number];
        }
        const double up_slope = dot(normal_, old.base.up);
        for (const OldBase::BlockedUp& b : old.blocked_up) {
            const double leaves_at = height_[b.row] + static_cast<double>(b.distance) * up_slope;
            if (up_slope > 0) {
                up_below[planes_[b.row]] += b.facing;
                up_below[std::max(planes_[b.row], counts_.less_than(leaves_at))] -= b.facing;
            } else {
                up_above[planes_[b.row]] += b.facing;
                up_above[std::min(planes_[b.row], counts_.at_most(leaves_at))] -= b.facing;
            }
        }
        sum_up(up_below);
        std::reverse(up_above.begin(), up_above.end());
        sum_up(up_above);
        const Blocked blocked = old_base_blocked(old);
        std::uint32_t below = 0;
        std::uint32_t above = 0;
        for (const std::uint32_t count : blocked.above) above += count;
        for (std::size_t j = 0; j < planes; ++j) {
            below += blocked.below[j];
            above -= blocked.above[j];
            sums.below.unreachable.push_back(below);
            sums.above.unreachable.push_back(above);
            sums.below.projected.push_back(up_below[j]);
            sums.above.projected.push_back(up_above[planes - j - 1]);
        }
        return sums;
    }

    // Samples blocked along all directions: how many are so below all planes from one on, and above all before one.
    struct Blocked {
        std::vector<std::uint32_t> below;
        std::vector<std::uint32_t> above;
    };

    Blocked old_base_blocked(const OldBase& base) const {
        const std::vector<std::uint32_t>& rows = base.blocked.rows();
        const BlockedRays::Ends ends = base.blocked.ends(normal_);
        // Heights at which the rays of the blocked samples end, at the most and at the least.
        std::vector<double> highest(rows.size());
        std::vector<double> lowest(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            highest[i] = height_[rows[i]] + static_cast<double>(ends.highest[i]);
            lowest[i] = height_[rows[i]] + static_cast<double>(ends.lowest[i]);
        }
        std::vector<std::uint32_t> from(rows.size());
        std::vector<std::uint32_t> before(rows.size());
        counts_.less_than(highest, from);
        counts_.at_most(lowest, before);
        Blocked result{std::vector<std::uint32_t>(offsets_.size() + 1),
                       std::vector<std::uint32_t>(offsets_.size() + 1)};
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::uint32_t own = planes_[rows[i]];
            ++result.below[std::max(own, from[i])];
            ++result.above[std::min(own, before[i])];
        }
        return result;
    }

    double area_each() const { return p_.judged.scan.samples.area_each_mm2; }
    double cap_area(std::size_t cap, std::size_t plane, bool is_above) const {
        return is_above ? p_.caps[cap].cap().area_mm2 - cap_below_[cap][plane] : cap_below_[cap][plane];
    }

    const Prepared& p_;
    Vec3 normal_;
    std::span<const double> offsets_;
    OffsetCounts counts_;
    std::vector<double> height_;                  // per row
    std::vector<std::uint32_t> planes_;           // per row: how many offsets are at most its height: it is above these
    std::vector<std::vector<double>> cap_below_;  // per old cap, then per offset: mm2
    std::vector<double> new_cap_;                 // per offset: mm2
};

AccessSweep::AccessSweep(const Piece& piece, double tilt_deg) : AccessSweep(piece, piece.samples->judged(), tilt_deg) {}

AccessSweep::AccessSweep(const Piece& piece, const JudgedPiece& judged, double tilt_deg)
    : prepared_(std::make_unique<const Prepared>(piece, judged, tilt_deg)) {}

AccessSweep::~AccessSweep() = default;

std::vector<PlaneAccess> AccessSweep::sweep(Vec3 normal, std::span<const double> offsets) const {
    if (offsets.empty()) return {};
    return PlaneSweep(*prepared_, normal, offsets).run();
}

std::vector<CutAccess> cut_access(const Piece& piece, Vec3 normal, std::span<const double> offsets, double tilt_deg) {
    const double scan_mm2 = scan_area_mm2(piece);
    std::vector<CutAccess> access;
    for (const PlaneAccess& plane : AccessSweep(piece, tilt_deg).sweep(normal, offsets)) {
        access.push_back({plane.unreachable_mm2(), scan_mm2});
    }
    return access;
}

CutAccess cut_access(const Piece& piece, const Plane& plane, double tilt_deg) {
    return cut_access(piece, plane.normal, {&plane.offset, 1}, tilt_deg).front();
}

}  // namespace qchopper
