// Entries lie in squares; rings of squares about the place are looked at until no nearer entry can be farther out.
// O(entries in the rings).

#include "cam/toolpath/pass_order.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr std::size_t entries_of_closed = 16;

}  // namespace

PassOrder::PassOrder(std::span<const Pass> passes)
    : passes_(passes), is_taken_(passes.size(), false), left_(passes.size()) {
    if (passes.empty()) return;
    box_ = {passes[0].points[0].tip, passes[0].points[0].tip};
    for (const Pass& pass : passes) {
        for (const PassPoint& point : pass.points) extend(box_, point.tip);
    }
    const Vec3 size = box_.size();
    side_ = std::max(
        {1.0, std::sqrt(size.x * size.y / static_cast<double>(passes.size())), std::max(size.x, size.y) / 1000});
    columns_ = static_cast<std::ptrdiff_t>(size.x / side_) + 1;
    rows_ = static_cast<std::ptrdiff_t>(size.y / side_) + 1;
    squares_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const std::size_t last = passes[i].points.size() - 1;
        if (!passes[i].is_closed) {
            add(i, 0);
            add(i, last);
            continue;
        }
        const std::size_t step = std::max<std::size_t>(1, last / entries_of_closed);
        for (std::size_t k = 0; k < last; k += step) add(i, k);
    }
}

std::pair<std::ptrdiff_t, std::ptrdiff_t> PassOrder::square_of(Vec3 at) const {
    return {std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((at.x - box_.min.x) / side_), 0, columns_ - 1),
            std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((at.y - box_.min.y) / side_), 0, rows_ - 1)};
}

void PassOrder::add(std::size_t pass, std::size_t point) {
    const Vec3 at = passes_[pass].points[point].tip;
    const auto [column, row] = square_of(at);
    squares_[static_cast<std::size_t>(row * columns_ + column)].push_back({{pass, point}, at});
}

void PassOrder::look_at(std::ptrdiff_t column, std::ptrdiff_t row, Vec3 from, double& least, const Entry*& nearest) {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
    std::vector<Entry>& entries = squares_[static_cast<std::size_t>(row * columns_ + column)];
    std::erase_if(entries, [&](const Entry& entry) { return is_taken_[entry.entry.pass]; });
    for (const Entry& entry : entries) {
        const double distance = std::hypot(entry.at.x - from.x, entry.at.y - from.y);
        const bool is_first = nearest != nullptr && distance == least && entry.entry.pass < nearest->entry.pass;
        if (distance >= least && !is_first) continue;
        least = distance;
        nearest = &entry;
    }
}

std::optional<PassEntry> PassOrder::take_nearest(Vec3 from) {
    if (left_ == 0) return std::nullopt;
    const auto [column, row] = square_of(from);
    double least = std::numeric_limits<double>::infinity();
    const Entry* nearest = nullptr;
    // A place beside the box is nearer to the squares of its own rim than the rings tell: its distance is added.
    const Vec3 inside{std::clamp(from.x, box_.min.x, box_.max.x), std::clamp(from.y, box_.min.y, box_.max.y), 0};
    for (std::ptrdiff_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
        const double beyond = static_cast<double>(ring - 1) * side_;
        if (nearest != nullptr && beyond > least + std::hypot(inside.x - from.x, inside.y - from.y)) break;
        for (std::ptrdiff_t k = -ring; k <= ring; ++k) {
            look_at(column + k, row - ring, from, least, nearest);
            if (ring > 0) look_at(column + k, row + ring, from, least, nearest);
            if (std::abs(k) == ring) continue;
            look_at(column - ring, row + k, from, least, nearest);
            look_at(column + ring, row + k, from, least, nearest);
        }
    }
    assert(nearest != nullptr);
    const PassEntry taken = nearest->entry;
    is_taken_[taken.pass] = true;
    --left_;
    return taken;
}

Pass begun_at(const Pass& pass, std::size_t point) {
    Pass begun = pass;
    if (pass.is_closed) {
        begun.points.pop_back();
        std::rotate(begun.points.begin(), begun.points.begin() + static_cast<std::ptrdiff_t>(point),
                    begun.points.end());
        begun.points.push_back(begun.points.front());
    } else if (point > 0) {
        std::reverse(begun.points.begin(), begun.points.end());
    }
    return begun;
}

}  // namespace qchopper
