// The directions are asked with few of the points first, and what remains with more of them; the best planes are
// brought to the least score by a pattern search. O(points log points) for the tree of mirror_matches.h, some 1,000,000
// queries of O(log points) in all.

#include "segment/objectives/symmetry_plane.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/plane_frame.h"
#include "segment/objectives/mirror_matches.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double matched_share = 0.8;  // of the matches

// About which planes are turned, and how far from there the points are: root of the mean square.
struct Lever {
    Vec3 centre;
    double arm = 0;
};

using Matrix = std::array<Vec3, 3>;  // symmetric, by rows

// Jacobi's rotations, each of which makes one pair of elements beside the diagonal zero.
Vec3 min_eigenvector(Matrix m) {
    constexpr int sweeps = 12;  // their size falls as the square from one to the next
    Matrix vectors{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            if (m[p][q] == 0) continue;
            const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
            const double c = std::cos(angle);
            const double s = std::sin(angle);
            for (int k = 0; k < 3; ++k) {
                const Vec3 column{m[k][p], m[k][q], 0};
                m[k][p] = c * column.x - s * column.y;
                m[k][q] = s * column.x + c * column.y;
            }
            const Vec3 row = m[p];
            m[p] = c * row - s * m[q];
            m[q] = s * row + c * m[q];
            const Vec3 vector = vectors[p];
            vectors[p] = c * vector - s * vectors[q];
            vectors[q] = s * vector + c * vectors[q];
        }
    }
    int least = 0;
    for (int k = 1; k < 3; ++k) least = m[k][k] < m[least][least] ? k : least;
    return normalized(vectors[least]);
}

// The plane for which the squared distances of mirror images from their matches add up to least. With heights a and b
// of point and match over it, the squared distance is that of the points themselves plus 4 a b: so the plane goes
// through the centroid c of all, and its normal n makes the sum of (n.(p - c)) (n.(q - c)) least, an eigenvector.
Plane fitted(const std::vector<MirrorMatch>& matches) {
    Vec3 sum;
    for (const MirrorMatch& match : matches) sum = sum + match.point + match.match;
    const Vec3 centre = (0.5 / static_cast<double>(matches.size())) * sum;
    Matrix products{};
    for (const MirrorMatch& match : matches) {
        const Vec3 p = match.point - centre;
        const Vec3 q = match.match - centre;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) products[i][j] += 0.5 * (p[i] * q[j] + p[j] * q[i]);
        }
    }
    const Vec3 n = min_eigenvector(products);
    return canonical({n, dot(n, centre)});
}

struct Scored {
    Plane plane;
    double score = infinite;
};

// By turns of matching and fitting; a turn of the normal by less than `enough` (radians) is the last.
Plane refined(const MirrorMatches& mirror, Plane plane, const Matching& how, double enough, int turns) {
    for (int turn = 0; turn < turns; ++turn) {
        std::vector<MirrorMatch> matches = mirror.of(plane, how);
        if (matches.empty()) return plane;
        keep_closest(matches, matched_share);
        const Plane before = plane;
        plane = fitted(matches);
        if (norm(plane.normal - before.normal) < enough) return plane;
    }
    return plane;
}

// Turned by an angle about a point in it.
Plane turned(const Plane& plane, Vec3 centre, Vec3 towards, double angle_rad) {
    const Vec3 in_plane = centre - (height(plane.normal, centre) - plane.offset) * plane.normal;
    const Vec3 normal = normalized(std::cos(angle_rad) * plane.normal + std::sin(angle_rad) * towards);
    return canonical({normal, dot(normal, in_plane)});
}

// Turned about two axes in it, and shifted, by a step either way.
std::array<Scored, 6> around(const Plane& plane, Vec3 centre, double step_rad, double shift) {
    const PlaneFrame frame = frame_across(plane.normal);
    return {{{turned(plane, centre, frame.u, step_rad)},
             {turned(plane, centre, frame.u, -step_rad)},
             {turned(plane, centre, frame.v, step_rad)},
             {turned(plane, centre, frame.v, -step_rad)},
             {canonical({plane.normal, plane.offset + shift})},
             {canonical({plane.normal, plane.offset - shift})}}};
}

