// A quadric height field (S. Petitjean, "A survey of methods for recovering quadrics in triangle meshes", 2002) is
// fitted by iteratively reweighted least squares (P. Holland, R. Welsch, "Robust regression using iteratively
// reweighted least-squares", 1977): samples below it have less weight the deeper they lie, samples above it keep
// theirs. The samples lie in a grid: O(points log points) to build, a fit takes the samples within the reach.

#include "segment/repair/pen_grooves/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "segment/mesh/measure.h"
#include "segment/mesh/normals.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

constexpr std::uint64_t max_cells = (1U << 20) - 2;  // along an axis: a cell number has 20 bits for each
constexpr int terms = 6;                             // 1, x, y, x2, xy, y2
constexpr double same_side = 0.5;                    // cosine between normals of one side of a wall

std::uint64_t cell_at(Vec3 p, Vec3 origin, double size) {
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = std::clamp((p[axis] - origin[axis]) / size, 0.0, static_cast<double>(max_cells));
        cell = cell << 20 | (static_cast<std::uint64_t>(at) + 1);  // + 1: the cell before the first has a number too
    }
    return cell;
}

// The number, 0 to 5, of the axis direction that is nearest to a normal.
std::uint64_t side_of(Vec3 n) {
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
    }
    return 2 * static_cast<std::uint64_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

// A sample in the frame of the fit, in units of the reach.
struct LocalSample {
    double x = 0;
    double y = 0;
    double height = 0;
    double weight = 1;
};

using QuadricTerms = std::array<double, terms>;

QuadricTerms terms_at(const LocalSample& s) {
    return {1, s.x, s.y, s.x * s.x, s.x * s.y, s.y * s.y};
}

// Solves the normal equations by Cholesky's method. False if the samples do not determine the quadric.
bool solve(const std::vector<LocalSample>& samples, QuadricTerms& quadric) {
    std::array<QuadricTerms, terms> a{};
    QuadricTerms b{};
    for (const LocalSample& s : samples) {
        const QuadricTerms row = terms_at(s);
        for (int i = 0; i < terms; ++i) {
            for (int k = 0; k <= i; ++k) a[i][k] += s.weight * row[i] * row[k];
            b[i] += s.weight * row[i] * s.height;
        }
    }
    const double least = 1e-9 * a[0][0];
    for (int i = 0; i < terms; ++i) {
        for (int k = 0; k <= i; ++k) {
            double sum = a[i][k];
            for (int m = 0; m < k; ++m) sum -= a[i][m] * a[k][m];
            if (k < i) {
                a[i][k] = sum / a[k][k];
            } else if (sum > least) {
                a[i][i] = std::sqrt(sum);
            } else {
                return false;
            }
        }
    }
    for (int i = 0; i < terms; ++i) {
        for (int m = 0; m < i; ++m) b[i] -= a[i][m] * b[m];
        b[i] /= a[i][i];
    }
    for (int i = terms - 1; i >= 0; --i) {
        for (int m = i + 1; m < terms; ++m) b[i] -= a[m][i] * b[m];
        b[i] /= a[i][i];
    }
    quadric = b;
    return true;
}

double height_of(const QuadricTerms& quadric, const LocalSample& s) {
    const QuadricTerms row = terms_at(s);
    double sum = 0;
    for (int i = 0; i < terms; ++i) sum += quadric[i] * row[i];
    return sum;
}

// Root mean square distance from the quadric: of the samples above it, as nothing of a groove is among them.
double roughness_of(const std::vector<LocalSample>& samples, const QuadricTerms& quadric) {
    double sum = 0;
    std::size_t count = 0;
    for (const LocalSample& s : samples) {
        const double above = s.height - height_of(quadric, s);
        if (above <= 0) continue;
        sum += above * above;
        ++count;
    }
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

}  // namespace

