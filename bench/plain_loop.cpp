// A ball of radius r whose centre goes along a line of slope s: at a distance v beside the line its section is a circle
// of radius w = sqrt(r^2 - v^2), and over a point u along the line the lowest one of the circles is that which touches
// the envelope there, with its centre w * s / sqrt(1 + s^2) before u; beyond the ends of the move it is the first or
// the last circle. A flat end is lowest where it comes to the point or leaves it.

#include "bench/plain_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bench/clock.h"
#include "sim/replay/stock/cutter.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper::bench {
namespace {

constexpr float not_cut = std::numeric_limits<float>::infinity();

struct HeightField {
    Pose frame;  // of the orientation in the setup
    double x_min = 0;
    double y_min = 0;
    double cell = 0;
    std::int32_t width = 0;
    std::int32_t length = 0;
    std::vector<float> height;

    // Of cells with their centres between two places of an axis; it may be empty.
    std::int32_t first(double from, double min) const {
        return std::max(0, static_cast<std::int32_t>(std::ceil((from - min) / cell - 0.5)));
    }
    std::int32_t end(double to, double min, std::int32_t count) const {
        return std::min(count, static_cast<std::int32_t>(std::floor((to - min) / cell - 0.5)) + 1);
    }
};

HeightField field_of(const Box& block, Vec3 tool_axis, double cell) {
    HeightField field;
    field.frame = tool_axis_frame(tool_axis);
    field.cell = cell;
    Vec3 low{1e9, 1e9, 0};
    Vec3 high = -low;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 p = apply_inverse(field.frame, {(corner & 1U) != 0 ? block.max.x : block.min.x,
                                                   (corner & 2U) != 0 ? block.max.y : block.min.y,
                                                   (corner & 4U) != 0 ? block.max.z : block.min.z});
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    field.x_min = low.x;
    field.y_min = low.y;
    field.width = static_cast<std::int32_t>(std::ceil((high.x - low.x) / cell));
    field.length = static_cast<std::int32_t>(std::ceil((high.y - low.y) / cell));
    field.height.assign(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.length), not_cut);
    return field;
}

// A move in the frame of its orientation. The heights are those of the tool over a point that lies u along its line and
// v beside it.
struct Move {
    Vec3 from;
    Vec3 to;
    double radius = 0;
    double length = 0;  // across the tool axis
    double unit_x = 1;
    double unit_y = 0;
    double slope = 0;
    double share = 0;   // slope / sqrt(1 + slope^2)
    double lowest = 0;  // of the tip of a plunge

    Move(Vec3 a, Vec3 b, double r) : from(a), to(b), radius(r), length(std::hypot(b.x - a.x, b.y - a.y)) {
        lowest = std::min(a.z, b.z);
        if (length < 1e-9) length = 0;
        if (length == 0) return;
        unit_x = (b.x - a.x) / length;
        unit_y = (b.y - a.y) / length;
        slope = (b.z - a.z) / length;
        share = slope / std::sqrt(1 + slope * slope);
    }
    double tip_at(double t) const { return length > 0 ? from.z + slope * t : lowest; }
    double of_ball(double u, double v) const {
        const double across = std::max(0.0, radius * radius - v * v);
        const double t = std::clamp(u - share * std::sqrt(across), 0.0, length);
        const double below = across - (u - t) * (u - t);
        return below < 0 ? not_cut : tip_at(t) + radius - std::sqrt(below);
    }
    double of_flat(double u, double v) const {
        const double half = std::sqrt(std::max(0.0, radius * radius - v * v));
        const double first = std::max(0.0, u - half);
        const double last = std::min(length, u + half);
        return first > last ? not_cut : tip_at(slope > 0 ? first : last);
    }
    double of_others(const Cutter& cutter, double u, double v) const {
        const double t = std::clamp(u, 0.0, length);
        const double r = std::sqrt(v * v + (u - t) * (u - t));
        return r > radius ? not_cut : tip_at(t) + profile_height(cutter, r);
    }
    // The x of the points of a row that the tool comes over: between the ends and along the two sides of its swath.
    void reach_of_row(double y, double& low, double& high) const {
        low = 1e9;
        high = -1e9;
        const auto take = [&](double x) { low = std::min(low, x), high = std::max(high, x); };
        for (const Vec3& end : {from, to}) {
            const double half = radius * radius - (y - end.y) * (y - end.y);
            if (half >= 0) take(end.x - std::sqrt(half)), take(end.x + std::sqrt(half));
        }
        if (unit_y == 0) return;
        for (const double side : {-radius, radius}) {
            const double t = (y - from.y - side * unit_x) / unit_y;
            if (t >= 0 && t <= length) take(from.x - side * unit_y + t * unit_x);
        }
    }
};

