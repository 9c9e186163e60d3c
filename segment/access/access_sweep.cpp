// The new base: rays within 90 degrees of its up never meet the plane, so a sample's state is the same for all offsets
// and follows from sets of samples, one per direction, 64 samples a word. An old base: a sample that is open along none
// of its directions has an offset on either side from which on its rays leave through the plane, the largest and the
// smallest of distance x slope over the directions; such samples are held in blocks of alike normals, so that one pass
// over a block's directions serves all its samples side by side. Per normal O(samples + samples x allowed directions /
// 64), and per old base O(blocked samples x allowed directions + edges of its cap).
//
// The height of a sample stands for that of its ray's origin, 1e-6 of the scan's diagonal off the surface.

#include "segment/access/access_sweep.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "segment/mesh/plane.h"

namespace qchopper {
namespace {

constexpr std::size_t word_bits = 64;
constexpr std::size_t lanes = 16;  // samples of a block

// Four numbers, for which compilers take one instruction; their own vectorising gives up here.
using Four = float __attribute__((vector_size(4 * sizeof(float))));
static_assert(lanes % 4 == 0);
constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

// A set of samples of the piece: bit r % 64 of word r / 64.
using RowSet = std::vector<std::uint64_t>;

void unite(RowSet& set, std::span<const std::uint64_t> other) {
    for (std::size_t w = 0; w < set.size(); ++w) set[w] |= other[w];
}

bool contains(std::span<const std::uint64_t> set, std::size_t row) {
    return (set[row / word_bits] >> (row % word_bits) & 1) != 0;
}

// Finds how many of the offsets are below a value: a table of cells of equal width leaves few to compare.
class OffsetCounts {
 public:
    explicit OffsetCounts(std::span<const double> offsets) : offsets_(offsets) {
        assert(!offsets.empty() && std::is_sorted(offsets.begin(), offsets.end()));
        const double range = offsets.back() - offsets.front();
        const std::size_t cells = cells_per_offset * offsets.size();
        low_ = offsets.front();
        last_ = static_cast<double>(cells - 1);
        scale_ = range > 0 ? last_ / range : 0;
        first_.assign(cells + 1, 0);
        for (const double offset : offsets) ++first_[static_cast<std::size_t>(cell(offset)) + 1];
        for (std::size_t c = 0; c < cells; ++c) first_[c + 1] += first_[c];
    }
    std::uint32_t at_most(double value) const {
        return count(cell(value), [value](double offset) { return offset <= value; });
    }
    std::uint32_t less_than(double value) const {
        return count(cell(value), [value](double offset) { return offset < value; });
    }
    // The same for many values. Both spans have the same size.
    void at_most(std::span<const double> values, std::span<std::uint32_t> result) const {
        many(values, result, [](double offset, double value) { return offset <= value; });
    }
    void less_than(std::span<const double> values, std::span<std::uint32_t> result) const {
        many(values, result, [](double offset, double value) { return offset < value; });
    }

 private:
    static constexpr std::size_t cells_per_offset = 16;

    // Never less for a larger value.
    std::int32_t cell(double value) const {
        return static_cast<std::int32_t>(std::min(std::max((value - low_) * scale_, 0.0), last_));
    }
    template <class Counts>
    std::uint32_t count(std::int32_t in, const Counts& counts) const {
        const auto c = static_cast<std::size_t>(in);
        std::uint32_t result = first_[c];
        while (result < first_[c + 1] && counts(offsets_[result])) ++result;
        return result;
    }
    template <class Counts>
    void many(std::span<const double> values, std::span<std::uint32_t> result, const Counts& counts) const {
        assert(values.size() == result.size());
        constexpr std::size_t at_once = 64;
        std::array<std::int32_t, at_once> cells;
        for (std::size_t first = 0; first < values.size(); first += at_once) {
            const std::size_t size = std::min(at_once, values.size() - first);
            for (std::size_t i = 0; i < size; ++i) cells[i] = cell(values[first + i]);
            for (std::size_t i = 0; i < size; ++i) {
                const double value = values[first + i];
                result[first + i] = count(cells[i], [&](double offset) { return counts(offset, value); });
            }
        }
    }

