// Rows a pitch apart, halved again and again where the scallop between two of them is higher than it may be
// (scallop.h with the chord and the bulge of the CL surface between the rows). The pitch is the one with which that
// gives the least length. O(cells).

#include "cam/toolpath/finishing/raster_passes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "cam/toolpath/finishing/scallop.h"

namespace qchopper {
namespace {

constexpr std::size_t fine = 4;  // rows per cell that may be chosen

// Rows of a CL surface that are a fraction of a cell apart: linear between centres, but the higher of both where an
// edge may lie between them. That is never deeper below the surface than a line along a row (cl_surface.h).
class FineRows {
 public:
    FineRows(const ClSurfaceView& view, double radius) : view_(view), jump_(std::sqrt(radius * view.cell())) {}

    double cell() const { return view_.cell(); }
    std::size_t columns() const { return view_.columns(); }
    std::size_t rows() const { return fine * (view_.rows() - 1) + 1; }
    // Of the cell of a mask that is nearest.
    std::size_t index(std::size_t column, std::size_t row) const {
        return view_.index(column, (row + fine / 2) / fine);
    }
    double at(std::size_t column, std::size_t row) const {
        const double part = static_cast<double>(row % fine) / fine;
        const double low = view_.at(column, row / fine);
        if (part == 0) return low;
        const double high = view_.at(column, row / fine + 1);
        return is_edge(low, high) ? std::max(low, high) : (1 - part) * low + part * high;
    }
    bool is_edge(double a, double b) const { return std::abs(a - b) > jump_; }
    double slope_along(std::size_t column, std::size_t row) const {
        return view_.slope_along(column, (row + fine / 2) / fine);
    }
    Vec3 point(double column, std::size_t row, double z) const {
        return view_.point(column, static_cast<double>(row) / fine, z);
    }

 private:
    const ClSurfaceView& view_;
    double jump_;
};

struct RowPart {
    std::size_t row = 0;
    std::size_t first = 0;
    std::size_t end = 0;
};
using RowParts = std::vector<RowPart>;

// How much closer than on a plane rows have to lie: a count per class of 1 / stretch_classes.
constexpr std::size_t stretch_classes = 20;
constexpr std::size_t max_stretch = 5;
using StretchCounts = std::array<double, stretch_classes * max_stretch>;

double stretch(double along, double across) {
    return std::sqrt(1 + across * across / (1 + along * along));
}

StretchCounts count_stretch(const ClSurfaceView& view, const CellMask& mask) {
    StretchCounts counts{};
    // Every fourth cell of every fourth row tells enough.
    for (std::size_t row = 0; row < view.rows(); row += 4) {
        for (std::size_t column = 0; column < view.columns(); column += 4) {
            if (mask[view.index(column, row)] == 0) continue;
            const double s = stretch(view.slope_along(column, row), view.slope_across(column, row));
            const auto at = static_cast<std::size_t>((s - 1) * stretch_classes);
            counts[std::min(at, counts.size() - 1)] += 1;
        }
    }
    return counts;
}

// Rows per cell across, summed over the cells.
double row_density(const StretchCounts& counts, double pitch, double chord) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double needed = pitch * (1 + (static_cast<double>(i) + 0.5) / stretch_classes) / chord;
        sum += counts[i] / pitch * std::exp2(std::max(0.0, std::ceil(std::log2(needed))));
    }
    return sum;
}

// Runs of marked cells; a gap of at most `gap` is bridged where that is possible.
template <class IsMarked, class CanBridge>
void add_parts(RowParts& parts, const RowPart& range, std::size_t gap, const IsMarked& is_marked,
               const CanBridge& can_bridge) {
    const std::size_t before = parts.size();
    for (std::size_t c = range.first; c < range.end; ++c) {
        if (!is_marked(c)) continue;
        if (parts.size() > before && c - parts.back().end <= gap && can_bridge(parts.back().end - 1, c)) {
            parts.back().end = c + 1;
        } else {
            parts.push_back({range.row, c, c + 1});
        }
    }
}