SurfaceFitter::SurfaceFitter(const TriangleMesh& mesh, double reach, double spacing)
    : mesh_(mesh), reach_(reach), origin_(bounds(mesh).min), normals_(vertex_normals(mesh)) {
    // The samples: of every cell of the spacing and every side of a wall the first point.
    struct Candidate {
        std::uint64_t cell;
        std::uint64_t side;
        std::uint32_t point;
        auto operator<=>(const Candidate&) const = default;
    };
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
        if (normals_[i] == Vec3{}) continue;
        candidates.push_back({cell_at(mesh.points[i], origin_, spacing), side_of(normals_[i]), i});
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const bool is_first =
            i == 0 || candidates[i].cell != candidates[i - 1].cell || candidates[i].side != candidates[i - 1].side;
        if (!is_first) continue;
        samples_.push_back({cell_at(mesh.points[candidates[i].point], origin_, reach), candidates[i].point});
    }
    std::sort(samples_.begin(), samples_.end(),
              [](const Sample& a, const Sample& b) { return a.cell != b.cell ? a.cell < b.cell : a.point < b.point; });
}

template <class Visit>
void SurfaceFitter::for_each_near(Vec3 p, const Visit& visit) const {
    const std::uint64_t middle = cell_at(p, origin_, reach_);
    for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
            // the three cells along z have consecutive numbers
            const std::uint64_t first =
                middle + (static_cast<std::uint64_t>(dx) << 40) + (static_cast<std::uint64_t>(dy) << 20) - 1;
            auto it = std::lower_bound(samples_.begin(), samples_.end(), first,
                                       [](const Sample& s, std::uint64_t cell) { return s.cell < cell; });
            for (; it != samples_.end() && it->cell <= first + 2; ++it) {
                const Vec3 d = mesh_.points[it->point] - p;
                if (dot(d, d) <= reach_ * reach_) visit(it->point, d);
            }
        }
    }
}

SurfaceFit SurfaceFitter::fit(std::uint32_t point, const std::vector<std::uint8_t>* left_out) const {
    constexpr std::size_t fewest_samples = 15;
    constexpr int rounds = 5;
    SurfaceFit result;
    const Vec3 p = mesh_.points[point];
    const Vec3 own = normals_[point];
    if (own == Vec3{}) return result;
    Vec3 sum;
    for_each_near(p, [&](std::uint32_t i, Vec3) {
        if (dot(normals_[i], own) > same_side) sum = sum + normals_[i];
    });
    result.normal = normalized(sum == Vec3{} ? own : sum);
    const PlaneFrame frame = frame_across(result.normal);
    std::vector<LocalSample> samples;
    std::array<int, 4> in_quarter{};
    for_each_near(p, [&](std::uint32_t i, Vec3 d) {
        if ((left_out != nullptr && (*left_out)[i] != 0) || dot(normals_[i], result.normal) <= same_side) return;
        const LocalSample s{dot(d, frame.u) / reach_, dot(d, frame.v) / reach_, dot(d, result.normal) / reach_, 1};
        samples.push_back(s);
        ++in_quarter[(s.x > 0 ? 1 : 0) + (s.y > 0 ? 2 : 0)];
    });
    // At a border or a sharp edge samples on some side are missing.
    if (samples.size() < fewest_samples || *std::min_element(in_quarter.begin(), in_quarter.end()) < 2) return result;
    QuadricTerms quadric{};
    double roughness = 0;
    for (int round = 0; round < rounds; ++round) {
        if (!solve(samples, quadric)) return result;
        roughness = roughness_of(samples, quadric);
        if (left_out == nullptr && quadric[0] < 0.3 * roughness) break;  // no groove here
        const double scale = std::max(1.5 * roughness, 1e-9);
        for (LocalSample& s : samples) {
            const double below = std::max(0.0, height_of(quadric, s) - s.height) / scale;
            s.weight = 1 / ((1 + below * below) * (1 + below * below));
        }
    }
    result.is_good = true;
    result.depth = quadric[0] * reach_;
    result.roughness = roughness * reach_;
    return result;
}

}  // namespace qchopper
