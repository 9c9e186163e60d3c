// Fills rectangles of pixels in the scale that all four panels share. O(pixels).

#include "app/pictures/reach_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "base/units.h"
#include "segment/picture/lettering.h"

namespace qchopper {
namespace {

constexpr int picture_width = 1600;
constexpr double header = 96;   // above the panels
constexpr double footer = 100;  // below them: scale bar and legend
constexpr double panel_width = 790;
constexpr double plot_width = 660;  // largest, of the section in a panel
constexpr double plot_height = 560;
constexpr double above_plot = 44;  // title of the panel
constexpr double below_plot = 70;  // numbers and name of the x axis
constexpr double left_of_plot = 90;
constexpr double min_tick_distance = 80;

constexpr Rgb paper{255, 255, 255};
constexpr Rgb held_by_all{0, 92, 169};
constexpr Rgb grid_colour{205, 205, 205};
constexpr Rgb frame_colour{110, 110, 110};
constexpr Rgb box_colour{213, 94, 0};
constexpr Rgb table_colour{30, 30, 30};
constexpr Rgb base_colour{160, 0, 90};

Rgb colour_of(double share) {
    const auto channel = [share](int from, int to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {channel(paper.r, held_by_all.r), channel(paper.g, held_by_all.g), channel(paper.b, held_by_all.b)};
}

// Pixels whose rounded coordinates lie in the half-open rectangle; at least one wide and high.
struct PixelArea {
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
};

void fill(Pixels& pixels, const PixelArea& area, Rgb colour) {
    const auto clamped = [](double value, int end) {
        return static_cast<int>(std::clamp(std::round(value), 0.0, static_cast<double>(end)));
    };
    const int left = clamped(area.left, pixels.width);
    const int right = std::min(pixels.width, std::max(left + 1, clamped(area.right, pixels.width)));
    const int top = clamped(area.top, pixels.height);
    const int bottom = std::min(pixels.height, std::max(top + 1, clamped(area.bottom, pixels.height)));
    for (int y = top; y < bottom; ++y) {
        const auto row = pixels.rows.begin() + static_cast<std::ptrdiff_t>(y) * pixels.width;
        std::fill(row + left, row + std::max(left, right), colour);
    }
}

void outline(Pixels& pixels, const PixelArea& area, double width, Rgb colour) {
    const double half = width / 2;
    fill(pixels, {area.left - half, area.top - half, area.right + half, area.top + half}, colour);
    fill(pixels, {area.left - half, area.bottom - half, area.right + half, area.bottom + half}, colour);
    fill(pixels, {area.left - half, area.top - half, area.left + half, area.bottom + half}, colour);
    fill(pixels, {area.right - half, area.top - half, area.right + half, area.bottom + half}, colour);
}

// The section in pixels: where it lies in the picture and how large a mm is.
struct SectionPanel {
    const ReachSection& section;
    double left = 0;
    double top = 0;
    double scale = 1;  // pixels per mm

    double width() const { return scale * section.step * static_cast<double>(section.columns); }
    double height() const { return scale * section.step * static_cast<double>(section.rows); }
    double x(double mm) const { return left + scale * (mm - section.x_min); }
    double y(double mm) const { return top + height() - scale * (mm - section.z_min); }
    PixelArea area() const { return {left, top, left + width(), top + height()}; }
};

double scale_of(const ReachSection& section) {
    return std::min(plot_width / (section.step * static_cast<double>(section.columns)),
                    plot_height / (section.step * static_cast<double>(section.rows)));
}

// 1, 2 or 5 times a power of ten mm.
double tick_distance(double scale) {
    const double least = min_tick_distance / scale;
    const double power = std::pow(10, std::floor(std::log10(least)));
    return least <= power ? power : least <= 2 * power ? 2 * power : least <= 5 * power ? 5 * power : 10 * power;
}

void draw_squares(Pixels& pixels, const SectionPanel& panel, const TiltReach& reach) {
    const ReachSection& s = panel.section;
    const double side = panel.scale * s.step;
    for (std::size_t row = 0; row < s.rows; ++row) {
        for (std::size_t column = 0; column < s.columns; ++column) {
            const double share = static_cast<double>(reach.held[row * s.columns + column]) / reach.azimuths;
            if (share == 0) continue;
            const double left = panel.left + side * static_cast<double>(column);
            const double bottom = panel.top + panel.height() - side * static_cast<double>(row);
            fill(pixels, {left, bottom - side, left + side, bottom}, colour_of(share));
        }
    }
}

// Lines through the section at round numbers, with these in m.
void draw_axes(Pixels& pixels, const SectionPanel& panel) {
    const PixelArea area = panel.area();
    const double distance = tick_distance(panel.scale);
    const double x_max = panel.section.x_min + panel.width() / panel.scale;
    const double z_max = panel.section.z_min + panel.height() / panel.scale;
    const auto label = [](double mm) { return significant(mm / 1000, 4); };
    for (double i = std::ceil(panel.section.x_min / distance); i * distance <= x_max; ++i) {
        const double x = panel.x(i * distance);
        fill(pixels, {x, area.top, x + 1, area.bottom}, grid_colour);
        draw_text(pixels, x, area.bottom + 18, label(i * distance), 13);
    }
    for (double i = std::ceil(panel.section.z_min / distance); i * distance <= z_max; ++i) {
        const double y = panel.y(i * distance);
        fill(pixels, {area.left, y, area.right, y + 1}, grid_colour);
        draw_text(pixels, area.left - 28, y, label(i * distance), 13);
    }
    outline(pixels, area, 1, frame_colour);
    draw_text(pixels, (area.left + area.right) / 2, area.bottom + 44, "x in m", 14);
    draw_text(pixels, area.left - 45, area.top - 24, "z in m", 14);
}

void draw_cell(Pixels& pixels, const SectionPanel& panel, const Cell& cell) {
    const Box& box = cell.workspace;
    outline(pixels, {panel.x(box.min.x), panel.y(box.max.z), panel.x(box.max.x), panel.y(box.min.z)}, 3, box_colour);
    const bool is_rotary = cell.machine && cell.machine->rotary_table;
    const double half = is_rotary ? cell.machine->rotary_table->radius : cell.table.size_x / 2;
    const double z = panel.y(cell.table.height);
    fill(pixels, {panel.x(cell.table.centre_x - half), z - 4, panel.x(cell.table.centre_x + half), z + 4},
         table_colour);
    if (!cell.machine || !cell.machine->robot) return;
    const Vec3 base = cell.machine->robot->base_in_cell.shift;
    fill(pixels, {panel.x(base.x) - 8, panel.y(base.z) - 8, panel.x(base.x) + 8, panel.y(base.z) + 8}, base_colour);
}

std::string title_of(const Cell& cell, double tilt) {
    std::string title = "tilt " + significant(degrees(tilt), 3) + " degrees";
    if (!cell.machine) return title + ": no robot is described";
    if (!cell.machine->robot) return title + (tilt == 0 ? ": straight down" : ": a gantry does not tilt");
    if (tilt == 0) return title + ": straight down";
    if (tilt <= cell.machine->max_tilt + 1e-9) return title;
    return title + ", more than this cell's " + significant(degrees(cell.machine->max_tilt), 3);
}

void draw_header(Pixels& pixels, const Cell& cell, double y) {
    const double middle = pixels.width / 2.0;
    draw_text(pixels, middle, 30, cell.name, 22);
    const std::string what = cell.machine ? "reach of the tool tip" : "arm not checked: table and reach box only";
    draw_text(
        pixels, middle, 68,
        what + ", section x-z at y = " + significant(y, 6) + " mm" + (cell.machine ? ", no collision checked" : ""),
        16);
}

// Colours and outlines, beside the scale bar.
void draw_legend(Pixels& pixels, const Cell& cell) {
    const double y = pixels.height - 44;
    const bool has_robot = cell.machine && cell.machine->robot;
    if (cell.machine) {
        draw_text(pixels, 527, y, "share of azimuths held:  none", 14);
        for (int i = 0; i <= reach_azimuths; ++i) {
            const PixelArea area{700.0 + 24 * i, y - 12, 724.0 + 24 * i, y + 12};
            fill(pixels, area, colour_of(static_cast<double>(i) / reach_azimuths));
            outline(pixels, area, 1, frame_colour);
        }
        draw_text(pixels, 940, y, "all", 14);
    }
    fill(pixels, {1070, y - 4, 1110, y + 4}, table_colour);
    draw_text(pixels, 1145, y, "table", 14);
    outline(pixels, {1210, y - 10, 1250, y + 10}, 3, box_colour);
    draw_text(pixels, 1315, y, "reach box", 14);
    if (!has_robot) return;
    fill(pixels, {1408, y - 8, 1424, y + 8}, base_colour);
    draw_text(pixels, 1500, y, "robot's base", 14);
}

}  // namespace

std::vector<double> pictured_tilts() {
    return {0, 30 * degree, 60 * degree, 90 * degree};
}

Pixels draw_reach(const Cell& cell, const ReachMap& map) {
    const ReachSection& section = map.section;
    SectionPanel panel{section, 0, 0, scale_of(section)};
    const double panel_height = above_plot + panel.height() + below_plot;
    Pixels pixels;
    pixels.width = picture_width;
    pixels.height = static_cast<int>(std::ceil(header + 2 * panel_height + footer));
    pixels.rows.assign(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height), paper);
    draw_header(pixels, cell, section.y);
    const std::vector<double> tilts = pictured_tilts();
    for (std::size_t i = 0; i < tilts.size(); ++i) {
        const double panel_left = panel_width * static_cast<double>(i % 2);
        panel.left = std::round(panel_left + left_of_plot + (plot_width - panel.width()) / 2);
        panel.top = std::round(header + (i < 2 ? 0 : panel_height) + above_plot);
        if (i < map.tilts.size()) draw_squares(pixels, panel, map.tilts[i]);
        draw_axes(pixels, panel);
        draw_cell(pixels, panel, cell);
        draw_text(pixels, panel.left + panel.width() / 2, panel.top - 24, title_of(cell, tilts[i]), 17);
    }
    draw_legend(pixels, cell);
    draw_scale_bar(pixels, 1 / panel.scale);
    return pixels;
}

}  // namespace qchopper
