#include "segment/score/slabs.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "segment/mesh/disjoint_sets.h"

namespace qchopper {
namespace {

// Slab and label of a vertex in one word, so that the triangle pass fetches one word per corner.
class Packing {
 public:
    explicit Packing(std::size_t slab_count) {
        while ((std::size_t{1} << slab_bits_) < slab_count) ++slab_bits_;
        label_bits_ = 32 - slab_bits_;
    }
    std::uint32_t pack(std::uint32_t slab, std::uint32_t label) const { return (slab << label_bits_) | label; }
    std::uint32_t slab(std::uint32_t word) const { return slab_bits_ == 0 ? 0 : word >> label_bits_; }
    std::uint32_t label(std::uint32_t word) const { return slab_bits_ == 0 ? word : word & ((1U << label_bits_) - 1); }
    std::size_t most_labels() const { return std::size_t{1} << label_bits_; }

 private:
    unsigned slab_bits_ = 0;
    unsigned label_bits_ = 32;
};

// Number of offsets at or below a height: a guess for even spacing, mended by comparing.
class SlabFinder {
 public:
    explicit SlabFinder(std::span<const double> offsets) : offsets_(offsets) {
        const double span = offsets.back() - offsets.front();
        per_mm_ = offsets.size() > 1 && span > 0 ? static_cast<double>(offsets.size() - 1) / span : 0;
    }
    std::uint32_t operator()(double h) const {
        const auto count = static_cast<std::ptrdiff_t>(offsets_.size());
        const double guess = (h - offsets_.front()) * per_mm_ + 1;
        std::ptrdiff_t k = guess <= 0                            ? 0
                           : guess >= static_cast<double>(count) ? count
                                                                 : static_cast<std::ptrdiff_t>(guess);
        while (k < count && offsets_[static_cast<std::size_t>(k)] <= h) ++k;
        while (k > 0 && offsets_[static_cast<std::size_t>(k - 1)] > h) --k;
        return static_cast<std::uint32_t>(k);
    }

 private:
    std::span<const double> offsets_;
    double per_mm_;
};

// One normal's pass over vertices and triangles.
class Pass {
 public:
    Pass(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets)
        : p_(prepared),
          mesh_(*prepared.piece->mesh),
          normal_(normal),
          offsets_(offsets),
          packing_(offsets.size() + 1),
          word_(mesh_.points.size()) {
        out_.layout.bases = prepared.up.size();
        out_.height.resize(mesh_.points.size());
    }

    Slabs run() {
        label_vertices();
        assert(label_slab_.size() <= packing_.most_labels());
        sums_ = SumTable(label_slab_.size(), out_.layout.width());
        if (out_.layout.bases > 0) {
            sum_triangles<true>();
        } else {
            sum_triangles<false>();
        }
        number_nodes();
        return std::move(out_);
    }

 private:
    // A vertex takes the label of its earlier neighbour if that lies in the same slab: almost all unions, for free.
    void label_vertices() {
        const SlabFinder slab_at(offsets_);
        for (std::uint32_t v = 0; v < word_.size(); ++v) {
            const double h = height(normal_, mesh_.points[v]);
            out_.height[v] = h;
            const std::uint32_t slab = slab_at(h);
            const std::uint32_t before = p_.neighbour[v];
            if (before != v && packing_.slab(word_[before]) == slab) {
                word_[v] = word_[before];
            } else {
                word_[v] = packing_.pack(slab, sets_.add());
                label_slab_.push_back(static_cast<std::uint16_t>(slab));
            }
        }
    }

    // What a triangle looks like along the normal: its area, or 1, times the cosine.
    double along(std::uint32_t t) const { return dot(p_.unit.empty() ? p_.sums[t].area : p_.unit[t], normal_); }

