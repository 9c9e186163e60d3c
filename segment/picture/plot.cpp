// Panels stand in a grid; each curve is one path, clipped to its panel. O(points + marks * points).

#include "segment/picture/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

// Distances around the panels, in the unit of the picture.
constexpr double left = 64;
constexpr double right = 18;
constexpr double between_columns = 22;
constexpr double row_title = 22;   // above every row
constexpr double x_axis = 42;      // below the last row
constexpr double title_line = 26;  // then the notes
constexpr double note_line = 15;
constexpr double column_title = 24;
constexpr double mark_line = 14;  // labels of marks stand one below the other
constexpr double top = 12;

constexpr double letter_width = 6.2;  // about
constexpr double space_per_dot = 4;   // curves with less space between points are drawn without dots

// A coordinate of the picture as text. NaN becomes 0 and large values are limited, so that the text is short.
std::string at(double value) {
    return fixed(std::isnan(value) ? 0 : std::clamp(value, -1e6, 1e6), 2);
}

// A light border around letters, so that they can be read where a mark crosses them.
constexpr const char* halo = "paint-order=\"stroke\" stroke=\"#fdfdfb\" stroke-width=\"4\"";
constexpr const char* dark = "#222222";
constexpr const char* grid_colour = "#dcdcd6";

// Larger numbers can overflow where they are subtracted and divided; they are drawn as gaps.
bool is_drawable(double value) {
    return std::isfinite(value) && std::abs(value) < 1e200;
}

class Spread {
 public:
    void add(double value) {
        if (!is_drawable(value)) return;
        range_.low = std::min(range_.low, value);
        range_.high = std::max(range_.high, value);
    }
    PlotRange widened(double share) const {
        const double more = share * (range_.high - range_.low);
        return drawable_range({range_.low - more, range_.high + more});
    }

 private:
    PlotRange range_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

// The y of a curve at x, interpolated; nothing outside the curve or in a gap.
std::optional<double> value_at(const std::vector<PlotPoint>& curve, double x) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (curve[i].x == x && std::isfinite(curve[i].y)) return curve[i].y;
        if (i == 0 || !(curve[i - 1].x < x && x < curve[i].x)) continue;
        const double t = (x - curve[i - 1].x) / (curve[i].x - curve[i - 1].x);
        const double y = curve[i - 1].y + t * (curve[i].y - curve[i - 1].y);
        if (std::isfinite(y)) return y;
    }
    return std::nullopt;
}

// The frame of one panel in the picture, and the ranges of its axes.
struct Panel {
    double x0, y0, width, height;
    PlotRange x, y;
    bool is_logarithmic;
    double to_x(double value) const { return x0 + width * (value - x.low) / (x.high - x.low); }
    double to_y(double value) const {
        if (is_logarithmic) return y0 + height * std::log(y.high / value) / std::log(y.high / y.low);
        return y0 + height * (y.high - value) / (y.high - y.low);
    }
    bool is_drawn(double value) const { return is_drawable(value) && (value > (is_logarithmic ? 1e-200 : -1e200)); }
    bool is_above(double value) const { return value > y.high; }
    bool is_below(double value) const { return value < y.low; }
};

class Drawing {
 public:
    Drawing(const Plot& plot, const PlotOptions& options) : plot_(plot), options_(options) {
        for (std::size_t c = 0; c < plot.columns.size(); ++c) {
            Spread spread;
            for (const PlotRow& row : plot.rows) {
                if (c >= row.curves.size()) continue;
                for (const PlotPoint& p : row.curves[c]) spread.add(p.x);
            }
            for (const PlotMark& mark : plot.columns[c].marks) spread.add(mark.x);
            x_.push_back(spread.widened(0.02));
        }
        for (const PlotRow& row : plot.rows) {
            y_.push_back(range_of(row));
        }
    }

    std::string run() {
        const auto columns = static_cast<double>(plot_.columns.size());
        const auto rows = static_cast<double>(plot_.rows.size());
        const double width =
            left + right + columns * options_.panel_width + std::max(columns - 1, 0.0) * between_columns;
        const double height = panels_top() + rows * (row_title + options_.panel_height) + x_axis;
        svg_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
               at(width) + "\" height=\"" + at(height) + "\" viewBox=\"0 0 " + at(width) + " " + at(height) +
               "\" font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\" font-size=\"11\" "
               "fill=\"" +
               dark + "\">\n<title>" + svg_text(plot_.title) + "</title>\n<rect width=\"100%\" height=\"100%\" " +
               "fill=\"#fdfdfb\"/>\n";
        heading();
        for (std::size_t r = 0; r < plot_.rows.size(); ++r) {
            for (std::size_t c = 0; c < plot_.columns.size(); ++c) draw(r, c);
        }
        for (std::size_t c = 0; c < plot_.columns.size(); ++c) column_labels(c);
        return svg_ + "</svg>\n";
    }

