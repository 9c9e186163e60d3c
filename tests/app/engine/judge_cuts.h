// The part of the loop in which setups judge the cuts of a search that has ended, for tests.

#pragma once

#include "app/engine/loop.h"

namespace qchopper {

// Of an OpenProject.
std::optional<SearchEnd> judge_cuts(auto&& project, const Context& context = {},
                                    const std::function<void(const Segmentation&)>& on_decision = {},
                                    const std::optional<TimeLimit>& time_limit = {}) {
    LoopObserver observer;
    observer.on_decision = [&](const Segmentation& saved, LoopStep) {
        if (on_decision) on_decision(saved);
    };
    return run_loop(project, {LoopStep::cut_again, time_limit, {}}, observer, context).end;
}

}  // namespace qchopper
