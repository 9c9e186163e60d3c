// Ear clipping after G. H. Meisters, "Polygons have ears", 1975. Of n corners: O(n^2) as a rule, O(n^3) at worst; after
// 4 n^2 tests of a corner against an ear the rest is split without a search.

#include "segment/io/formats/add_face.h"

#include <cassert>
#include <cstddef>

namespace qchopper {
namespace {

// Newell's normal: right for concave and slightly bent polygons.
Vec3 mean_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) {
    Vec3 sum;
    const Vec3 origin = points[corners[0]];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = points[corners[i]] - origin;
        const Vec3 b = points[corners[(i + 1) % corners.size()]] - origin;
        sum = sum + cross(a, b);
    }
    return sum;
}

double turn(Vec3 normal, Vec3 a, Vec3 b, Vec3 c) {
    return dot(normal, cross(b - a, c - a));
}

// The corners that remain while ears are removed.
class Ring {
 public:
    Ring(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners)
        : points_(points), normal_(mean_normal(points, corners)), ring_(corners.begin(), corners.end()) {
        for (std::size_t i = 0; i < ring_.size(); ++i) blocks_.push_back(!is_convex(i));
        tests_left_ = 4 * ring_.size() * ring_.size();
    }

    std::size_t size() const { return ring_.size(); }

    // An ear is convex and holds no other corner; only corners that are not convex can lie in one.
    bool is_ear(std::size_t tip) {
        if (!is_convex(tip)) return false;
        const Triangle t = triangle(tip);
        const Vec3 a = points_[t[0]];
        const Vec3 b = points_[t[1]];
        const Vec3 c = points_[t[2]];
        for (std::size_t i = 0; i < ring_.size(); ++i) {
            const std::uint32_t corner = ring_[i];
            if (!blocks_[i] || corner == t[0] || corner == t[1] || corner == t[2]) continue;
            if (tests_left_ > 0) --tests_left_;
            const Vec3 p = points_[corner];
            if (turn(normal_, a, b, p) >= 0 && turn(normal_, b, c, p) >= 0 && turn(normal_, c, a, p) >= 0) return false;
        }
        return true;
    }

    // A polygon that crosses itself everywhere has few ears, and a search for each would take too long.
    bool is_exhausted() const { return tests_left_ == 0; }

    Triangle triangle(std::size_t tip) const {
        const std::size_t n = ring_.size();
        return {ring_[(tip + n - 1) % n], ring_[tip], ring_[(tip + 1) % n]};
    }

    void remove(std::size_t tip) {
        ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(tip));
        blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(tip));
        const std::size_t n = ring_.size();
        for (const std::size_t beside : {(tip + n - 1) % n, tip % n}) blocks_[beside] = !is_convex(beside);
    }

 private:
    bool is_convex(std::size_t tip) const {
        const Triangle t = triangle(tip);
        return turn(normal_, points_[t[0]], points_[t[1]], points_[t[2]]) > 0;
    }

    const std::vector<Vec3>& points_;
    Vec3 normal_;
    std::vector<std::uint32_t> ring_;
    std::vector<bool> blocks_;  // per corner of the ring: it is not convex, so it can lie in an ear
    std::size_t tests_left_ = 0;
};

}  // namespace

void split_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                   std::vector<Triangle>& triangles) {
    assert(corners.size() >= 3);
    Ring ring(points, corners);
    std::size_t tip = 1;  // a convex polygon becomes the fan about its first corner
    while (ring.size() > 3) {
        const std::size_t n = ring.size();
        std::size_t tries = 0;
        while (tries < n && !ring.is_exhausted() && !ring.is_ear(tip % n)) {
            ++tip;
            ++tries;
        }
        tip %= n;  // without an ear it is where it was, and that corner is removed
        triangles.push_back(ring.triangle(tip));
        ring.remove(tip);
        if (tip == 0) tip = 1;
    }
    triangles.push_back(ring.triangle(1));
}

void add_face(RawMesh& scan, std::span<const std::uint32_t> corners) {
    ++scan.faces_in_file;
    if (corners.size() < 3) {
        ++scan.faces_without_area;
    } else if (corners.size() == 3) {
        scan.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
        split_polygon(scan.mesh.points, corners, scan.mesh.triangles);
    }
}

}  // namespace qchopper
