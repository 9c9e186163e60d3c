// Heights of a bumpy body are sums of a few waves.

#include "tests/cam/toolpath/toolpath_pieces.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/box.h"
#include "segment/mesh/measure.h"

namespace qchopper::test_pieces {

CuttingTool ball_tool(double diameter) {
    CuttingTool tool;
    tool.shape = ToolShape::ball;
    tool.diameter = diameter;
    tool.corner_radius = 0.5 * diameter;
    tool.flute_length = 60;
    tool.stick_out = 200;
    return tool;
}

CuttingTool flat_tool(double diameter) {
    CuttingTool tool = ball_tool(diameter);
    tool.shape = ToolShape::flat;
    tool.corner_radius = 0;
    return tool;
}

Setup setup_of(const TriangleMesh& mesh, double margin, double tilt_deg) {
    Setup setup;
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = {-box.centre().x, -box.centre().y, -box.min.z};
    setup.box = {box.min + setup.piece_in_setup.shift, box.max + setup.piece_in_setup.shift};
    setup.spoil = 15;
    setup.block.size = box.size() + Vec3{2 * margin, 2 * margin, margin + setup.spoil};
    setup.access.orientations.push_back({{0, 0, 1}, 0, 0, 0});
    const double tilt = tilt_deg * std::numbers::pi / 180;
    if (tilt_deg > 0) setup.access.orientations.push_back({{std::sin(tilt), 0, std::cos(tilt)}, tilt_deg, 0, 0});
    return setup;
}

TriangleMesh bumpy(double size, std::size_t cells, double high, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    struct Wave {
        double x, y, phase;
    };
    std::vector<Wave> waves;
    for (int k = 0; k < 4; ++k) waves.push_back({8 * unit(random) - 4, 8 * unit(random) - 4, 6.3 * unit(random)});
    const auto at = [&](std::size_t i, std::size_t j) {
        const double x = static_cast<double>(i) / static_cast<double>(cells);
        const double y = static_cast<double>(j) / static_cast<double>(cells);
        double sum = 4;
        for (const Wave& wave : waves) sum += std::sin(6.283 * (wave.x * x + wave.y * y) / 2 + wave.phase);
        return Vec3{size * x, size * y, high * sum / 8 + 1};
    };
    TriangleMesh mesh;
    const auto index = [cells](std::size_t i, std::size_t j, std::size_t layer) {
        return static_cast<std::uint32_t>((layer * (cells + 1) + j) * (cells + 1) + i);
    };
    for (std::size_t layer = 0; layer < 2; ++layer) {
        for (std::size_t j = 0; j <= cells; ++j) {
            for (std::size_t i = 0; i <= cells; ++i) {
                Vec3 p = at(i, j);
                if (layer == 0) p.z = 0;
                mesh.points.push_back(p);
            }
        }
    }
    const auto quad = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (std::size_t j = 0; j < cells; ++j) {
        for (std::size_t i = 0; i < cells; ++i) {
            quad(index(i, j, 1), index(i + 1, j, 1), index(i + 1, j + 1, 1), index(i, j + 1, 1));
            quad(index(i, j, 0), index(i, j + 1, 0), index(i + 1, j + 1, 0), index(i + 1, j, 0));
        }
    }
    for (std::size_t k = 0; k < cells; ++k) {
        quad(index(k, 0, 0), index(k + 1, 0, 0), index(k + 1, 0, 1), index(k, 0, 1));
        quad(index(k + 1, cells, 0), index(k, cells, 0), index(k, cells, 1), index(k + 1, cells, 1));
        quad(index(0, k + 1, 0), index(0, k, 0), index(0, k, 1), index(0, k + 1, 1));
        quad(index(cells, k, 0), index(cells, k + 1, 0), index(cells, k + 1, 1), index(cells, k, 1));
    }
    mesh.cap_of.assign(mesh.triangles.size(), no_cap);
    return mesh;
}

HeightField random_map(std::size_t columns, std::size_t rows, double cell, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> height(0, 50);
    HeightField map;
    map.cell = cell;
    map.columns = columns;
    map.rows = rows;
    for (std::size_t i = 0; i < columns * rows; ++i) map.height.push_back(height(random));
    return map;
}

}  // namespace qchopper::test_pieces
