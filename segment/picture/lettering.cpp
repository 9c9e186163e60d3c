// Strokes of the Hershey fonts (A. V. Hershey, "Calligraphy for computers", 1967, read by libhersheyfont), covered by
// the distance of each pixel to them. O(pixels of the text's box x strokes).

#include "segment/picture/lettering.h"

extern "C" {
#include <hersheyfont.h>
}

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/error.h"

namespace qchopper {
namespace {

constexpr double capital_units = 21;  // height of a capital letter in the font, whose foot is at 0
constexpr Rgb ink{30, 30, 30};
constexpr Rgb paper{255, 255, 255};

struct StrokePoint {
    double x = 0;
    double y = 0;
};
using Stroke = std::vector<StrokePoint>;

struct FreeFont {
    void operator()(hershey_font* font) const { hershey_font_free(font); }
};

using Font = std::unique_ptr<hershey_font, FreeFont>;

// The library prints an error where the file is missing, so it is not called then.
hershey_font* font() {
    static const Font loaded = [] {
        std::error_code error;
        const bool is_there = std::filesystem::exists(QCHOPPER_HERSHEY_FONT, error);
        return Font(is_there ? hershey_jhf_font_load(QCHOPPER_HERSHEY_FONT) : nullptr);
    }();
    if (loaded != nullptr) return loaded.get();
    throw InputError(InputFault::missing, std::string("the font of pictures, " QCHOPPER_HERSHEY_FONT ", is missing"),
                     "install the package hershey-fonts-data");
}

// Strokes in units of the font, from x = 0 to `width`, y downwards.
std::vector<Stroke> strokes_of(const std::string& text, double& width) {
    std::vector<Stroke> strokes;
    width = 0;
    for (const char c : text) {
        const hershey_glyph* glyph = hershey_font_glyph(font(), static_cast<unsigned char>(c));
        if (glyph == nullptr) continue;
        for (const hershey_path* path = glyph->paths; path != nullptr; path = path->next) {
            Stroke stroke;
            for (std::size_t i = 0; i < path->nverts; ++i) {
                stroke.push_back({width + path->verts[i].x, -static_cast<double>(path->verts[i].y)});
            }
            strokes.push_back(std::move(stroke));
        }
        width += glyph->width;
    }
    return strokes;
}

double distance(StrokePoint p, StrokePoint a, StrokePoint b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = dx * dx + dy * dy;
    const double along = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

void blend(Rgb& under, Rgb over, double share) {
    const auto channel = [share](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
    };
    under = {channel(under.r, over.r), channel(under.g, over.g), channel(under.b, over.b)};
}

// Strokes in pixels, drawn with round ends: first their border, then themselves.
void draw(Pixels& pixels, const std::vector<Stroke>& strokes, double width) {
    const double border = 1.2 * width;
    double left = pixels.width;
    double right = 0;
    double top = pixels.height;
    double bottom = 0;
    for (const Stroke& stroke : strokes) {
        for (const StrokePoint p : stroke) {
            left = std::min(left, p.x);
            right = std::max(right, p.x);
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
        }
    }
    const double around = width + border + 1;
    const int last_x = static_cast<int>(std::min(pixels.width - 1.0, std::ceil(right + around)));
    const int last_y = static_cast<int>(std::min(pixels.height - 1.0, std::ceil(bottom + around)));
    for (int y = static_cast<int>(std::max(0.0, top - around)); y <= last_y; ++y) {
        for (int x = static_cast<int>(std::max(0.0, left - around)); x <= last_x; ++x) {
            double nearest = 1e9;
            for (const Stroke& stroke : strokes) {
                for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
                    nearest = std::min(nearest, distance({x + 0.5, y + 0.5}, stroke[i], stroke[i + 1]));
                }
            }
            Rgb& pixel = pixels.rows[static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) +
                                     static_cast<std::size_t>(x)];
            const double to_edge = width / 2 + 0.5 - nearest;
            blend(pixel, paper, 0.8 * std::clamp(to_edge + border, 0.0, 1.0));
            blend(pixel, ink, std::clamp(to_edge, 0.0, 1.0));
        }
    }
}

}  // namespace

void check_font() {
    font();
}

void draw_text(Pixels& pixels, double x, double y, const std::string& text, double height) {
    double units = 0;
    std::vector<Stroke> strokes = strokes_of(text, units);
    if (strokes.empty()) return;
    const double scale = height / capital_units;
    const double half = scale * units / 2;
    x = std::clamp(x, half, std::max(half, pixels.width - half));
    y = std::clamp(y, height, std::max(height, pixels.height - height));
    for (Stroke& stroke : strokes) {
        for (StrokePoint& p : stroke) p = {x - half + scale * p.x, y + height / 2 + scale * p.y};
    }
    draw(pixels, strokes, std::max(1.0, height / 8));
}

std::string describe_length(double mm) {
    const double unit = mm >= 1000 ? 1000 : mm >= 10 ? 10 : 1;
    const double value = mm / unit;
    std::string digits = std::to_string(value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits + (unit == 1000 ? " m" : unit == 10 ? " cm" : " mm");
}

void draw_scale_bar(Pixels& pixels, double mm_per_pixel) {
    const double wanted_mm = mm_per_pixel * pixels.width / 6;
    const double power = std::pow(10, std::floor(std::log10(wanted_mm)));
    const double length_mm = wanted_mm < 2 * power ? power : wanted_mm < 5 * power ? 2 * power : 5 * power;
    const double length = length_mm / mm_per_pixel;
    const double unit = pixels.height / 900.0;  // sizes are those of a picture of 900 rows
    const double left = 24 * unit;
    const double y = pixels.height - 20 * unit;
    const double tick = 5 * unit;
    draw(pixels,
         {{{left, y - tick}, {left, y + tick}},
          {{left, y}, {left + length, y}},
          {{left + length, y - tick}, {left + length, y + tick}}},
         2 * unit);
    draw_text(pixels, left + length / 2, y - 18 * unit, describe_length(length_mm), 14 * unit);
}

}  // namespace qchopper
