// Nearest points are found in a k-d tree without pointers: the middle one of a range divides it along the axis in which
// it is longest. A query starts from the match of the point before it, which is near.

#include "segment/objectives/mirror_matches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/box.h"
#include "segment/mesh/connectivity/solids.h"

namespace qchopper {
namespace {

constexpr std::size_t per_leaf = 8;

// The triangles of solids whose area is too small. Empty: none.
std::vector<bool> small_solids(const TriangleMesh& scan, double min_share) {
    const Shells found = shells(scan);
    if (found.count() < 2) return {};
    const std::vector<std::uint32_t> solid = solid_of_triangle(found, solids(scan, found, {0, 0, 1}));
    std::vector<double> area(*std::max_element(solid.begin(), solid.end()) + 1);
    for (std::size_t t = 0; t < solid.size(); ++t) area[solid[t]] += norm(area_vector(scan, t));
    const double least = min_share * *std::max_element(area.begin(), area.end());
    std::vector<bool> is_small(solid.size());
    for (std::size_t t = 0; t < solid.size(); ++t) is_small[t] = area[solid[t]] < least;
    return is_small;
}

}  // namespace

SurfaceSamples symmetry_samples(const TriangleMesh& scan, std::size_t points, double min_solid_area) {
    const SampledSurface surface{&scan, small_solids(scan, min_solid_area)};
    return surface_samples({&surface, 1}, points);
}

MirrorMatches::MirrorMatches(std::vector<Vec3> points) : points_(std::move(points)), axis_(points_.size()) {
    divide(0, points_.size());
}

void MirrorMatches::divide(std::size_t begin, std::size_t end) {
    if (end - begin <= per_leaf) return;
    Box box{points_[begin], points_[begin]};
    for (std::size_t i = begin; i < end; ++i) extend(box, points_[i]);
    int axis = 0;
    for (int a = 1; a < 3; ++a) axis = box.size()[a] > box.size()[axis] ? a : axis;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](Vec3 a, Vec3 b) { return a[axis] < b[axis]; });
    axis_[middle] = static_cast<std::uint8_t>(axis);
    divide(begin, middle);
    divide(middle + 1, end);
}

void MirrorMatches::compare(const Query& query, std::size_t i, Found& found) const {
    const Vec3 away = points_[i] - query.point;
    const double distance2 = dot(away, away);
    if (distance2 < found.distance2 && (height(query.plane.normal, points_[i]) > query.plane.offset) == query.above)
        found = {distance2, i};
}

// `off`: along each axis at least so far the point lies outside the range (S. Arya and D. M. Mount, Algorithms for fast
// vector quantization, 1993).
void MirrorMatches::search(const Query& query, std::size_t begin, std::size_t end, Vec3 off, Found& found) const {
    if (end - begin <= per_leaf) {
        for (std::size_t i = begin; i < end; ++i) compare(query, i, found);
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const int axis = axis_[middle];
    const double away = query.point[axis] - points_[middle][axis];
    if (away < 0)
        search(query, begin, middle, off, found);
    else
        search(query, middle + 1, end, off, found);
    off[axis] = away;
    if (query.within2 * dot(off, off) >= found.distance2) return;
    compare(query, middle, found);
    if (away < 0)
        search(query, middle + 1, end, off, found);
    else
        search(query, begin, middle, off, found);
}

// `near`: one on the same side, which limits the search from the start; or none, of infinite distance.
MirrorMatches::Found MirrorMatches::nearest(const Query& query, const Found& near) const {
    Found found = near;
    if (near.distance2 < std::numeric_limits<double>::infinity()) {
        const Vec3 away = points_[near.point] - query.point;
        found.distance2 = dot(away, away);
    }
    search(query, 0, points_.size(), {}, found);
    return found;
}

std::vector<MirrorMatch> MirrorMatches::of(const Plane& plane, const Matching& how) const {
    std::vector<MirrorMatch> matches;
    matches.reserve(points_.size() / how.every + 1);
    std::array<Found, 2> last;  // below, above
    for (std::size_t i = 0; i < points_.size(); i += how.every) {
        const Vec3 p = points_[i];
        const double above = height(plane.normal, p) - plane.offset;
        const bool is_above = height(plane.normal, p) > plane.offset;
        Found& found = last[is_above ? 0 : 1];
        found = nearest({p - 2 * above * plane.normal, plane, !is_above, how.within * how.within}, found);
        if (found.distance2 == std::numeric_limits<double>::infinity()) return {};
        matches.push_back({p, points_[found.point], found.distance2});
    }
    return matches;
}

double MirrorMatches::score(const Plane& plane, const Matching& how) const {
    std::vector<MirrorMatch> matches = of(plane, how);
    if (matches.empty()) return std::numeric_limits<double>::infinity();
    keep_closest(matches, scored_share);
    double sum = 0;
    for (const MirrorMatch& match : matches) sum += std::sqrt(match.distance2);
    return sum / static_cast<double>(matches.size());
}

void keep_closest(std::vector<MirrorMatch>& matches, double share) {
    if (matches.empty()) return;
    const auto count = static_cast<double>(matches.size());
    const std::size_t kept = std::max<std::size_t>(1, static_cast<std::size_t>(share * count));
    std::nth_element(matches.begin(), matches.begin() + static_cast<std::ptrdiff_t>(kept) - 1, matches.end(),
                     [](const MirrorMatch& a, const MirrorMatch& b) { return a.distance2 < b.distance2; });
    matches.resize(kept);
}

}  // namespace qchopper
