// One pass over the points finds the slab of each and gives it the label of an earlier neighbour in the same slab; one
// pass over the clusters joins labels (disjoint sets) and adds up the triangles. Labels then become components.
// O(points + triangles + crossings) unless many offsets crowd in a small part of their range: finding a slab costs as
// many steps as offsets lie in a 512th of it. Memory: 4 bytes per point, 72 per crossed triangle, 20 per crossing of a
// triangle and a plane.

#include "segment/objectives/sweep/slabs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/huge_pages.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

// Slab and label of a point in one word of 32 bits, so that the pass over triangles fetches one word per corner.
class Packing {
 public:
    explicit Packing(std::size_t slab_count) {
        while ((std::size_t{1} << slab_bits_) < slab_count) ++slab_bits_;
        label_bits_ = 32 - slab_bits_;
    }
    std::uint32_t pack(std::uint32_t slab, std::uint32_t label) const { return (slab << label_bits_) | label; }
    std::uint32_t slab(std::uint32_t word) const { return slab_bits_ == 0 ? 0 : word >> label_bits_; }
    std::uint32_t label(std::uint32_t word) const { return slab_bits_ == 0 ? word : word & ((1U << label_bits_) - 1); }
    std::size_t max_labels() const { return std::size_t{1} << label_bits_; }

 private:
    unsigned slab_bits_ = 0;
    unsigned label_bits_ = 32;
};

// The number of offsets at or below a height: a table gives that of a height nearby, comparisons correct it.
class SlabFinder {
 public:
    explicit SlabFinder(std::span<const double> offsets) : offsets_(offsets) {
        const double span = offsets.back() - offsets.front();
        per_mm_ = span > 0 ? cells / span : 0;
        std::uint32_t k = 0;
        for (std::size_t cell = 0; cell <= cells; ++cell) {
            const double middle = offsets.front() + span * (static_cast<double>(cell) + 0.5) / cells;
            while (k < offsets.size() && offsets[k] <= middle) ++k;
            near_[cell] = k;
        }
    }
    std::uint32_t operator()(double h) const {
        const double at = (h - offsets_.front()) * per_mm_;
        std::size_t k = near_[at <= 0 ? 0 : at >= cells ? cells : static_cast<std::size_t>(at)];
        while (k < offsets_.size() && offsets_[k] <= h) ++k;
        while (k > 0 && offsets_[k - 1] > h) --k;
        return static_cast<std::uint32_t>(k);
    }

 private:
    static constexpr std::size_t cells = 512;
    std::span<const double> offsets_;
    double per_mm_;
    std::array<std::uint32_t, cells + 1> near_{};
};

// The slabs of one normal: a pass over the points, then one over the clusters, whole or triangle by triangle.
class SlabPass {
 public:
    SlabPass(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets)
        : p_(prepared),
          mesh_(*prepared.piece->mesh),
          normal_(normal),
          offsets_(offsets),
          frame_(frame_across(normal)),
          packing_(offsets.size() + 1),
          word_(huge<std::uint32_t>(mesh_.points.size())) {
        // Memory that is reserved but not touched costs nothing; growing a vector copies it.
        reserve_huge(out_.crossed, mesh_.triangles.size() / 2);
        reserve_huge(out_.point, mesh_.triangles.size() / 2);
        reserve_huge(out_.exit, mesh_.triangles.size() / 2);
    }

    Slabs run() {
        label_points();
        assert(label_slab_.size() <= packing_.max_labels());
        for (SumTable* table : {&inside_, &above_, &below_}) *table = SumTable(label_slab_.size(), p_.up.size());
        for (std::size_t c = 0; c < p_.clusters.count(); ++c) {
            if (is_in_one_slab(points_of(c))) {
                add_cluster(c);
            } else {
                add_triangles(c);
            }
        }
        number_components();
        return std::move(out_);
    }