    std::span<const double> offsets_;
    double low_ = 0;
    double last_ = 0;  // cell
    double scale_ = 0;
    std::vector<std::uint32_t> first_;  // per cell: the offsets in earlier ones
};

// The boundary of a cap, from which follows its area below any plane.
class CapOutline {
 public:
    CapOutline(const TriangleMesh& mesh, const OwnedCap& cap, std::span<const std::uint32_t> triangles) : cap_(cap) {
        std::vector<std::array<std::uint32_t, 2>> ends;
        for (const std::uint32_t t : triangles) {
            const Triangle& corners = mesh.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) ends.push_back({corners[k], corners[(k + 1) % 3]});
        }
        std::sort(ends.begin(), ends.end());
        for (const auto& [a, b] : ends) {
            if (std::binary_search(ends.begin(), ends.end(), std::array{b, a})) continue;
            edges_.push_back({mesh.points[a], mesh.points[b]});
        }
        if (!edges_.empty()) origin_ = edges_.front()[0];
    }

    const OwnedCap& cap() const { return cap_; }

    // mm2, one per offset. Green's theorem: along the boundary the integral of min(distance across, that of the plane)
    // over the way along the section. O(edges + offsets + crossings).
    std::vector<double> area_below(Vec3 normal, std::span<const double> offsets) const {
        std::vector<double> area(offsets.size());
        const double at_origin = height(normal, origin_);
        const Vec3 across = normal - dot(normal, cap_.outward) * cap_.outward;
        const double slope = norm(across);
        if (slope < parallel) {
            for (std::size_t j = 0; j < area.size(); ++j) area[j] = at_origin < offsets[j] ? cap_.area_mm2 : 0;
            return area;
        }
        std::vector<double> above_origin(offsets.begin(), offsets.end());
        for (double& offset : above_origin) offset -= at_origin;
        const OffsetCounts counts(above_origin);
        const Vec3 along = (1 / slope) * cross(cap_.outward, across);
        // Per number of offsets at or below the upper end, or below the lower one: what such edges add.
        std::vector<double> whole(offsets.size() + 1);
        std::vector<double> beyond(offsets.size() + 1);
        for (const auto& [a, b] : edges_) {
            const double way = dot(along, b - a);
            const double of_a = dot(normal, a - origin_);
            const double of_b = dot(normal, b - origin_);
            const double low = std::min(of_a, of_b);
            const double high = std::max(of_a, of_b);
            const std::uint32_t first = counts.at_most(low);
            const std::uint32_t last = counts.less_than(high);
            beyond[first] += way;
            whole[std::max(first, last)] += way * (low + high) / 2;
            for (std::uint32_t j = first; j < last; ++j) {
                const double offset = above_origin[j];
                area[j] += way * (offset - (offset - low) * (offset - low) / (2 * (high - low)));
            }
        }
        double sum = 0;
        for (std::size_t j = 0; j < area.size(); ++j) area[j] += sum += whole[j];
        sum = 0;
        for (std::size_t j = area.size(); j > 0; --j) area[j - 1] += (sum += beyond[j]) * above_origin[j - 1];
        for (double& a : area) {
            a = std::clamp(a / slope, 0.0, cap_.area_mm2);
            if (a < rounding * cap_.area_mm2) a = 0;
            if (a > (1 - rounding) * cap_.area_mm2) a = cap_.area_mm2;
        }
        return area;
    }

 private:
    static constexpr double parallel = 1e-6;  // sine of the angle between cap and plane
    static constexpr double rounding = 1e-9;  // of the cap's area

