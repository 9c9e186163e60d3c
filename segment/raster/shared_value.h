// Values that several threads raise or lower at once: the result does not depend on their order.

#pragma once

#include <atomic>

namespace qchopper {

// Sets a value to another one that comes before it, whatever other threads do.
template <class Number, class IsBefore>
void replace_shared(Number& value, Number by, const IsBefore& is_before) {
    const std::atomic_ref<Number> shared(value);
    Number now = shared.load(std::memory_order_relaxed);
    while (is_before(by, now) && !shared.compare_exchange_weak(now, by, std::memory_order_relaxed)) {
    }
}

template <class Number>
void raise_shared(Number& value, Number to) {
    replace_shared(value, to, [](Number a, Number b) { return a > b; });
}

template <class Number>
void lower_shared(Number& value, Number to) {
    replace_shared(value, to, [](Number a, Number b) { return a < b; });
}

}  // namespace qchopper