 private:
    // A point is given the label of an earlier neighbour in the same slab: this replaces almost all unions of sets.
    void label_points() {
        const SlabFinder slab_at(offsets_);
        for (std::uint32_t v = 0; v < word_.size(); ++v) {
            const std::uint32_t slab = slab_at(height(normal_, mesh_.points[v]));
            const auto [nearest, farthest] = p_.clusters.neighbour[v];
            if (nearest != v && packing_.slab(word_[nearest]) == slab) {
                word_[v] = word_[nearest];
            } else if (farthest != v && packing_.slab(word_[farthest]) == slab) {
                word_[v] = word_[farthest];
            } else {
                word_[v] = packing_.pack(slab, sets_.add());
                label_slab_.push_back(static_cast<std::uint16_t>(slab));
            }
        }
    }

    std::span<const std::uint32_t> points_of(std::size_t c) const {
        const std::uint32_t first = p_.clusters.cluster[c].first_point;
        return {p_.clusters.point.data() + first, p_.clusters.cluster[c + 1].first_point - first};
    }

    // Are all points in one slab? If so they are connected there, since the cluster is, and their labels are joined.
    bool is_in_one_slab(std::span<const std::uint32_t> points) {
        const std::uint32_t word = word_[points.front()];
        std::uint32_t different = 0;
        for (const std::uint32_t v : points) different |= word_[v] ^ word;
        if (packing_.slab(different) != 0) return false;
        if (different != 0) {
            for (const std::uint32_t v : points) join(word_[v], word);
        }
        return true;
    }

    // Unites the sets of two words of one slab. The first word becomes the second, so that they compare equal next
    // time.
    void join(std::uint32_t& word, std::uint32_t other) {
        if (word == other) return;
        sets_.unite(packing_.label(word), packing_.label(other));
        word = other;
    }

    void add_cluster(std::size_t c) {
        const Cluster& cluster = p_.clusters.cluster[c];
        const std::uint32_t end = p_.clusters.cluster[c + 1].first_triangle;
        const std::uint32_t label = packing_.label(word_[p_.clusters.point[cluster.first_point]]);
        PartSums& sums = inside_.part(label);
        sums.faces += end - cluster.first_triangle;
        sums.volume += cluster.volume;
        if (std::abs(dot(cluster.axis, normal_)) > cluster.cone) {
            sums.add_projected(dot(cluster.weighted_normal, normal_));
        } else {
            for (std::uint32_t t = cluster.first_triangle; t < end; ++t)
                sums.add_projected(dot(p_.weighted_normal(t), normal_));
        }
        const BaseSums* of_cluster = p_.base_sums.data() + c * p_.up.size();
        for (BaseSums& base : inside_.bases(label)) base += *of_cluster++;
    }

    void add_triangles(std::size_t c) {
        const std::uint32_t end = p_.clusters.cluster[c + 1].first_triangle;
        for (std::uint32_t t = p_.clusters.cluster[c].first_triangle; t < end; ++t) {
            const Triangle& v = mesh_.triangles[t];
            const std::array<std::uint32_t, 3> word{word_[v[0]], word_[v[1]], word_[v[2]]};
            if (packing_.slab(word[0]) != packing_.slab(word[1]) || packing_.slab(word[0]) != packing_.slab(word[2])) {
                add_crossed(t, word);
                continue;
            }
            join(word_[v[1]], word[0]);
            join(word_[v[2]], word[0]);
            const std::uint32_t label = packing_.label(word[0]);
            PartSums& sums = inside_.part(label);
            sums.faces += 1;
            sums.volume += p_.sums[t].volume;
            sums.add_projected(dot(p_.weighted_normal(t), normal_));
            if (!p_.up.empty()) add_to_bases(inside_.bases(label), p_, t, 1, 1);
        }
    }