    template <bool has_bases>  // the four sums along the normal stay in registers over a run of one label
    void sum_triangles() {
        std::uint32_t run = std::numeric_limits<std::uint32_t>::max();
        double faces = 0;
        double volume = 0;
        double up = 0;
        double down = 0;
        const auto flush = [&] {
            if (faces == 0) return;
            double* row = sums_.cells.data() + std::size_t{run} * sums_.width;
            row[sum_faces] += faces;
            row[sum_volume] += volume;
            row[sum_up] += up;
            row[sum_down] += down;
        };
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Triangle& v = mesh_.triangles[t];
            const std::array<std::uint32_t, 3> word{word_[v[0]], word_[v[1]], word_[v[2]]};
            if (packing_.slab(word[0]) != packing_.slab(word[1]) || packing_.slab(word[0]) != packing_.slab(word[2])) {
                keep_straddler(t, word);
                continue;
            }
            const std::uint32_t label = packing_.label(word[0]);
            if (word[0] != word[1]) sets_.unite(label, packing_.label(word[1]));
            if (word[0] != word[2]) sets_.unite(label, packing_.label(word[2]));
            if (label != run) {
                flush();
                run = label;
                faces = volume = up = down = 0;
            }
            const double look = along(t);
            faces += 1;
            volume += p_.sums[t].volume;
            up += look > 0 ? look : 0;
            down += look < 0 ? -look : 0;
            if constexpr (has_bases) add_to_bases(sums_.row(label), p_, t, 1, 1);
        }
        flush();
    }

    void keep_straddler(std::uint32_t t, const std::array<std::uint32_t, 3>& word) {
        const Triangle& v = mesh_.triangles[t];
        Straddler s{};
        s.triangle = t;
        for (std::size_t k = 0; k < 3; ++k) {
            s.node[k] = packing_.label(word[k]);
            s.slab[k] = static_cast<std::uint16_t>(packing_.slab(word[k]));
            s.height[k] = out_.height[v[k]];
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (s.slab[k] == s.slab[next] && s.node[k] != s.node[next]) sets_.unite(s.node[k], s.node[next]);
        }
        s.low = std::min({s.slab[0], s.slab[1], s.slab[2]});
        s.high = std::max({s.slab[0], s.slab[1], s.slab[2]});
        s.first_record = out_.records;
        s.along = along(t);
        s.volume = p_.sums[t].volume;
        out_.records += static_cast<std::uint32_t>(s.high - s.low);
        out_.straddlers.push_back(s);
    }

    // Labels become nodes: one per root.
    void number_nodes() {
        std::vector<std::uint32_t> node(label_slab_.size());
        for (std::uint32_t label = 0; label < node.size(); ++label) {
            if (sets_.root(label) == label) {
                node[label] = static_cast<std::uint32_t>(out_.node_slab.size());
                out_.node_slab.push_back(label_slab_[label]);
            } else {
                node[label] = node[sets_.root(label)];  // a root is smaller, so it has its number already
            }
        }
        out_.sums = SumTable(out_.nodes(), sums_.width);
        for (std::uint32_t label = 0; label < node.size(); ++label) add(out_.sums.row(node[label]), sums_.row(label));
        for (Straddler& s : out_.straddlers) {
            for (std::uint32_t& n : s.node) n = node[n];
        }
        for (std::uint32_t& word : word_) word = node[packing_.label(word)];
        out_.node_of = std::move(word_);
    }

    const PreparedPiece& p_;
    const TriangleMesh& mesh_;
    Vec3 normal_;
    std::span<const double> offsets_;
    Packing packing_;
    std::vector<std::uint32_t> word_;
    std::vector<std::uint16_t> label_slab_;
    DisjointSets sets_;
    SumTable sums_;
    Slabs out_;
};

}  // namespace

void add_to_bases(std::span<double> row, const PreparedPiece& prepared, std::uint32_t triangle, double share,
                  double faces) {
    const bool by_area = prepared.unit.empty();
    const Vec3 look = by_area ? prepared.sums[triangle].area : prepared.unit[triangle];
    const double weight = by_area ? share : faces;
    const std::uint16_t own = prepared.base.empty() ? no_base : prepared.base[triangle];
    double* cell = row.data() + sum_base;
    for (std::size_t b = 0; b < prepared.up.size(); ++b, cell += 3) {
        if (b == own) {
            cell[2] += faces;
            continue;
        }
        const double upwards = weight * dot(look, prepared.up[b]);
        cell[0] += upwards > 0 ? upwards : 0;
        cell[1] += upwards < 0 ? -upwards : 0;
    }
}

Slabs slabs(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets) {
    return Pass(prepared, normal, offsets).run();
}

}  // namespace qchopper
