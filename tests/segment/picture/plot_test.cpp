#include "segment/picture/plot.h"
#include "base/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "segment/picture/axis.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t hits = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++hits;
    return hits;
}

// Why a text is no well-formed XML of the plain kind that we write; empty if it is.
std::string fault_of(const std::string& xml) {
    std::vector<std::string> open;
    std::size_t i = xml.find("?>");
    if (xml.rfind("<?xml", 0) != 0 || i == std::string::npos) return "no declaration";
    for (i += 2; i < xml.size();) {
        const std::size_t tag = xml.find('<', i);
        for (std::size_t k = i; k < std::min(tag, xml.size()); ++k) {
            if (xml[k] == '>') return "bare > at " + std::to_string(k);
            if (xml[k] == '&' && xml.find(';', k) > k + 6) return "bare & at " + std::to_string(k);
            if (static_cast<unsigned char>(xml[k]) < 0x20 && xml[k] != '\n') return "control character";
        }
        if (tag == std::string::npos) break;
        const std::size_t end = xml.find('>', tag);
        if (end == std::string::npos) return "open tag at " + std::to_string(tag);
        const std::string inside = xml.substr(tag + 1, end - tag - 1);
        const std::string name = inside.substr(0, inside.find_first_of(" /", 1));
        if (inside.find('<') != std::string::npos || count(inside, "\"") % 2 != 0) return "bad tag " + inside;
        if (inside.front() == '/') {
            if (open.empty() || "/" + open.back() != inside) return "closes wrongly: " + inside;
            open.pop_back();
        } else if (inside.back() != '/') {
            open.push_back(name);
        }
        i = end + 1;
    }
    return open.empty() ? "" : "never closed: " + open.back();
}

PlotRow row_of(std::vector<std::vector<PlotPoint>> curves) {
    PlotRow row;
    row.title = "Undercut";
    row.colour = piece_colour(3);
    row.curves = std::move(curves);
    return row;
}

Plot simple() {
    Plot plot;
    plot.title = "Cut 1";
    plot.notes = {"a note"};
    plot.columns = {{"Normal 1", "mm", {{1.5, "chosen", false}}}, {"Normal 2", "mm", {}}};
    plot.rows = {row_of({{{0, 1}, {1, 3}, {2, 2}}, {{0, 4}, {1, 5}}})};
    return plot;
}

// Every kind of trouble that numbers can make.
std::vector<std::vector<PlotPoint>> awkward_curves() {
    return {{},
            {{0, nan}, {1, nan}},
            {{0, 1}},
            {{5, 7}, {5, 7}},
            {{0, 0}, {1, 0}},
            {{0, infinity}, {1, -infinity}, {2, 3}},
            {{-1e300, -1e300}, {1e300, 1e300}},
            {{1e-300, 1e-300}, {2e-300, 2e-300}},
            {{1e9, 1e15}, {1e9 + 1e-6, 1e15 + 1}},
            {{nan, 1}, {infinity, 2}, {1e308, -1e308}, {-1e308, 1e308}},
            {{0, -1}, {1, 0}, {2, 1e-12}, {3, 1e12}}};
}

TEST(Plot, IsWellFormedWhateverTheNumbers) {
    for (const auto& curve : awkward_curves()) {
        for (const bool is_logarithmic : {false, true}) {
            Plot plot = simple();
            plot.rows = {row_of({curve, curve})};
            plot.rows[0].is_logarithmic = is_logarithmic;
            plot.columns[1].marks = {{nan, "nowhere", true}, {infinity, "far", false}};
            const std::string svg = to_svg(plot);
            EXPECT_EQ(fault_of(svg), "");
            EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0U) << svg;
            EXPECT_LT(svg.size(), 20'000U);
        }
    }
}

TEST(Plot, IsWellFormedWhateverTheLabelsHold) {
    const std::string nasty = "a<b>&\"c'\x01\x7F\xFF\xC3\xA9 \xED\xA0\x80 \xF4\x90\x80\x80 \xC0\xAF \xE2\x82";
    Plot plot = simple();
    plot.title = plot.notes[0] = plot.columns[0].title = plot.columns[0].x_label = nasty;
    plot.columns[0].marks[0].label = plot.rows[0].title = nasty;
    EXPECT_EQ(fault_of(to_svg(plot)), "");
    EXPECT_EQ(svg_text("a<b>&\"\x01\xC3\xA9\xFF"), "a&lt;b&gt;&amp;&quot;?\xC3\xA9?");
    EXPECT_EQ(svg_text("\xED\xA0\x80"), "???");  // half of a surrogate pair is no character
    EXPECT_EQ(svg_text("\xC0\xAF\xE2\x82"), "????");
}

