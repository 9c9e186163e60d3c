// Edge flips at the longest edges of the degenerate triangles, in rounds, until none changes anything. O(triangles) to
// find them and their neighbours, then about O(1) per flip.

#include "segment/repair/degenerate.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-15;
constexpr int max_rounds = 64;  // of a row of such triangles each round removes those at its ends

bool is_on_a_line(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const Vec3 w = c - b;
    return norm(cross(u, v)) <= rounding * std::max({dot(u, u), dot(v, v), dot(w, w)});
}

class Removal {
 public:
    Removal(TriangleMesh& mesh, SourceFaces* sources)
        : mesh_(mesh), sources_(sources), twin_(edges(mesh).twin), is_kept_(mesh.triangles.size(), true) {}

    Degenerate run(std::vector<std::uint32_t> flat) {
        for (int round = 0; round < max_rounds && !flat.empty(); ++round) {
            std::vector<std::uint32_t> again;
            bool is_any = false;
            for (const std::uint32_t t : flat) {
                if (!is_kept_[t] || !is_degenerate(mesh_, t)) continue;
                const std::uint32_t longest = longest_edge(t);
                const std::uint32_t other = twin_[longest];
                if (other == no_twin) {
                    drop(t);
                } else if (!flip(longest, other)) {
                    again.push_back(t);
                    continue;
                } else {
                    for (const std::uint32_t changed : {t, other / 3}) {
                        if (is_degenerate(mesh_, changed)) again.push_back(changed);
                    }
                }
                is_any = true;
            }
            std::sort(again.begin(), again.end());
            again.erase(std::unique(again.begin(), again.end()), again.end());
            flat = std::move(again);
            if (!is_any) break;
        }
        counts_.left = flat.size();
        if (counts_.dropped > 0) keep_triangles(mesh_, is_kept_, sources_);
        return counts_;
    }

 private:
    Vec3 point(std::uint32_t h) const { return mesh_.points[start_of(mesh_, h)]; }

    std::uint32_t longest_edge(std::uint32_t t) const {
        std::uint32_t best = 3 * t;
        double longest = -1;
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const Vec3 d = point(next_in_triangle(h)) - point(h);
            if (dot(d, d) <= longest) continue;
            longest = dot(d, d);
            best = h;
        }
        return best;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        if (a != no_twin) twin_[a] = b;
        if (b != no_twin) twin_[b] = a;
    }

    void drop(std::uint32_t t) {
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            if (twin_[h] != no_twin) twin_[twin_[h]] = no_twin;
        }
        is_kept_[t] = false;
        ++counts_.dropped;
    }

    // Whether an edge runs between the corner where h starts and the point v.
    bool has_edge(std::uint32_t h, std::uint32_t v) const {
        const auto ends_in = [&](std::uint32_t at) {
            return end_of(mesh_, at) == v || start_of(mesh_, previous_in_triangle(at)) == v;
        };
        if (ends_in(h)) return true;
        for (std::uint32_t at = twin_[h]; at != no_twin; at = twin_[at]) {
            at = next_in_triangle(at);
            if (at == h) return false;
            if (ends_in(at)) return true;
        }
        for (std::uint32_t at = twin_[previous_in_triangle(h)]; at != no_twin; at = twin_[previous_in_triangle(at)]) {
            if (at == h || ends_in(at)) return at != h;
        }
        return false;
    }

    // h runs c -> a, its twin a -> c; b and d lie across. The two triangles become (a, b, d) and (b, c, d).
    bool flip(std::uint32_t h, std::uint32_t g) {
        const std::uint32_t a = end_of(mesh_, h);
        const std::uint32_t c = start_of(mesh_, h);
        const std::uint32_t b = start_of(mesh_, previous_in_triangle(h));
        const std::uint32_t d = start_of(mesh_, previous_in_triangle(g));
        const auto is_flat = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return is_on_a_line(mesh_.points[i], mesh_.points[j], mesh_.points[k]);
        };
        const int before = 1 + static_cast<int>(is_degenerate(mesh_, g / 3));
        const int after = static_cast<int>(is_flat(a, b, d)) + static_cast<int>(is_flat(b, c, d));
        const auto length = [&](std::uint32_t i, std::uint32_t j) { return norm(mesh_.points[i] - mesh_.points[j]); };
        // Two adjacent ones are flipped only while their common edge becomes shorter, so that the flips end.
        const bool helps = after < before || (before == 2 && length(b, d) < length(a, c));
        if (b == d || !helps || has_edge(previous_in_triangle(h), d)) return false;
        const std::uint32_t ab = twin_[next_in_triangle(h)];
        const std::uint32_t bc = twin_[previous_in_triangle(h)];
        const std::uint32_t cd = twin_[next_in_triangle(g)];
        const std::uint32_t da = twin_[previous_in_triangle(g)];
        const std::uint32_t first = 3 * (h / 3);
        const std::uint32_t second = 3 * (g / 3);
        mesh_.triangles[h / 3] = {a, b, d};
        mesh_.triangles[g / 3] = {b, c, d};
        join(first, ab);
        join(first + 1, second + 2);
        join(first + 2, da);
        join(second, bc);
        join(second + 1, cd);
        if (sources_ != nullptr) sources_->of[h / 3] = sources_->of[g / 3] = new_face;
        ++counts_.flipped;
        return true;
    }

    TriangleMesh& mesh_;
    SourceFaces* sources_;
    std::vector<std::uint32_t> twin_;
    std::vector<bool> is_kept_;
    Degenerate counts_;
};

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, std::size_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    return is_on_a_line(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

Degenerate remove_degenerate(TriangleMesh& mesh, SourceFaces* sources) {
    assert(mesh.cap_of.empty());
    std::vector<std::uint32_t> flat;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (is_degenerate(mesh, t)) flat.push_back(t);
    }
    if (flat.empty()) return {};
    return Removal(mesh, sources).run(std::move(flat));
}

}  // namespace qchopper