struct Count {
    std::size_t cells = 0;
    std::size_t lowered = 0;
};

template <bool counts, class HeightOf>
void lower(HeightField& field, const Move& move, const HeightOf& height_of, Count& count) {
    const std::int32_t begin = field.first(std::min(move.from.y, move.to.y) - move.radius, field.y_min);
    const std::int32_t end = field.end(std::max(move.from.y, move.to.y) + move.radius, field.y_min, field.length);
    for (std::int32_t j = begin; j < end; ++j) {
        const double y = field.y_min + (j + 0.5) * field.cell;
        double low = 0;
        double high = 0;
        move.reach_of_row(y, low, high);
        const std::int32_t last = field.end(high, field.x_min, field.width);
        const double beside = y - move.from.y;
        float* const row = field.height.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(field.width);
        for (std::int32_t i = field.first(low, field.x_min); i < last; ++i) {
            const double along = field.x_min + (i + 0.5) * field.cell - move.from.x;
            const auto height = static_cast<float>(
                height_of(along * move.unit_x + beside * move.unit_y, beside * move.unit_x - along * move.unit_y));
            if constexpr (counts) ++count.cells, count.lowered += height < row[i] ? 1 : 0;
            if (height < row[i]) row[i] = height;
        }
    }
}

template <bool counts>
Count lower_all(std::vector<HeightField>& fields, const std::vector<TipLine>& lines,
                const std::vector<CuttingTool>& tools) {
    std::vector<Cutter> cutters;
    cutters.reserve(tools.size());
    for (const CuttingTool& tool : tools) cutters.push_back(cutter_of(tool));
    Count count;
    for (const TipLine& line : lines) {
        HeightField& field = fields[line.orientation];
        const Cutter& cutter = cutters[line.tool];
        const Move move(apply_inverse(field.frame, line.from), apply_inverse(field.frame, line.to), cutter.radius);
        if (cutter.shape == ToolShape::ball) {
            lower<counts>(
                field, move, [&](double u, double v) { return move.of_ball(u, v); }, count);
        } else if (cutter.shape == ToolShape::flat) {
            lower<counts>(
                field, move, [&](double u, double v) { return move.of_flat(u, v); }, count);
        } else {
            lower<counts>(
                field, move, [&](double u, double v) { return move.of_others(cutter, u, v); }, count);
        }
    }
    return count;
}

}  // namespace

PlainLoop plain_loop(const std::vector<TipLine>& lines, const Box& block, const std::vector<Vec3>& tool_axes,
                     const std::vector<CuttingTool>& tools, double cell, int runs) {
    std::vector<HeightField> uncut;
    uncut.reserve(tool_axes.size());
    for (const Vec3& tool_axis : tool_axes) uncut.push_back(field_of(block, tool_axis, cell));
    PlainLoop loop;
    loop.cpu_s = std::numeric_limits<double>::infinity();
    for (int run = 0; run < runs; ++run) {
        std::vector<HeightField> fields = uncut;
        const double started = cpu_s();
        lower_all<false>(fields, lines, tools);
        loop.cpu_s = std::min(loop.cpu_s, cpu_s() - started);
    }
    std::vector<HeightField> fields = uncut;
    const Count count = lower_all<true>(fields, lines, tools);
    loop.cells = count.cells;
    loop.lowered = count.lowered;
    for (const HeightField& field : fields) {
        for (const float height : field.height) loop.cut += height < not_cut ? 1 : 0;
    }
    loop.moves = lines.size();
    for (const TipLine& line : lines) loop.length += norm(line.to - line.from);
    return loop;
}

}  // namespace qchopper::bench