class Raster {
 public:
    Raster(const FineRows& view, const PassCells& cells, const RasterOptions& options, std::size_t pitch)
        : view_(view), cells_(cells), options_(options), pitch_(pitch), gap_(2 * pitch / fine) {
        overlap_ = static_cast<std::size_t>(std::ceil(options.overlap / view.cell()));
    }

    RowParts parts() const {
        const std::size_t rows = (view_.rows() + pitch_ - 1) / pitch_;
        std::vector<RowParts> by_row(rows);
        parallel_for(0, rows, [&](std::size_t i) {
            const std::size_t row = std::min(i * pitch_ + pitch_ / 2, view_.rows() - 1);
            const RowPart whole{row, 0, view_.columns()};
            add_parts(
                by_row[i], whole, gap_, [&](std::size_t c) { return is_allowed(c, row); },
                [&](std::size_t from, std::size_t to) { return is_smooth(row, from, to); });
            lay_between(by_row[i], row, std::min(row + pitch_, view_.rows() - 1), {whole});
        });
        RowParts all;
        for (const RowParts& some : by_row) all.insert(all.end(), some.begin(), some.end());
        return all;
    }

 private:
    bool is_allowed(std::size_t column, std::size_t row) const { return cells_.allowed[view_.index(column, row)] != 0; }

    // Whether the CL surface has no edge between two columns.
    bool is_smooth(std::size_t row, std::size_t from, std::size_t to) const {
        for (std::size_t c = from; c < to; ++c) {
            if (view_.is_edge(view_.at(c + 1, row), view_.at(c, row))) return false;
        }
        return true;
    }

    bool is_needed(std::size_t column, std::size_t low, std::size_t middle, std::size_t high) const {
        if (cells_.wanted[view_.index(column, middle)] == 0) return false;
        const double z_low = view_.at(column, low);
        const double z_high = view_.at(column, high);
        const double step = view_.cell() * static_cast<double>(high - low) / fine;
        const double along = view_.slope_along(column, middle);
        const double across = (z_high - z_low) / step;
        const double share = static_cast<double>(middle - low) / static_cast<double>(high - low);
        const double above = view_.at(column, middle) - (z_low + share * (z_high - z_low));
        const double bulge = above / std::sqrt(1 + along * along + across * across);
        return scallop_height(options_.radius, step * stretch(along, across), bulge) > options_.scallop;
    }

    // With the overlap at both ends, as far as it is allowed.
    RowPart extended(RowPart part) const {
        const std::size_t first = part.first - std::min(part.first, overlap_);
        const std::size_t end = std::min(part.end + overlap_, view_.columns());
        while (part.first > first && is_allowed(part.first - 1, part.row)) --part.first;
        while (part.end < end && is_allowed(part.end, part.row)) ++part.end;
        return part;
    }

    void lay_between(RowParts& found, std::size_t low, std::size_t high, const RowParts& where) const {
        if (high < low + 2 * fine) return;
        const std::size_t middle = (low + high) / 2;
        RowParts needed;
        for (RowPart part : where) {
            part.row = middle;
            add_parts(
                needed, part, gap_, [&](std::size_t c) { return is_needed(c, low, middle, high); },
                [&](std::size_t from, std::size_t to) { return is_smooth(middle, from, to); });
        }
        if (needed.empty()) return;
        for (const RowPart& part : needed) {
            const RowPart longer = extended(part);
            if (!found.empty() && found.back().row == middle && found.back().end >= longer.first) {
                found.back().end = std::max(found.back().end, longer.end);
            } else {
                found.push_back(longer);
            }
        }
        lay_between(found, low, middle, needed);
        lay_between(found, middle, high, needed);
    }

    const FineRows& view_;
    const PassCells& cells_;
    const RasterOptions& options_;
    std::size_t pitch_;
    std::size_t gap_;  // in columns, over which parts of a row are joined
    std::size_t overlap_ = 0;
};

