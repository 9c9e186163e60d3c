#include "tests/segment/repair/soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

class Stirring {
 public:
    explicit Stirring(const Soup& soup) : soup_(soup), random_(soup.seed) {}

    TriangleMesh run() {
        constexpr std::array<std::uint32_t, 6> sides{1, 2, 2, 3, 5, 9};
        side_ = sides[below(sides.size())];
        const std::uint32_t shells = 1 + below(below(4) == 0 ? 40 : 8);
        for (std::uint32_t i = 0; i < shells; ++i) {
            TriangleMesh shell = some_shell();
            const double volume = volume_mm3(shell);
            const bool inwards = soup_.all_outward ? volume < 0 : below(3) == 0;
            add(inwards ? shapes::turned_inside_out(shell) : shell);
            if (below(8) == 0) add(inwards ? shapes::turned_inside_out(shell) : shell);
        }
        for (std::uint32_t i = below(4); i > 0; --i) double_a_face();
        for (std::uint32_t i = below(3); i > 0; --i) collapse_a_face();
        std::shuffle(faces_.begin(), faces_.end(), random_);
        return placed();
    }

 private:
    using Face = std::array<Vec3, 3>;

    std::uint32_t below(std::size_t end) { return static_cast<std::uint32_t>(random_() % end); }
    Vec3 corner() {
        return {static_cast<double>(below(side_ + 1)), static_cast<double>(below(side_ + 1)),
                static_cast<double>(below(side_ + 1))};
    }

    TriangleMesh some_shell() {
        switch (below(5)) {
            case 0: {
                const Vec3 low = corner();
                const Vec3 size = corner() + Vec3{1, 1, 1};
                return shapes::box(low, low + size, 1 + static_cast<int>(below(3)));
            }
            case 1: {  // around the cell of the grid, turned with it: shares whole walls with its neighbours
                const Vec3 low = corner();
                return shapes::box(low, low + Vec3{1, 1, 1});
            }
            case 2: {  // snapped, so that it touches itself
                TriangleMesh torus = shapes::torus({2, 2, 1}, 1.5, 1, 6);
                return clustered(std::move(torus), 1);
            }
            case 3: {
                TriangleMesh ball = shapes::ball(corner(), 1.5 + below(3), 5);
                return clustered(std::move(ball), 1);
            }
            default: {  // four points: may have no volume, or no area anywhere
                TriangleMesh four;
                for (int i = 0; i < 4; ++i) four.points.push_back(corner());
                four.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
                return four;
            }
        }
    }

    void add(const TriangleMesh& shell) {
        for (const Triangle& t : shell.triangles) {
            Face face{shell.points[t[0]], shell.points[t[1]], shell.points[t[2]]};
            std::rotate(face.begin(), face.begin() + below(3), face.end());
            faces_.push_back(face);
        }
    }

    void double_a_face() {
        Face face = faces_[below(faces_.size())];
        if (below(2) == 0) face = {corner(), corner(), corner()};  // hangs in the air, or between others
        faces_.push_back(face);
        faces_.push_back({face[0], face[2], face[1]});
    }

    void collapse_a_face() {
        const Face face = faces_[below(faces_.size())];
        faces_.push_back({face[0], face[1], face[1]});
    }

    TriangleMesh placed() {
        constexpr std::array<double, 6> scales{1, 1, 1e-6, 0.1, 1e5, 1.0 / 3};
        const double scale = scales[below(scales.size())];
        const bool is_shifted = below(3) == 0;
        TriangleMesh mesh;
        for (const Face& face : faces_) {
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            for (const Vec3 p : face) mesh.points.push_back(scale * (is_shifted ? p - Vec3{2.5, 1, 3} : p));
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
        return mesh;
    }

    Soup soup_;
    std::mt19937 random_;
    std::uint32_t side_ = 1;
    std::vector<Face> faces_;
};

}  // namespace

TriangleMesh balanced_soup(const Soup& soup) {
    return Stirring(soup).run();
}

TriangleMesh clustered(TriangleMesh mesh, double cell) {
    for (Vec3& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = cell * std::floor(p[axis] / cell + 0.5);
    }
    return mesh;
}

}  // namespace qchopper
