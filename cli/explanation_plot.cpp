#include <algorithm>
#include <cmath>
#include <limits>

#include "cam/job/text.h"
#include "cli/explanation.h"

namespace qchopper {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

struct TermRow {
    const char* name;
    double Terms::*value;
    double Weights::*weight;
    std::size_t colour;  // of the pieces' palette: those that are dark enough on white
};
constexpr std::array<TermRow, 4> term_rows{{{"Face ratio", &Terms::face_ratio, &Weights::face_ratio, 0},
                                            {"Fragility", &Terms::fragility, &Weights::fragility, 6},
                                            {"Piece count", &Terms::piece_count, &Weights::piece_count, 9},
                                            {"Undercut", &Terms::undercut, &Weights::undercut, 3}}};
constexpr std::size_t total_colour = 5;

// The candidates of one normal, by offset.
struct Line {
    std::string title;
    Vec3 normal;
    std::vector<Ranked> planes;
};

std::string of_normal(Vec3 n) {
    return "(" + fixed(n.x, 3) + ", " + fixed(n.y, 3) + ", " + fixed(n.z, 3) + ")";
}

std::vector<Line> lines_of(const Explanation& e) {
    std::vector<Ranked> planes = e.ranked;
    std::sort(planes.begin(), planes.end(), [](const Ranked& a, const Ranked& b) {
        return std::pair(a.normal, a.offset) < std::pair(b.normal, b.offset);
    });
    std::vector<Line> lines;
    for (const Ranked& r : planes) {
        if (lines.empty() || lines.back().planes.back().normal != r.normal) {
            lines.push_back(
                {"Normal " + std::to_string(r.normal + 1) + "  " + of_normal(r.plane.normal), r.plane.normal, {}});
        }
        lines.back().planes.push_back(r);
    }
    const bool has_line =
        std::any_of(lines.begin(), lines.end(), [&](const Line& l) { return l.normal == e.chosen.plane.normal; });
    if (!has_line) {
        const Vec3 n = e.chosen.plane.normal;
        lines.push_back({"The operator's normal  " + of_normal(n), n, e.beside});
    }
    return lines;
}

// Offsets that are no candidates leave gaps.
std::vector<PlotPoint> curve(const Line& line, double Terms::*value, double factor) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < line.planes.size(); ++i) {
        const Ranked& r = line.planes[i];
        if (i > 0 && r.offset > line.planes[i - 1].offset + 1) {
            points.push_back({(points.back().x + r.plane.offset) / 2, gap});
        }
        points.push_back({r.plane.offset, factor * r.terms.*value});
    }
    return points;
}

// Planes near the ends cost many times what the others do; the range serves those that compete.
PlotRange range_of(const PlotRow& row, double chosen, bool from_zero) {
    std::vector<double> values{chosen};
    for (const auto& points : row.curves) {
        for (const PlotPoint& p : points) {
            if (std::isfinite(p.y)) values.push_back(p.y);
        }
    }
    std::sort(values.begin(), values.end());
    const double most = values.back();
    const double low = from_zero ? std::min(values.front(), 0.0) : values.front();
    const double usual = std::max(values[values.size() * 3 / 4], chosen);
    double high = most - low <= 2.5 * (usual - low) || usual <= low ? most : low + 1.25 * (usual - low);
    if (high <= low) high = low + 1;
    const double room = 0.08 * (high - low);
    return {from_zero ? low - room / 2 : low - room, high + room};
}

PlotRow row_of(const std::vector<Line>& lines, double Terms::*value, double factor, double chosen, bool from_zero) {
    PlotRow row;
    for (const Line& line : lines) row.curves.push_back(curve(line, value, factor));
    row.range = range_of(row, factor * chosen, from_zero);
    return row;
}

std::string weight_words(double weight) {
    std::string text = fixed(weight, 3);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace

Plot plot(const Explanation& e, const std::string& project) {
    const std::vector<Line> lines = lines_of(e);
    Plot plot;
    plot.title = project + ": cut " + std::to_string(e.cut.number) + " on piece " + e.cut.piece;
    plot.notes = {verdict(e),
                  "Rows: the total, then what each objective adds to it (value times weight); lower is better. Arrows: "
                  "beyond the frame."};
    for (const Line& line : lines) {
        PlotColumn column{line.title, "offset along the normal, mm", {}};
        if (line.normal == e.chosen.plane.normal) {
            column.marks.push_back(
                {e.chosen.plane.offset,
                 "chosen: " + fixed(e.chosen.plane.offset, 2) + " mm, total " + fixed(e.chosen.terms.total, 3), false});
        }
        if (!e.is_best() && !e.ranked.empty() && line.normal == e.ranked.front().plane.normal) {
            const Ranked& best = e.ranked.front();
            column.marks.push_back({best.plane.offset,
                                    "best: " + fixed(best.plane.offset, 2) + " mm, total " + fixed(best.terms.total, 3),
                                    true});
        }
        plot.columns.push_back(std::move(column));
    }
    PlotRow total = row_of(lines, &Terms::total, 1, e.chosen.terms.total, false);
    total.title = "Total";
    total.colour = piece_colour(total_colour);
    total.line = 2;
    plot.rows.push_back(std::move(total));
    for (const TermRow& term : term_rows) {
        const double weight = e.objectives.weights.*term.weight;
        PlotRow row = row_of(lines, term.value, weight != 0 ? weight : 1, e.chosen.terms.*term.value, true);
        row.title = std::string(term.name) + (weight != 0 ? " \u00d7 " : ", weight ") + weight_words(weight);
        row.colour = piece_colour(term.colour);
        plot.rows.push_back(std::move(row));
    }
    return plot;
}

}  // namespace qchopper
