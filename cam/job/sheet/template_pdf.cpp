// Every page draws the whole template, moved, and clips it to its window; the PDF is written by libharu. O(tiles *
// corners).

#include "cam/job/sheet/template_pdf.h"

#include <hpdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/error.h"

namespace qchopper {
namespace {

constexpr Point2 a4{210, 297};
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

// The page of a PDF counts in points.
constexpr double points_per_mm = 72 / 25.4;

HPDF_REAL to_points(double mm) {
    return static_cast<HPDF_REAL>(mm * points_per_mm);
}

struct FreePdf {
    void operator()(HPDF_Doc document) const { HPDF_Free(document); }
};
using Pdf = std::unique_ptr<_HPDF_Doc_Rec, FreePdf>;

void draw_line(HPDF_Page page, const std::vector<Point2>& line, bool is_closed) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto to = i == 0 ? HPDF_Page_MoveTo : HPDF_Page_LineTo;
        to(page, to_points(line[i].x), to_points(line[i].y));
    }
    if (is_closed) HPDF_Page_ClosePath(page);
    HPDF_Page_Stroke(page);
}

void draw_text(HPDF_Page page, HPDF_Font font, const TemplateText& text) {
    HPDF_Page_SetFontAndSize(page, font, to_points(text.height));
    const double width =
        text.is_centred ? static_cast<double>(HPDF_Page_TextWidth(page, text.text.c_str())) / points_per_mm : 0.0;
    HPDF_Page_BeginText(page);
    HPDF_Page_TextOut(page, to_points(text.at.x - width / 2), to_points(text.at.y), text.text.c_str());
    HPDF_Page_EndText(page);
}

void draw(HPDF_Page page, HPDF_Font font, const CapTemplate& drawing) {
    HPDF_Page_SetLineWidth(page, to_points(0.3));
    for (const std::vector<Point2>& outline : drawing.outlines) draw_line(page, outline, true);
    HPDF_Page_SetLineWidth(page, to_points(0.15));
    for (const std::vector<Point2>& line : drawing.lines) draw_line(page, line, false);
    for (const TemplateCircle& circle : drawing.circles) {
        HPDF_Page_Circle(page, to_points(circle.middle.x), to_points(circle.middle.y), to_points(circle.radius));
        HPDF_Page_Stroke(page);
    }
    for (const TemplateText& text : drawing.texts) draw_text(page, font, text);
}

// The part of the drawing that lies in the window, in true size.
void draw_window(HPDF_Page page, HPDF_Font font, const CapTemplate& drawing, const TemplateTiles& tiles,
                 Point2 corner) {
    HPDF_Page_GSave(page);
    HPDF_Page_Rectangle(page, to_points(margin), to_points(margin + strip), to_points(tiles.window.x),
                        to_points(tiles.window.y));
    HPDF_Page_Clip(page);
    HPDF_Page_EndPath(page);
    HPDF_Page_Concat(page, 1, 0, 0, 1, to_points(margin - corner.x), to_points(margin + strip - corner.y));
    draw(page, font, drawing);
    HPDF_Page_GRestore(page);
}

Bytes bytes_of(HPDF_Doc document) {
    Bytes bytes;
    HPDF_SaveToStream(document);
    HPDF_ResetStream(document);
    for (;;) {
        std::array<HPDF_BYTE, 4096> block;
        HPDF_UINT32 size = block.size();
        const HPDF_STATUS status = HPDF_ReadFromStream(document, block.data(), &size);
        bytes.insert(bytes.end(), block.begin(), block.begin() + size);
        if (status != HPDF_OK || size == 0) return bytes;
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
    const Pdf document(HPDF_New(nullptr, nullptr));
    if (!document) throw InputError(InputFault::io, "the PDF library has no memory for a template");
    HPDF_Font font = HPDF_GetFont(document.get(), "Helvetica", nullptr);
    const TemplateTiles tiles = tiles_of(drawing.sheet);
    CapTemplate marked = drawing;
    add_seams(marked, tiles);
    for (std::size_t tile = 0; tile < tiles.corners.size(); ++tile) {
        HPDF_Page page = HPDF_AddPage(document.get());
        HPDF_Page_SetWidth(page, to_points(tiles.paper.x));
        HPDF_Page_SetHeight(page, to_points(tiles.paper.y));
        draw_window(page, font, marked, tiles, tiles.corners[tile]);
        draw(page, font, strip_of(drawing, tiles, tile));
    }
    Bytes bytes = bytes_of(document.get());
    if (bytes.empty()) throw InputError(InputFault::io, "the PDF library made no template");
    return bytes;
}

}  // namespace qchopper
