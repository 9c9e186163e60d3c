// Samples of the pass, half a cell of the foam's map apart, against the cells under the ball.

#include "cam/toolpath/cutting_parts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include "cam/toolpath/pass_stretches.h"
#include "segment/raster/cells_under.h"

namespace qchopper {
namespace {

constexpr double steep_sine = 0.9925;                        // of 83 degrees, from which on a slope counts as a wall
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;  // of a cell
constexpr double worth_a_way = 40;                           // mm of air between two cuts

// Whether a ball with its tip at a point cuts foam deeper than a film, or touches a wall: foam on a wall that is
// thinner than a cell may lie between centres.
class CutsAt {
 public:
    CutsAt(const HeightField& stock, const CuttingTool& tool, double film)
        : stock_(stock),
          film_(film),
          radius_(0.5 * tool.diameter),
          reach_(radius_ + half_diagonal * stock.cell),
          wall_from_(steep_sine * radius_),
          wall_above_((1 - std::sqrt(1 - steep_sine * steep_sine)) * radius_) {}

    bool operator()(Vec3 tip) const {
        const CellSpan rows =
            centres_within((tip.y - reach_) / stock_.cell, (tip.y + reach_) / stock_.cell, stock_.rows);
        for (std::size_t row = rows.first; row < rows.end; ++row) {
            const double y = stock_.cell * (static_cast<double>(row) + 0.5) - tip.y;
            const double half = std::sqrt(std::max(0.0, reach_ * reach_ - y * y));
            const CellSpan columns =
                centres_within((tip.x - half) / stock_.cell, (tip.x + half) / stock_.cell, stock_.columns);
            const float* own = &stock_.height[row * stock_.columns];
            for (std::size_t column = columns.first; column < columns.end; ++column) {
                const double above = static_cast<double>(own[column]) - tip.z - film_;
                if (above <= 0) continue;
                const double x = stock_.cell * (static_cast<double>(column) + 0.5) - tip.x;
                if (is_cut(x * x + y * y, above)) return true;
            }
        }
        return false;
    }

 private:
    // A centre so far from the axis, squared, and so high above the tip.
    bool is_cut(double square, double above) const {
        if (square > wall_from_ * wall_from_ && above > wall_above_) return true;
        const double under = std::max(0.0, radius_ - above);
        return square + under * under < radius_ * radius_;
    }

    const HeightField& stock_;
    double film_;
    double radius_;
    double reach_;
    double wall_from_;   // from the axis on the ball touches walls
    double wall_above_;  // the tip
};

// Air at an end of a pass, and such between two cuts as is longer than what a way around it costs.
std::vector<Stretch> left_out(const std::vector<Stretch>& air, double length, double beside) {
    std::vector<Stretch> stretches;
    for (const Stretch& own : air) {
        const bool is_first = own.from <= 0;
        const bool is_last = own.to >= length;
        const Stretch less{is_first ? 0 : own.from + beside, is_last ? length : own.to - beside};
        const double least = is_first || is_last ? min_part : worth_a_way;
        if (less.to - less.from >= least) stretches.push_back(less);
    }
    return stretches;
}

}  // namespace

bool is_cutting(const Pass& pass, const HeightField& stock, const CuttingTool& tool, double film) {
    assert(tool.shape == ToolShape::ball && film >= 0);
    const CutsAt cuts(stock, tool, film);
    return !blocked_stretches(pass, 0.5 * stock.cell, std::not_fn(cuts)).empty();
}

std::vector<Pass> cutting_parts(const Pass& pass, const AirOptions& options, const std::function<bool(Vec3)>& cuts) {
    const double length = length_of(pass);
    const std::vector<Stretch> air = left_out(blocked_stretches(pass, options.apart, cuts), length, options.beside);
    if (air.empty()) return {pass};
    std::vector<Pass> parts;
    const auto add = [&](Pass part) {
        if (length_of(part) > min_length) parts.push_back(std::move(part));
    };
    PassCutter cutter(pass);
    for (const Stretch& own : air) {
        if (own.from > 0) add(cutter.up_to(own.from));
        cutter.up_to(own.to);
    }
    if (air.back().to < length) add(cutter.up_to(length + 1));
    return parts;
}

std::vector<Pass> cutting_parts(const std::vector<Pass>& passes, const HeightField& stock, const CuttingTool& tool,
                                double film) {
    assert(tool.shape == ToolShape::ball && film >= 0);
    const CutsAt cuts(stock, tool, film);
    std::vector<Pass> parts;
    for (const Pass& pass : passes) {
        std::vector<Pass> own = cutting_parts(pass, {0.5 * stock.cell}, std::cref(cuts));
        std::move(own.begin(), own.end(), std::back_inserter(parts));
    }
    return parts;
}

}  // namespace qchopper
