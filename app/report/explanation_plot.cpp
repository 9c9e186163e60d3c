#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/report/explanation.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

struct TermRow {
    const char* name;
    double Terms::*value;
    double Weights::*weight;
    std::size_t colour;  // of the pieces' palette: those that are dark enough on white
    bool is_bounded;     // else it is drawn for the better third, because the worst are thousands of times worse
    double step;         // the least that its axis spans
};
constexpr std::array<TermRow, 4> term_rows{{{"Face ratio", &Terms::face_ratio, &Weights::face_ratio, 0, false, 0.01},
                                            {"Fragility", &Terms::fragility, &Weights::fragility, 6, true, 0.01},
                                            {"Piece count", &Terms::piece_count, &Weights::piece_count, 9, false, 1},
                                            {"Undercut", &Terms::undercut, &Weights::undercut, 3, true, 0.01}}};
constexpr std::size_t contest = 12;  // planes that make up the contest for the first place
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
        lines.push_back({"Own normal  " + of_normal(n), n, e.beside});
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

// The range of a value over the best of the planes and the chosen one, at least so wide.
PlotRange range_of(const Explanation& e, std::size_t best, double Terms::*value, double factor, double least) {
    PlotRange range{factor * e.chosen.terms.*value, factor * e.chosen.terms.*value};
    for (std::size_t i = 0; i < std::min(best, e.ranked.size()); ++i) {
        range.low = std::min(range.low, factor * e.ranked[i].terms.*value);
        range.high = std::max(range.high, factor * e.ranked[i].terms.*value);
    }
    range.high = std::max(range.high, range.low + least);
    const double room = 0.08 * (range.high - range.low);
    return {range.low - room, range.high + room};
}

PlotRow row_of(const std::vector<Line>& lines, const std::string& title, std::size_t colour, double Terms::*value,
               double factor) {
    PlotRow row;
    row.title = title;
    row.colour = piece_colour(colour);
    for (const Line& line : lines) row.curves.push_back(curve(line, value, factor));
    return row;
}

// Most planes cost many times the best: all of them on a logarithmic axis, then the contest for the first place.
void add_totals(Plot& plot, const Explanation& e, const std::vector<Line>& lines) {
    PlotRow all = row_of(lines, "Total of all, logarithmic", total_colour, &Terms::total, 1);
    all.is_logarithmic = true;
    all.line = 2;
    plot.rows.push_back(all);
    PlotRow best = row_of(lines, "Total of the best", total_colour, &Terms::total, 1);
    best.range = range_of(e, contest, &Terms::total, 1, 1e-3);
    best.line = 2;
    plot.rows.push_back(best);
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
    plot.notes = {
        verdict(e),
        "Below the totals: what each objective adds (value times weight). Lower is better. Arrows: beyond the frame."};
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
    add_totals(plot, e, lines);
    for (const TermRow& term : term_rows) {
        const double weight = e.objectives.weights.*term.weight;
        const double factor = weight != 0 ? weight : 1;
        const std::string title =
            std::string(term.name) + (weight != 0 ? " \u00d7 " : ", weight ") + weight_words(weight);
        PlotRow row = row_of(lines, title, term.colour, term.value, factor);
        const std::size_t best = term.is_bounded ? e.ranked.size() : e.ranked.size() / 3;
        row.range = range_of(e, best, term.value, factor, std::abs(factor) * term.step);
        plot.rows.push_back(std::move(row));
    }
    return plot;
}

}  // namespace qchopper