    OwnedCap cap_;
    Vec3 origin_;  // a point of the cap: heights count from it
    std::vector<std::array<Vec3, 2>> edges_;
};

std::vector<CapOutline> outlines(const TriangleMesh& mesh, std::span<const OwnedCap> caps) {
    std::vector<std::vector<std::uint32_t>> triangles(caps.size());
    for (std::uint32_t t = 0; t < mesh.cap_of.size(); ++t) {
        if (mesh.cap_of[t] == no_cap) continue;
        for (std::size_t c = 0; c < caps.size(); ++c) {
            if (caps[c].cut == mesh.cap_of[t]) triangles[c].push_back(t);
        }
    }
    std::vector<CapOutline> result;
    for (std::size_t c = 0; c < caps.size(); ++c) result.emplace_back(mesh, caps[c], triangles[c]);
    return result;
}

// A base that the piece has already.
struct OldBase {
    std::size_t cap = 0;           // index of the caps
    std::vector<Vec3> directions;  // allowed
    std::vector<std::uint8_t> cap_faces_away;
    // Samples blocked along all of them; below steep_counts_from_deg without the steep ones. In blocks: their rows,
    // no_row at the end; per block the directions along which one of them has a distance, and these distances.
    std::vector<std::uint32_t> row;         // blocks x lanes
    std::vector<std::uint32_t> first_slot;  // per block, and the end
    std::vector<std::uint32_t> direction;   // per slot: index of `directions`
    std::vector<float> distance;            // slots x lanes: mm; 0: blocked at once
    // Samples that face up and are blocked along it.
    struct BlockedUp {
        std::uint32_t row = 0;
        float distance = 0;
        double facing = 0;  // cosine between normal and up
    };
    std::vector<BlockedUp> blocked_up;
};

// Sorts alike normals together.
std::array<int, 3> rough(Vec3 normal) {
    constexpr double steps = 3;
    return {static_cast<int>(std::lround(steps * normal.x)), static_cast<int>(std::lround(steps * normal.y)),
            static_cast<int>(std::lround(steps * normal.z))};
}

// Replaces each entry by the sum of those up to it.
template <class Number>
void sum_up(std::vector<Number>& values) {
    for (std::size_t i = 1; i < values.size(); ++i) values[i] += values[i - 1];
}

bool faces_away_from_all(const OwnedCap& cap, std::span<const Vec3> directions) {
    return std::all_of(directions.begin(), directions.end(), [&](Vec3 d) { return faces_away(cap, d); });
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
    std::vector<Vec3> point;           // per row
    std::vector<Vec3> normal;          // per row
    std::vector<std::uint64_t> open;   // directions x words: a RowSet each
    std::vector<std::uint64_t> steep;  // the same where steep samples do not count, or empty
    std::vector<CapOutline> caps;
    std::vector<OldBase> bases;
    std::vector<double> facing_up;  // rows x bases: cosine between normal and up where it is open, else 0

    Prepared(const Piece& piece, const JudgedPiece& judged_piece, std::span<const TiltBase> old, double tilt)
        : judged(judged_piece),
          tilt_deg(tilt),
          steep_counts(tilt >= steep_counts_from_deg),
          rows(judged.accessibility.sample.size()),
          words((rows + word_bits - 1) / word_bits),
          caps(outlines(*piece.mesh, judged.caps)),
          facing_up(rows * old.size()) {
        for (std::size_t row = 0; row < rows; ++row) {
            point.push_back(judged.sample(row).point);
            normal.push_back(judged.sample(row).normal);
        }
        find_open();
        if (!steep_counts) find_steep();
        for (const TiltBase& base : old) add_base(base, old.size());
    }

    std::size_t directions() const { return judged.scan.directions.size(); }
    std::span<const std::uint64_t> open_along(std::size_t k) const { return {open.data() + k * words, words}; }
    std::span<const std::uint64_t> steep_along(std::size_t k) const { return {steep.data() + k * words, words}; }

    void find_open() {
        open.resize(directions() * words);
        std::vector<std::uint64_t> word(directions());
        for (std::size_t w = 0; w < words; ++w) {
            std::fill(word.begin(), word.end(), 0);
            const std::size_t end = std::min(word_bits, rows - w * word_bits);
            for (std::size_t bit = 0; bit < end; ++bit) {
                const float* distance = judged.accessibility.distances(w * word_bits + bit).data();
                for (std::size_t k = 0; k < word.size(); ++k) {
                    const bool is_open = distance[k] == std::numeric_limits<float>::infinity();
                    word[k] |= static_cast<std::uint64_t>(is_open ? 1 : 0) << bit;
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
            const bool is_steep = std::abs(dot(normal[row], direction)) < min_facing;
            set[row / word_bits] |= static_cast<std::uint64_t>(is_steep ? 1 : 0) << (row % word_bits);
        }
        return set;
    }

    // The samples that count where they are open along no allowed direction, and are.
    RowSet blocked(Vec3 up, std::span<const std::uint32_t> allowed, std::span<const std::uint64_t> open_up) const {
        RowSet set(open_up.begin(), open_up.end());
        for (const std::uint32_t k : allowed) unite(set, open_along(k));
        if (!steep_counts) {
            unite(set, steep_to(up));
            for (const std::uint32_t k : allowed) unite(set, steep_along(k));
        }
        for (std::uint64_t& word : set) word = ~word;
        if (rows % word_bits != 0) set.back() &= (std::uint64_t{1} << (rows % word_bits)) - 1;
        return set;
    }

    void add_base(const TiltBase& up_of, std::size_t all) {
        const std::size_t number = bases.size();
        OldBase& base = bases.emplace_back();
        const auto is_its_cap = [&](const CapOutline& c) { return is_base(c.cap(), up_of); };
        base.cap = static_cast<std::size_t>(std::find_if(caps.begin(), caps.end(), is_its_cap) - caps.begin());
        assert(base.cap < caps.size());
        const std::vector<Vec3>& known = judged.scan.directions;
        const std::vector<std::uint32_t> allowed = allowed_directions(known, up_of.up, tilt_deg);
        for (const std::uint32_t k : allowed) base.directions.push_back(known[k]);
        const std::size_t up = index_of(known, up_of.up);
        std::vector<float> cast;  // along an up that is not a direction of the scan
        if (up == known.size()) {
            base.directions.push_back(up_of.up);
            cast = PieceRays(judged.scan, judged.accessibility).distances(up_of.up);
        }
        base.cap_faces_away = cap_faces_away(base.directions);
        const auto along_up = [&](std::size_t row) {
            return cast.empty() ? judged.accessibility.distances(row)[up] : cast[row];
        };
        RowSet open_up(words);
        for (std::uint32_t row = 0; row < rows; ++row) {
            const float distance = along_up(row);
            const double facing = dot(normal[row], up_of.up);
            if (std::isinf(distance)) {
                open_up[row / word_bits] |= std::uint64_t{1} << (row % word_bits);
                facing_up[row * all + number] = facing;
            } else if (distance > 0) {
                base.blocked_up.push_back({row, distance, facing});
            }
        }
        const RowSet set = blocked(up_of.up, allowed, open_up);
        for (std::uint32_t row = 0; row < rows; ++row) {
            if (contains(set, row)) base.row.push_back(row);
        }
        add_blocks(base, allowed, cast);
    }

    void add_blocks(OldBase& base, std::span<const std::uint32_t> allowed, std::span<const float> cast) const {
        std::stable_sort(base.row.begin(), base.row.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return rough(normal[a]) < rough(normal[b]); });
        base.row.resize((base.row.size() + lanes - 1) / lanes * lanes, no_row);
        base.first_slot.push_back(0);
        for (std::size_t first = 0; first < base.row.size(); first += lanes) {
            for (std::uint32_t slot = 0; slot < base.directions.size(); ++slot) {
                std::array<float, lanes> distance{};
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    const std::uint32_t row = base.row[first + lane];
                    if (row == no_row) continue;
                    distance[lane] =
                        slot < allowed.size() ? judged.accessibility.distances(row)[allowed[slot]] : cast[row];
                }
                if (std::all_of(distance.begin(), distance.end(), [](float d) { return d == 0; })) continue;
                base.direction.push_back(slot);
                base.distance.insert(base.distance.end(), distance.begin(), distance.end());
            }
            base.first_slot.push_back(static_cast<std::uint32_t>(base.direction.size()));
        }
    }

    std::vector<std::uint8_t> cap_faces_away(std::span<const Vec3> from) const {
        std::vector<std::uint8_t> result;
        for (const CapOutline& c : caps) result.push_back(faces_away_from_all(c.cap(), from) ? 1 : 0);
        return result;
    }
};

double min_unreachable_mm2(std::span<const SideOnBase> bases) {
    assert(!bases.empty());
    const bool one_is_stable =
        std::any_of(bases.begin(), bases.end(), [](const SideOnBase& b) { return b.is_stable(); });
    double least = std::numeric_limits<double>::infinity();
    for (const SideOnBase& b : bases) {
        if (b.is_stable() || !one_is_stable) least = std::min(least, b.unreachable_mm2);
    }
    return least;
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
        std::vector<std::uint8_t> cap_faces_away;
        RowSet blocked;
        RowSet open_up;
    };