    void add_crossed(std::uint32_t t, const std::array<std::uint32_t, 3>& word) {
        CrossedTriangle s{};
        s.triangle = t;
        s.along = dot(p_.weighted_normal(t), normal_);
        s.volume = p_.sums[t].volume;
        const Triangle& v = mesh_.triangles[t];
        const std::array<Vec3, 3> corner = corners_of(mesh_, t);
        std::size_t lowest = 0;
        std::size_t highest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            s.height[k] = height(normal_, corner[k]);
            s.component[k] = packing_.label(word[k]);
            s.slab[k] = static_cast<std::uint16_t>(packing_.slab(word[k]));
            if (s.slab[k] < s.slab[lowest]) lowest = k;
            if (s.slab[k] > s.slab[highest]) highest = k;
        }
        assert(s.slab[lowest] < s.slab[highest]);
        s.low = s.slab[lowest];
        s.high = s.slab[highest];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (s.slab[k] != s.slab[next]) {
                connect(s.component[k], s.component[next]);
            } else {
                join(word_[v[next]], word[k]);
            }
        }
        // The triangle is whole on one side as soon as its corner nearest to the planes has been added there
        // (sweep.cpp).
        add_part(above_, s.component[lowest], p_, s, 1, 1);
        add_part(below_, s.component[highest], p_, s, 1, 1);
        s.first_crossing = static_cast<std::uint32_t>(out_.exit.size());
        for (std::size_t plane = s.low; plane < s.high; ++plane) add_crossing(s, corner, plane);
        out_.crossed.push_back(s);
    }

    // Connections of the same two labels come in runs and by turns: a small table of the last ones leaves out most
    // repeats.
    void connect(std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b);
        std::array<std::uint32_t, 2>& known = last_connections_[(a * 31 + b) % last_connections_.size()];
        if (known[0] == a && known[1] == b) return;
        known = {a, b};
        out_.connections.push_back(known);
    }

    void add_crossing(const CrossedTriangle& s, const std::array<Vec3, 3>& corner, std::size_t plane) {
        const std::uint32_t from = crossing(s, plane).exit();
        const std::uint32_t to = (from + 1) % 3;
        const Vec3 at = edge_crossing({corner[from], s.height[from]}, {corner[to], s.height[to]}, offsets_[plane]);
        out_.point.push_back(flattened(frame_, p_.origin, at));
        out_.exit.push_back(3 * s.triangle + from);
    }

    // Labels become components: one per root.
    void number_components() {
        std::vector<std::uint32_t> component(label_slab_.size());
        for (std::uint32_t label = 0; label < component.size(); ++label) {
            if (sets_.root(label) == label) {
                component[label] = static_cast<std::uint32_t>(out_.component_slab.size());
                out_.component_slab.push_back(label_slab_[label]);
            } else {
                component[label] = component[sets_.root(label)];  // a root is smaller, so it has its number already
            }
        }
        for (const auto& [table, by_label] :
             {std::pair{&out_.inside, &inside_}, {&out_.above, &above_}, {&out_.below, &below_}}) {
            *table = SumTable(out_.components(), p_.up.size());
            for (std::uint32_t label = 0; label < component.size(); ++label)
                table->add(component[label], *by_label, label);
        }
        for (CrossedTriangle& s : out_.crossed) {
            for (std::uint32_t& label : s.component) label = component[label];
        }
        for (auto& [a, b] : out_.connections) {
            a = component[a];
            b = component[b];
        }
        for (std::uint32_t& word : word_) word = component[packing_.label(word)];
        out_.component_of = std::move(word_);
    }

    const PreparedPiece& p_;
    const TriangleMesh& mesh_;
    Vec3 normal_;
    std::span<const double> offsets_;
    PlaneFrame frame_;
    Packing packing_;
    std::vector<std::uint32_t> word_;        // per point
    std::vector<std::uint16_t> label_slab_;  // per label
    DisjointSets sets_;
    SumTable inside_;  // per label, as in Slabs per component
    SumTable above_;
    SumTable below_;
    std::array<std::array<std::uint32_t, 2>, 256> last_connections_{};
    Slabs out_;
};

}  // namespace

Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets) {
    assert(!offsets.empty() && std::is_sorted(offsets.begin(), offsets.end()));
    return SlabPass(prepared, normal, offsets).run();
}

}  // namespace qchopper
