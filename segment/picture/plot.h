// Draws a grid of line plots as SVG text: curves share the x axis of their column and the y axis of their row.
//
// For print: light background, fonts of the viewer, nothing loaded from elsewhere. The text is valid XML for any labels
// and numbers, and the same plot gives the same bytes (tests/segment/picture/plot_test.cpp).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "segment/picture/axis.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct PlotPoint {
    double x = 0;
    double y = 0;  // not finite: a gap in the curve
    bool operator==(const PlotPoint&) const = default;
};

// A vertical line through all rows of a column, and a dot where it meets the curves.
struct PlotMark {
    double x = 0;
    std::string label;
    bool is_dashed = false;
};

struct PlotColumn {
    std::string title;
    std::string x_label;
    std::vector<PlotMark> marks;
};

// Curves of one colour. A value outside the range is drawn as a small arrow at the edge of the frame.
struct PlotRow {
    std::string title;
    Rgb colour;
    double line = 1.4;                           // width of the curve
    bool is_logarithmic = false;                 // then values that are not positive are gaps
    std::optional<PlotRange> range;              // of y; nothing: of all that is drawn
    std::vector<std::vector<PlotPoint>> curves;  // one per column or fewer, x ascending
};

struct Plot {
    std::string title;
    std::vector<std::string> notes;  // lines under the title
    std::vector<PlotColumn> columns;
    std::vector<PlotRow> rows;
};

// In units of the picture (CSS pixels).
struct PlotOptions {
    double panel_width = 290;
    double panel_height = 104;
};

std::string to_svg(const Plot& plot, const PlotOptions& options = {});

}  // namespace qchopper