    NewBase new_base(Vec3 up) const {
        const std::vector<Vec3>& known = p_.judged.scan.directions;
        const std::vector<std::uint32_t> allowed = allowed_directions(known, up, p_.tilt_deg);
        std::vector<Vec3> directions;
        directions.reserve(allowed.size() + 1);
        for (const std::uint32_t k : allowed) directions.push_back(known[k]);
        const std::size_t k = index_of(known, up);
        NewBase base;
        if (k < known.size()) {
            const std::span<const std::uint64_t> open_up = p_.open_along(k);
            base.open_up.assign(open_up.begin(), open_up.end());
        } else {
            directions.push_back(up);
            base.open_up.resize(p_.words);
            const PieceRays rays(p_.judged.scan, p_.judged.accessibility);
            for (std::size_t row = 0; row < p_.rows; ++row) {
                if (std::isinf(rays.distance(row, up))) {
                    base.open_up[row / word_bits] |= std::uint64_t{1} << (row % word_bits);
                }
            }
        }
        base.cap_faces_away = p_.cap_faces_away(directions);
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
            std::uint64_t blocked_below = below.blocked[w];
            std::uint64_t blocked_above = above.blocked[w];
            std::uint64_t open_below = below.open_up[w];
            std::uint64_t open_above = above.open_up[w];
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
                    if (base.cap_faces_away[c] != 0) s.caps_mm2 += cap_area(c, j, is_above);
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
        const OldBase& base = p_.bases[number];
        const BothSides sums = old_base_sums(base, number, open_up);
        const OwnedCap below{new_cut, normal_, 0};
        const OwnedCap above{new_cut, -normal_, 0};
        add_old_side(result, base, sums.below, false, faces_away_from_all(below, base.directions));
        add_old_side(result, base, sums.above, true, faces_away_from_all(above, base.directions));
    }

