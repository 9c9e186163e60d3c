// Steps of 1, 2 and 5 times a power of ten. O(ticks).

#include "segment/picture/axis.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace qchopper {

std::string Ticks::text(double value) const {
    if (!is_logarithmic) return fixed(value, decimals);
    return fixed(value, std::clamp(static_cast<int>(std::ceil(-std::log10(value) - 1e-9)), 0, decimals));
}

namespace {

Ticks multiples(PlotRange range, double step) {
    Ticks result;
    result.decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
    const double first = std::ceil(range.low / step - 1e-9);
    const double last = std::floor(range.high / step + 1e-9);
    for (int i = 0; i <= std::min(last - first, 50.0); ++i) result.values.push_back((first + i) * step);
    return result;
}

}  // namespace

Ticks ticks(PlotRange range, int wanted) {
    const double rough = (range.high - range.low) / wanted;
    const double ten = std::pow(10.0, std::floor(std::log10(rough)));
    Ticks result;
    for (const double step : {10 * ten, 5 * ten, 2 * ten, ten}) {
        if (result.values.size() < 2 || step >= rough * 0.99) result = multiples(range, step);
    }
    return result;
}

Ticks decades(PlotRange range) {
    const double span = std::log10(range.high / range.low);
    Ticks result;
    result.is_logarithmic = true;
    const int first = static_cast<int>(std::floor(std::log10(range.low)));
    const int last = static_cast<int>(std::ceil(std::log10(range.high)));
    const int stride = std::max(1, (last - first) / 5);
    for (int power = first; power <= last; ++power) {
        for (const double times : {1.0, 2.0, 5.0}) {
            const double value = times * std::pow(10.0, power);
            const bool is_wanted = times == 1.0 ? (power - first) % stride == 0 : span < 1.5;
            if (is_wanted && value >= range.low && value <= range.high) result.values.push_back(value);
        }
    }
    result.decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(range.low))), 0, 12);
    return result;
}

PlotRange drawable_range(PlotRange range) {
    if (!std::isfinite(range.high - range.low) || range.low > range.high) return {0, 1};
    const double least = 1e-9 * std::max({std::abs(range.low), std::abs(range.high), 1e-6});
    if (range.high - range.low > least) return range;
    const double margin = std::max(std::abs(range.low) * 0.1, 0.5);
    return {range.low - margin, range.high + margin};
}

}  // namespace qchopper