 private:
    static PlotRange range_of(const PlotRow& row) {
        Spread spread;
        for (const auto& curve : row.curves) {
            for (const PlotPoint& p : curve) {
                if (!row.is_logarithmic) spread.add(p.y);
                if (row.is_logarithmic && p.y > 1e-200 && is_drawable(p.y)) spread.add(std::log10(p.y));
            }
        }
        if (!row.is_logarithmic) return row.range ? drawable_range(*row.range) : spread.widened(0.06);
        if (row.range && row.range->low > 0) return drawable_range(*row.range);
        const PlotRange powers = spread.widened(0.06);
        return {std::pow(10.0, powers.low), std::pow(10.0, powers.high)};
    }

    double column_top() const { return top + title_line + note_line * static_cast<double>(plot_.notes.size()); }
    double panels_top() const {
        std::size_t marks = 0;
        for (const PlotColumn& column : plot_.columns) marks = std::max(marks, column.marks.size());
        return column_top() + column_title + mark_line * static_cast<double>(marks);
    }

    Panel panel(std::size_t r, std::size_t c) const {
        return {left + static_cast<double>(c) * (options_.panel_width + between_columns),
                panels_top() + static_cast<double>(r) * (row_title + options_.panel_height) + row_title,
                options_.panel_width,
                options_.panel_height,
                x_[c],
                y_[r],
                plot_.rows[r].is_logarithmic};
    }

    void text(double x, double y, const std::string& words, const std::string& style = "") {
        svg_ += "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\"" + (style.empty() ? "" : " " + style) + ">" +
                svg_text(words) + "</text>\n";
    }

    // The start of a tag for the panel's frame.
    static std::string rectangle(const Panel& p) {
        return "<rect x=\"" + at(p.x0) + "\" y=\"" + at(p.y0) + "\" width=\"" + at(p.width) + "\" height=\"" +
               at(p.height) + "\"";
    }

    void line(double x0, double y0, double x1, double y1, const std::string& style) {
        svg_ += "<path d=\"M" + at(x0) + " " + at(y0) + "L" + at(x1) + " " + at(y1) + "\" " + style + "/>\n";
    }

    void heading() {
        text(left, top + 14, plot_.title, "font-size=\"16\" font-weight=\"bold\"");
        for (std::size_t i = 0; i < plot_.notes.size(); ++i) {
            text(left, top + title_line + note_line * (static_cast<double>(i) + 0.5), plot_.notes[i],
                 "fill=\"#555555\"");
        }
    }

    void draw(std::size_t r, std::size_t c) {
        const Panel p = panel(r, c);
        const PlotRow& row = plot_.rows[r];
        svg_ += rectangle(p) + " fill=\"#ffffff\"/>\n";
        y_axis(p, c == 0);
        x_ticks(p, r + 1 == plot_.rows.size());
        for (std::size_t m = 0; m < plot_.columns[c].marks.size(); ++m) {
            const double from = r == 0 ? mark_y(m) + 3 : p.y0 - row_title;
            draw_mark(p, plot_.columns[c].marks[m], from);
        }
        if (c < row.curves.size()) {
            curve(p, row, row.curves[c], "clip" + std::to_string(r) + "-" + std::to_string(c));
            for (const PlotMark& mark : plot_.columns[c].marks) {
                const std::optional<double> y = value_at(row.curves[c], mark.x);
                if (!y || !p.is_drawn(*y) || p.is_above(*y) || p.is_below(*y)) continue;
                svg_ += "<circle cx=\"" + at(p.to_x(mark.x)) + "\" cy=\"" + at(p.to_y(*y)) + "\" r=\"3.6\" fill=\"" +
                        (mark.is_dashed ? "#ffffff" : svg_colour(row.colour)) + "\" stroke=\"" + dark +
                        "\" stroke-width=\"1.2\"/>\n";
            }
        }
        svg_ += rectangle(p) + " fill=\"none\" stroke=\"#888888\" stroke-width=\"0.8\"/>\n";
        if (c == 0) row_label(p, row);
    }

    void row_label(const Panel& p, const PlotRow& row) {
        svg_ += "<rect x=\"" + at(p.x0) + "\" y=\"" + at(p.y0 - 11) + "\" width=\"9\" height=\"5\" fill=\"" +
                svg_colour(row.colour) + "\"/>\n";
        text(p.x0 + 14, p.y0 - 5, row.title, std::string("font-weight=\"bold\" ") + halo);
    }

    void y_axis(const Panel& p, bool has_numbers) {
        const Ticks t = p.is_logarithmic ? decades(p.y) : ticks(p.y, 4);
        for (const double value : t.values) {
            const double y = p.to_y(value);
            line(p.x0, y, p.x0 + p.width, y, std::string("stroke=\"") + grid_colour + "\" stroke-width=\"0.7\"");
            if (has_numbers) text(p.x0 - 6, y + 3.8, t.text(value), "text-anchor=\"end\"");
        }
    }