// Where the CL surface falls so far from one middle to the next that the tool would cut into an edge between them, the
// higher of both holds for both: chords longer than sqrt(radius * cell) cut deeper than cell / 8.
std::vector<double> lifted_heights(const FineRows& view, const RowPart& part) {
    std::vector<double> z;
    z.reserve(part.end - part.first);
    for (std::size_t c = part.first; c < part.end; ++c) {
        const double own = view.at(c, part.row);
        double lifted = own;
        for (const std::size_t beside : {c > part.first ? c - 1 : c, c + 1 < part.end ? c + 1 : c}) {
            const double other = view.at(beside, part.row);
            if (view.is_edge(other, own)) lifted = std::max(lifted, other);
        }
        z.push_back(lifted);
    }
    return z;
}

Pass pass_over(const FineRows& view, const RowPart& part, const RasterOptions& options) {
    constexpr double steepest = 5;  // a gate is at most so many tolerances high
    const std::vector<double> z = lifted_heights(view, part);
    std::vector<Gate> gates;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double before = z[i > 0 ? i - 1 : i];
        const double after = z[std::min(i + 1, z.size() - 1)];
        // On a straight stretch the gates at its ends say everything.
        if (i > 0 && i + 1 < z.size() && std::abs(before + after - 2 * z[i]) < 1e-9) continue;
        const double slope = std::min(std::abs(z[i] - before), std::abs(after - z[i])) / view.cell();
        const double height = options.path_tolerance * std::min(steepest, std::sqrt(1 + slope * slope));
        const double u = view.cell() * static_cast<double>(i);
        gates.push_back({{u, z[i]}, {u, z[i] + height}});
    }
    Pass pass;
    for (const ReducedPoint& p : reduced_path(gates, false, {options.rounding})) {
        const double column = static_cast<double>(part.first) + p.at.x / view.cell();
        pass.points.push_back({view.point(column, part.row, p.at.y), p.is_rounded});
    }
    return pass;
}

struct Pitch {
    bool is_turned = false;
    std::size_t rows = fine;
};

Pitch best_pitch(const HeightField& cl, const CellMask& mask, const RasterOptions& options) {
    const double chord = chord_for_scallop(options.radius, options.scallop) / cl.cell;
    Pitch best;
    double least = std::numeric_limits<double>::infinity();
    for (const bool is_turned : {false, true}) {
        const StretchCounts counts = count_stretch(ClSurfaceView(cl, is_turned), mask);
        for (auto rows = static_cast<std::size_t>(std::max(1.0, 0.5 * fine * chord));
             static_cast<double>(rows) <= fine * chord; ++rows) {
            const double density = row_density(counts, static_cast<double>(rows) / fine, chord);
            if (density >= least) continue;
            least = density;
            best = {is_turned, rows};
        }
    }
    return best;
}

}  // namespace

std::vector<Pass> raster_passes(const HeightField& cl, const PassCells& cells, const RasterOptions& options,
                                const Context& context) {
    assert(cells.wanted.size() == cl.height.size() && cells.allowed.size() == cl.height.size());
    assert(options.scallop > 0 && options.path_tolerance > 0);
    const Pitch pitch = best_pitch(cl, cells.wanted, options);
    const ClSurfaceView turned(cl, pitch.is_turned);
    const FineRows view(turned, options.radius);
    context.check_cancelled();
    RowParts parts = Raster(view, cells, options, pitch.rows).parts();
    parts.erase(std::remove_if(parts.begin(), parts.end(), [](const RowPart& p) { return p.end < p.first + 2; }),
                parts.end());
    std::stable_sort(parts.begin(), parts.end(), [](const RowPart& a, const RowPart& b) { return a.row < b.row; });
    context.check_cancelled();
    std::vector<Pass> passes(parts.size());
    parallel_for(0, parts.size(), [&](std::size_t i) { passes[i] = pass_over(view, parts[i], options); });
    return passes;
}

}  // namespace qchopper