    void add_old_side(std::vector<PlaneAccess>& result, const OldBase& base, const SideSums& sums, bool is_above,
                      bool new_cap_faces_away) const {
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            SideOnBase s;
            s.cut = p_.caps[base.cap].cap().cut;
            s.base_mm2 = cap_area(base.cap, j, is_above);
            if (s.base_mm2 <= 0) continue;
            if (new_cap_faces_away) s.caps_mm2 += new_cap_[j];
            for (std::size_t c = 0; c < p_.caps.size(); ++c) {
                if (c != base.cap && base.cap_faces_away[c] != 0) s.caps_mm2 += cap_area(c, j, is_above);
            }
            s.unreachable_mm2 = area_each() * sums.unreachable[j] + s.caps_mm2;
            s.projected_mm2 = std::max(0.0, area_each() * sums.projected[j]) +
                              caps_facing(-p_.caps[base.cap].cap().outward, j, is_above);
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

    BothSides old_base_sums(const OldBase& base, std::size_t number, std::span<const double> open_up) const {
        const std::size_t planes = offsets_.size();
        BothSides sums;
        // Below, a sample counts from its entry on; above, before its entry.
        std::vector<double> up_below(planes + 1);
        std::vector<double> up_above(planes + 1);
        for (std::size_t bin = 0; bin <= planes; ++bin) {
            up_below[bin] += open_up[bin * p_.bases.size() + number];
            up_above[bin] += open_up[bin * p_.bases.size() + number];
        }
        const double up_slope = dot(normal_, -p_.caps[base.cap].cap().outward);
        for (const OldBase::BlockedUp& b : base.blocked_up) {
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
        const Blocked blocked = old_base_blocked(base);
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
        std::vector<float> slope;
        slope.reserve(base.directions.size());
        for (const Vec3& d : base.directions) slope.push_back(static_cast<float>(dot(normal_, d)));
        Blocked result{std::vector<std::uint32_t>(offsets_.size() + 1),
                       std::vector<std::uint32_t>(offsets_.size() + 1)};
        // Heights at which the rays of the blocked samples end, at the most and at the least.
        std::vector<double> highest(base.row.size());
        std::vector<double> lowest(base.row.size());
        for (std::size_t block = 0; block + 1 < base.first_slot.size(); ++block) {
            const Ends ends = ends_of_block(base, block, slope);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const std::size_t i = block * lanes + lane;
                const double own = base.row[i] == no_row ? 0 : height_[base.row[i]];
                highest[i] = own + static_cast<double>(ends.highest[lane]);
                lowest[i] = own + static_cast<double>(ends.lowest[lane]);
            }
        }
        std::vector<std::uint32_t> from(base.row.size());
        std::vector<std::uint32_t> before(base.row.size());
        counts_.less_than(highest, from);
        counts_.at_most(lowest, before);
        for (std::size_t i = 0; i < base.row.size() && base.row[i] != no_row; ++i) {
            const std::uint32_t own = planes_[base.row[i]];
            ++result.below[std::max(own, from[i])];
            ++result.above[std::min(own, before[i])];
        }
        return result;
    }

    // Along the normal, mm: how far above and below the samples of a block their rays end, at least 0.
    struct Ends {
        std::array<float, lanes> highest;
        std::array<float, lanes> lowest;
    };

    static Ends ends_of_block(const OldBase& base, std::size_t block, std::span<const float> slope) {
        std::array<Four, lanes / 4> highest{};
        std::array<Four, lanes / 4> lowest{};
        for (std::uint32_t slot = base.first_slot[block]; slot < base.first_slot[block + 1]; ++slot) {
            const float* distance = base.distance.data() + slot * lanes;
            const float of_slot = slope[base.direction[slot]];
            for (std::size_t i = 0; i < lanes / 4; ++i) {
                Four end;
                std::memcpy(&end, distance + 4 * i, sizeof end);
                end *= of_slot;
                highest[i] = end > highest[i] ? end : highest[i];
                lowest[i] = end < lowest[i] ? end : lowest[i];
            }
        }
        Ends ends{};
        std::memcpy(ends.highest.data(), highest.data(), sizeof highest);
        std::memcpy(ends.lowest.data(), lowest.data(), sizeof lowest);
        return ends;
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

AccessSweep::AccessSweep(const Piece& piece, const JudgedPiece& judged, std::span<const TiltBase> bases,
                         double tilt_deg)
    : prepared_(std::make_unique<const Prepared>(piece, judged, bases, tilt_deg)) {}

AccessSweep::~AccessSweep() = default;

std::vector<PlaneAccess> AccessSweep::sweep(Vec3 normal, std::span<const double> offsets) const {
    if (offsets.empty()) return {};
    return PlaneSweep(*prepared_, normal, offsets).run();
}

}  // namespace qchopper