TEST(Plot, OfNothingIsStillAPicture) {
    EXPECT_EQ(fault_of(to_svg({})), "");
    Plot plot = simple();
    plot.rows[0].curves.clear();
    EXPECT_EQ(fault_of(to_svg(plot)), "");
}

TEST(Plot, SameBytesEveryTime) {
    EXPECT_EQ(to_svg(simple()), to_svg(simple()));
}

TEST(Plot, LoadsNothingFromElsewhere) {
    const std::string svg = to_svg(simple());
    for (const char* word : {"<script", "href", "@import", "<image", "url(http"}) EXPECT_EQ(count(svg, word), 0U);
    EXPECT_EQ(count(svg, "http"), 1U);  // the name of the format
}

TEST(Plot, AGapBreaksTheCurve) {
    Plot plot = simple();
    plot.columns.resize(1);
    plot.columns[0].marks.clear();
    const auto strokes = [&](double middle) {
        plot.rows = {row_of({{{0, 1}, {1, 2}, {2, middle}, {3, 2}, {4, 1}}})};
        const std::string svg = to_svg(plot);
        const std::size_t from = svg.find("<g clip-path");
        const std::string path = svg.substr(svg.find("<path d=", from), svg.find("fill=\"none\"", from) - from);
        return count(path, "M");
    };
    EXPECT_EQ(strokes(2), 1U);
    EXPECT_EQ(strokes(nan), 2U);
}

TEST(Plot, AValueBeyondTheFrameLeavesAnArrow) {
    Plot plot = simple();
    plot.rows[0].range = PlotRange{0, 10};
    const std::size_t none = count(to_svg(plot), "Z\"");
    plot.rows[0].curves[0][1].y = 11;
    plot.rows[0].curves[0][2].y = -1;
    EXPECT_EQ(none, 0U);
    EXPECT_EQ(count(to_svg(plot), "Z\""), 2U);
}

TEST(Plot, AMarkPutsADotWhereItMeetsTheCurve) {
    Plot plot = simple();
    const auto dots = [&] { return count(to_svg(plot), "r=\"3.6\""); };
    EXPECT_EQ(dots(), 1U);
    plot.columns[0].marks[0].x = 7;  // beside the curve
    EXPECT_EQ(dots(), 0U);
    plot.columns[0].marks[0].x = 0.5;
    plot.rows[0].curves[0][1].y = nan;  // in a gap
    EXPECT_EQ(dots(), 0U);
}

TEST(Plot, TicksAreRoundAndInside) {
    for (const double low : {-1e6, -3.2, 0.0, 1e-7, 7.0, 123456.0}) {
        for (const double span : {1e-5, 0.3, 1.0, 9.0, 12.0, 77.0, 1e9}) {
            for (const int wanted : {3, 5}) {
                const Ticks t = ticks({low, low + span}, wanted);
                ASSERT_GE(t.values.size(), 2U) << low << " " << span;
                EXPECT_LE(t.values.size(), 2U * static_cast<std::size_t>(wanted) + 2);
                const double step = t.values[1] - t.values[0];
                const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
                EXPECT_TRUE(std::abs(digit - 1) < 1e-2 || std::abs(digit - 2) < 1e-2 || std::abs(digit - 5) < 1e-2)
                    << step;
                for (const double value : t.values) {
                    EXPECT_GE(value, low - 1e-6 * span);
                    EXPECT_LE(value, low + span * (1 + 1e-6));
                    EXPECT_NEAR(std::stod(t.text(value)), value, 0.01 * step);
                }
            }
        }
    }
}

TEST(Plot, DecadesAreInside) {
    for (const PlotRange range : {PlotRange{2, 3000}, PlotRange{1.5, 9}, PlotRange{1e-9, 1e9}, PlotRange{0.003, 40}}) {
        const Ticks t = decades(range);
        ASSERT_GE(t.values.size(), 2U);
        EXPECT_TRUE(std::is_sorted(t.values.begin(), t.values.end()));
        for (const double value : t.values) {
            EXPECT_GE(value, range.low);
            EXPECT_LE(value, range.high);
            EXPECT_NEAR(std::stod(t.text(value)) / value, 1, 1e-6);
        }
    }
}

TEST(Plot, NumbersHaveAPointAndNoMinusZero) {
    EXPECT_EQ(fixed(-0.001, 2), "0.00");
    EXPECT_EQ(fixed(-0.01, 2), "-0.01");
    EXPECT_EQ(fixed(1234.5, 1), "1234.5");
    EXPECT_EQ(svg_colour({85, 144, 226}), "#5590e2");
}

}  // namespace
}  // namespace qchopper