// Goes to the best plane around while one is better, then halves the step: pattern search (Hooke and Jeeves, "Direct
// search" solution of numerical and statistical problems, 1961). What is found has the least score, which the fit
// of squares has not where much of one side has no match.
Scored descended(const MirrorMatches& mirror, const Lever& lever, Scored best, const Matching& how, double step_rad,
                 double min_rad) {
    best.score = mirror.score(best.plane, how);
    while (step_rad >= min_rad) {
        std::array<Scored, 6> tried = around(best.plane, lever.centre, step_rad, step_rad * lever.arm);
        parallel_for(0, tried.size(), [&](std::size_t i) { tried[i].score = mirror.score(tried[i].plane, how); });
        const auto least = std::min_element(tried.begin(), tried.end(),
                                            [](const Scored& a, const Scored& b) { return a.score < b.score; });
        if (least->score < best.score)
            best = *least;
        else
            step_rad /= 2;
    }
    return best;
}

// Scores the planes with every n-th point and keeps so many of the best. Of equal scores the earlier plane is better.
void keep_best(std::vector<Scored>& planes, const MirrorMatches& mirror, const Matching& how, std::size_t kept) {
    parallel_for(0, planes.size(), [&](std::size_t i) { planes[i].score = mirror.score(planes[i].plane, how); });
    std::stable_sort(planes.begin(), planes.end(), [](const Scored& a, const Scored& b) { return a.score < b.score; });
    planes.resize(std::min(planes.size(), kept));
}

void refine(std::vector<Scored>& planes, const MirrorMatches& mirror, const Matching& how, double enough, int turns) {
    parallel_for(0, planes.size(),
                 [&](std::size_t i) { planes[i].plane = refined(mirror, planes[i].plane, how, enough, turns); });
}

Lever lever_of(const std::vector<Vec3>& points) {
    const double share = 1 / static_cast<double>(points.size());
    const Vec3 centre = share * std::accumulate(points.begin(), points.end(), Vec3{});
    double sum = 0;
    for (const Vec3& p : points) sum += dot(p - centre, p - centre);
    return {centre, std::sqrt(share * sum)};
}

}  // namespace

Vec3 reflected(Vec3 point, const Plane& mirror) {
    return point - 2 * (height(mirror.normal, point) - mirror.offset) * mirror.normal;
}

Plane reflected(const Plane& plane, const Plane& mirror) {
    const Vec3 normal = normalized(plane.normal - 2 * dot(plane.normal, mirror.normal) * mirror.normal);
    return canonical({normal, dot(normal, reflected(plane.offset * plane.normal, mirror))});
}

std::optional<SymmetryPlane> symmetry_plane(const TriangleMesh& scan, const SymmetryOptions& options) {
    const SurfaceSamples samples = symmetry_samples(scan, options.points, options.min_solid_area);
    std::vector<Vec3> points;
    for (const SurfaceSample& sample : samples.sample) points.push_back(sample.point);
    if (points.size() < 4) return std::nullopt;
    const Lever lever = lever_of(points);
    const MirrorMatches mirror(std::move(points));
    std::vector<Scored> planes;
    for (const Vec3& d : dense_directions(2 * options.directions)) {
        if (d.z > 0) planes.push_back({canonical({d, dot(d, lever.centre)})});
    }
    const auto some = [&](std::size_t of, double within) {
        return Matching{std::max<std::size_t>(1, options.points / of), within};
    };
    keep_best(planes, mirror, some(250, 2), planes.size() / 5);
    keep_best(planes, mirror, some(1'000, 2), 6 * options.refined);
    refine(planes, mirror, some(400, 1.5), 2e-3, 10);
    keep_best(planes, mirror, some(1'000, 1.5), options.refined);
    refine(planes, mirror, some(2'000, 1.2), 5e-4, 6);
    keep_best(planes, mirror, some(2'500, 1), 3);
    for (Scored& s : planes) s = descended(mirror, lever, s, some(2'500, 1), 0.03, 0.004);
    keep_best(planes, mirror, {}, 1);
    planes.push_back({refined(mirror, planes[0].plane, {}, 5e-5, 4)});  // better where all is symmetric
    keep_best(planes, mirror, {}, 1);
    planes[0] = descended(mirror, lever, planes[0], {}, 0.004, 0.001);
    if (planes.front().score == infinite) return std::nullopt;
    return SymmetryPlane{planes.front().plane, planes.front().score, std::sqrt(samples.area_each_mm2)};
}

}  // namespace qchopper
