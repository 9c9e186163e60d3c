// Every page draws the whole template, moved, and clips it to its window. O(tiles * corners).

#include "cam/job/sheet/template_pdf.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "segment/picture/pdf.h"

namespace qchopper {
namespace {

constexpr double margin = 10;  // of a page, which printers leave white
constexpr double strip = 20;   // below the window, for bar and names

std::size_t tiles_along(double length, double window) {
    if (length <= window) return 1;
    return 1 + static_cast<std::size_t>(std::ceil((length - window) / (window - tile_overlap) - 1e-9));
}

TemplateTiles tiles_on(Point2 paper, Point2 sheet) {
    TemplateTiles tiles;
    tiles.paper = paper;
    tiles.window = {paper.x - 2 * margin, paper.y - 2 * margin - strip};
    tiles.columns = tiles_along(sheet.x, tiles.window.x);
    tiles.rows = tiles_along(sheet.y, tiles.window.y);
    for (std::size_t row = 0; row < tiles.rows; ++row) {
        for (std::size_t column = 0; column < tiles.columns; ++column) {
            const double below = static_cast<double>(tiles.rows - 1 - row);
            tiles.corners.push_back({static_cast<double>(column) * (tiles.window.x - tile_overlap),
                                     below * (tiles.window.y - tile_overlap)});
        }
    }
    return tiles;
}

// A cross in a circle, at the same place of the drawing on all tiles that show it.
void add_mark(CapTemplate& drawing, Point2 at) {
    constexpr double reach = 5;
    drawing.circles.push_back({at, 2});
    drawing.lines.push_back({{at.x - reach, at.y}, {at.x + reach, at.y}});
    drawing.lines.push_back({{at.x, at.y - reach}, {at.x, at.y + reach}});
}

// In the middle of each overlap a line with two marks a tile.
void add_seams(CapTemplate& drawing, const TemplateTiles& tiles) {
    const Point2 step{tiles.window.x - tile_overlap, tiles.window.y - tile_overlap};
    const double right = static_cast<double>(tiles.columns) * step.x + tile_overlap;
    const double top = static_cast<double>(tiles.rows) * step.y + tile_overlap;
    for (std::size_t c = 1; c < tiles.columns; ++c) {
        const double x = static_cast<double>(c) * step.x + tile_overlap / 2;
        drawing.lines.push_back({{x, 0}, {x, top}});
        for (std::size_t i = 0; i < 2 * tiles.rows; ++i)
            add_mark(drawing, {x, (static_cast<double>(i) + 0.6) * step.y / 2});
    }
    for (std::size_t r = 1; r < tiles.rows; ++r) {
        const double y = static_cast<double>(r) * step.y + tile_overlap / 2;
        drawing.lines.push_back({{0, y}, {right, y}});
        for (std::size_t i = 0; i < 2 * tiles.columns; ++i)
            add_mark(drawing, {(static_cast<double>(i) + 0.6) * step.x / 2, y});
    }
}

// What stands below the window: bar, title, which tile it is, and a small map of all tiles with a cross in this one.
CapTemplate strip_of(const CapTemplate& drawing, const TemplateTiles& tiles, std::size_t tile) {
    CapTemplate below;
    add_scale_bar(below, {margin, margin + 11});
    const std::size_t count = tiles.corners.size();
    const std::size_t row = tile / tiles.columns;
    const std::size_t column = tile % tiles.columns;
    if (count > 1) {
        below.texts.push_back({{margin, margin + 3},
                               3,
                               false,
                               "Tile " + std::to_string(tile + 1) + " of " + std::to_string(count) + ": row " +
                                   std::to_string(row + 1) + " of " + std::to_string(tiles.rows) +
                                   " from above, column " + std::to_string(column + 1) + " of " +
                                   std::to_string(tiles.columns) +
                                   " from the left. Cut along the lines between tiles and lay mark on mark."});
    }
    below.texts.push_back({{margin, margin - 1}, 3, false, drawing.title});
    if (count == 1) return below;
    const double size = std::min({6.0, 14 / static_cast<double>(tiles.rows), 60 / static_cast<double>(tiles.columns)});
    const Point2 corner{tiles.paper.x - margin - size * static_cast<double>(tiles.columns), margin + 6};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from_top = i / tiles.columns;
        const double x = corner.x + size * static_cast<double>(i % tiles.columns);
        const double y = corner.y + size * static_cast<double>(tiles.rows - 1 - from_top);
        below.outlines.push_back({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}});
        if (i != tile) continue;
        below.lines.push_back({{x, y}, {x + size, y + size}});
        below.lines.push_back({{x, y + size}, {x + size, y}});
    }
    return below;
}

void draw(Pdf& pdf, const CapTemplate& drawing) {
    pdf.set_line_width(0.3);
    for (const std::vector<Point2>& outline : drawing.outlines) pdf.draw_line(outline, true);
    pdf.set_line_width(0.15);
    for (const std::vector<Point2>& line : drawing.lines) pdf.draw_line(line);
    for (const TemplateCircle& circle : drawing.circles) pdf.draw_circle(circle.middle, circle.radius);
    for (const TemplateText& text : drawing.texts) {
        const double width = text.is_centred ? pdf.text_width(text.height, text.text) : 0.0;
        pdf.draw_text({text.at.x - width / 2, text.at.y}, text.height, text.text);
    }
}

}  // namespace

TemplateTiles tiles_of(Point2 sheet) {
    TemplateTiles upright = tiles_on(a4, sheet);
    TemplateTiles lying = tiles_on({a4.y, a4.x}, sheet);
    return lying.corners.size() < upright.corners.size() ? lying : upright;
}

Bytes template_pdf(const CapTemplate& drawing) {
    constexpr double largest = 5'000;  // mm; hundreds of pages
    if (drawing.sheet.x > largest || drawing.sheet.y > largest) {
        throw InputError(InputFault::use, "a cap is larger than a template can be, 5 m", "cut the piece further");
    }
    Pdf pdf;
    const TemplateTiles tiles = tiles_of(drawing.sheet);
    CapTemplate marked = drawing;
    add_seams(marked, tiles);
    const Point2 window{margin, margin + strip};
    for (std::size_t tile = 0; tile < tiles.corners.size(); ++tile) {
        const Point2 corner = tiles.corners[tile];
        pdf.add_page(tiles.paper);
        pdf.begin_window(window, tiles.window, {window.x - corner.x, window.y - corner.y});  // in true size
        draw(pdf, marked);
        pdf.end_window();
        draw(pdf, strip_of(drawing, tiles, tile));
    }
    return pdf.bytes();
}

}  // namespace qchopper