    void x_ticks(const Panel& p, bool has_numbers) {
        const Ticks t = ticks(p.x, 5);
        for (const double value : t.values) {
            const double x = p.to_x(value);
            line(x, p.y0, x, p.y0 + p.height, std::string("stroke=\"") + grid_colour + "\" stroke-width=\"0.7\"");
            if (has_numbers) text(x, p.y0 + p.height + 14, t.text(value), "text-anchor=\"middle\"");
        }
    }

    // The base line of the label of mark m of a column.
    double mark_y(std::size_t m) const { return column_top() + column_title + mark_line * static_cast<double>(m) + 9; }

    void draw_mark(const Panel& p, const PlotMark& mark, double from) {
        line(p.to_x(mark.x), from, p.to_x(mark.x), p.y0 + p.height,
             std::string("stroke=\"") + dark + "\" stroke-width=\"1\"" +
                 (mark.is_dashed ? " stroke-dasharray=\"4 3\"" : ""));
    }

    void curve(const Panel& p, const PlotRow& row, const std::vector<PlotPoint>& points, const std::string& clip) {
        const std::string colour = svg_colour(row.colour);
        svg_ +=
            "<clipPath id=\"" + clip + "\">" + rectangle(p) + "/></clipPath>\n<g clip-path=\"url(#" + clip + ")\">\n";
        std::string path;
        bool is_in_stroke = false;
        for (const PlotPoint& point : points) {
            if (p.is_drawn(point.y)) {
                path += (is_in_stroke ? "L" : "M") + at(p.to_x(point.x)) + " " + at(limited_y(p, point.y));
            }
            is_in_stroke = p.is_drawn(point.y);
        }
        if (!path.empty()) {
            svg_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + at(row.line) +
                    "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n";
        }
        dots(p, points, colour, row.line + 0.7);
        svg_ += "</g>\n";
    }

    // Far outside the frame the exact value does not matter; the numbers in the file stay short.
    static double limited_y(const Panel& p, double value) {
        return std::clamp(p.to_y(value), p.y0 - 50 * p.height, p.y0 + 51 * p.height);
    }

    void dots(const Panel& p, const std::vector<PlotPoint>& points, const std::string& colour, double radius) {
        if (p.width < space_per_dot * static_cast<double>(points.size())) return;
        for (const PlotPoint& point : points) {
            if (!p.is_drawn(point.y)) continue;
            const double x = p.to_x(point.x);
            if (p.is_above(point.y) || p.is_below(point.y)) {
                const double y = p.is_above(point.y) ? p.y0 + 1 : p.y0 + p.height - 1;
                const double tall = p.is_above(point.y) ? 5 : -5;
                svg_ += "<path d=\"M" + at(x) + " " + at(y) + "L" + at(x - 2.6) + " " + at(y + tall) + "L" +
                        at(x + 2.6) + " " + at(y + tall) + "Z\" fill=\"" + colour + "\"/>\n";
            } else {
                svg_ += "<circle cx=\"" + at(x) + "\" cy=\"" + at(p.to_y(point.y)) + "\" r=\"" + at(radius) +
                        "\" fill=\"" + colour + "\"/>\n";
            }
        }
    }

    // Above the column its title and the labels of its marks; below it the label of the x axis.
    void column_labels(std::size_t c) {
        if (plot_.rows.empty()) return;
        const Panel first = panel(0, c);
        const Panel last = panel(plot_.rows.size() - 1, c);
        text(first.x0, column_top() + 14, plot_.columns[c].title, "font-size=\"12\" font-weight=\"bold\"");
        text(first.x0 + first.width / 2, last.y0 + last.height + 31, plot_.columns[c].x_label,
             "text-anchor=\"middle\"");
        for (std::size_t m = 0; m < plot_.columns[c].marks.size(); ++m) {
            const PlotMark& mark = plot_.columns[c].marks[m];
            const double wide = letter_width * static_cast<double>(mark.label.size());
            const double last_x = std::max(first.x0 + first.width - wide / 2, first.x0 + wide / 2);
            text(std::clamp(first.to_x(mark.x), first.x0 + wide / 2, last_x), mark_y(m), mark.label,
                 std::string("text-anchor=\"middle\" font-style=\"italic\" ") + halo);
        }
    }

    const Plot& plot_;
    const PlotOptions& options_;
    std::vector<PlotRange> x_;  // per column
    std::vector<PlotRange> y_;  // per row
    std::string svg_;
};

}  // namespace

std::string to_svg(const Plot& plot, const PlotOptions& options) {
    return Drawing(plot, options).run();
}

}  // namespace qchopper
