// Plots every objective value of every candidate over its offset: one column per normal, one row per value.
// O(candidates) beside sorting them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/report/columns.h"
#include "app/report/explanation.h"
#include "app/report/objective_terms.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t best_count = 12;  // planes whose totals set the range of the second row
constexpr std::size_t total_colour = 5;

// The candidates of one normal, by offset.
struct Line {
    std::string title;
    Vec3 normal;
    std::vector<Ranked> planes;
};

constexpr std::size_t max_lines = 3;

// The normals of the best planes, so many as there is room for.
std::set<int> shown_normals(const Explanation& e) {
    std::set<int> normals;
    if (e.place && e.chosen.normal_index >= 0) normals.insert(e.chosen.normal_index);
    for (const Ranked& r : e.ranked) {
        if (r.normal_index >= 0 && normals.size() < max_lines) normals.insert(r.normal_index);
    }
    return normals;
}

std::vector<Line> lines_of(const Explanation& e) {
    std::vector<Ranked> planes = e.ranked;
    const std::set<int> shown = shown_normals(e);
    std::erase_if(planes, [&](const Ranked& r) { return !shown.contains(r.normal_index); });
    std::sort(planes.begin(), planes.end(), [](const Ranked& a, const Ranked& b) {
        return std::pair(a.normal_index, a.offset_index) < std::pair(b.normal_index, b.offset_index);
    });
    std::vector<Line> lines;
    for (const Ranked& r : planes) {
        if (lines.empty() || lines.back().planes.back().normal_index != r.normal_index) {
            const std::string name = "Normal " + std::to_string(r.normal_index + 1) + "  ";
            lines.push_back({name + in_brackets(r.plane.normal, 3), r.plane.normal, {}});
        }
        lines.back().planes.push_back(r);
    }
    const bool has_line =
        std::any_of(lines.begin(), lines.end(), [&](const Line& l) { return l.normal == e.chosen.plane.normal; });
    if (!has_line) {
        const Vec3 n = e.chosen.plane.normal;
        const std::string name = e.chosen.normal_index == refined_index ? "Refined normal  "
                                 : e.chosen.normal_index == own_index   ? "Own normal  "
                                                                        : "Its normal  ";
        lines.push_back({name + in_brackets(n, 3), n, e.along_own_normal});
    }
    return lines;
}

// A gap stands for offsets between that are no candidates.
std::vector<PlotPoint> curve(const Line& line, double Terms::*value, double factor) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < line.planes.size(); ++i) {
        const Ranked& r = line.planes[i];
        if (i > 0 && r.offset_index > line.planes[i - 1].offset_index + 1) {
            points.push_back({(points.back().x + r.plane.offset) / 2, gap});
        }
        points.push_back({r.plane.offset, factor * r.terms.*value});
    }
    return points;
}

// The range of a value over the `best` first planes and the chosen one, at least `least` wide, with a margin.
PlotRange range_of(const Explanation& e, std::size_t best, double Terms::*value, double factor, double least) {
    PlotRange range{factor * e.chosen.terms.*value, factor * e.chosen.terms.*value};
    for (std::size_t i = 0; i < std::min(best, e.ranked.size()); ++i) {
        range.low = std::min(range.low, factor * e.ranked[i].terms.*value);
        range.high = std::max(range.high, factor * e.ranked[i].terms.*value);
    }
    range.high = std::max(range.high, range.low + least);
    const double margin = 0.08 * (range.high - range.low);
    return {range.low - margin, range.high + margin};
}

PlotRow row_of(const std::vector<Line>& lines, const std::string& title, std::size_t colour, double Terms::*value,
               double factor) {
    PlotRow row;
    row.title = title;
    row.colour = piece_colour(colour);
    for (const Line& line : lines) row.curves.push_back(curve(line, value, factor));
    return row;
}

// Most planes cost many times the best: all of them on a logarithmic axis, then the best on a linear one.
void add_totals(Plot& plot, const Explanation& e, const std::vector<Line>& lines) {
    PlotRow all = row_of(lines, "Total of all, logarithmic", total_colour, &Terms::total, 1);
    all.is_logarithmic = true;
    all.line = 2;
    plot.rows.push_back(all);
    PlotRow best = row_of(lines, "Total of the best", total_colour, &Terms::total, 1);
    best.range = range_of(e, best_count, &Terms::total, 1, 1e-3);
    best.line = 2;
    plot.rows.push_back(best);
}

}  // namespace

Plot plot(const Explanation& e, const std::string& project) {
    const std::vector<Line> lines = lines_of(e);
    Plot plot;
    plot.title = project + ": cut " + std::to_string(e.cut.number) + " on piece " + e.cut.piece;
    plot.notes = {
        describe(e),
        "Below the totals: what each objective adds (value times weight). Lower is better. Arrows: beyond the frame."};
    for (const Line& line : lines) {
        PlotColumn column{line.title, "offset along the normal, mm", {}};
        const auto mark = [&](const std::string& name, const Ranked& r, bool is_best) {
            if (line.normal != r.plane.normal) return;
            const std::string text = name + fixed(r.plane.offset, 2) + " mm, total " + fixed(r.terms.total, 3);
            column.marks.push_back({r.plane.offset, text, is_best});
        };
        mark("chosen: ", e.chosen, false);
        if (e.cheaper() > 0) mark("best: ", *e.best_other(), true);
        plot.columns.push_back(std::move(column));
    }
    add_totals(plot, e, lines);
    for (const ObjectiveTerm& term : objective_terms(e.objectives.weights)) {
        const double weight = e.objectives.weights.*term.weight;
        const double factor = weight != 0 ? weight : 1;
        const std::string title =
            term.title + std::string(weight != 0 ? " \u00d7 " : ", weight ") + describe_weight(weight);
        PlotRow row = row_of(lines, title, term.colour, term.value, factor);
        const std::size_t best = term.is_bounded ? e.ranked.size() : e.ranked.size() / 3;
        row.range = range_of(e, best, term.value, factor, std::abs(factor) * term.step);
        plot.rows.push_back(std::move(row));
    }
    return plot;
}

}  // namespace qchopper
