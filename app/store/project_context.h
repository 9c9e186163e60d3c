// What long work on a project reports to its caller: progress and messages as any long work, warnings, and what is
// saved.
//
// Functions may be empty; they are called from one thread at a time. The caller may be a terminal or a page in a
// browser.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/sentence.h"

namespace qchopper {

struct ProjectContext : Context {
    std::function<void(const Sentence&)> on_warning;  // one line
    // One sentence about what is on disk from now on, for the message of an error that follows.
    std::function<void(const Sentence&)> on_saved;

    void warn(const std::vector<std::string>& lines) const {
        if (!on_warning) return;
        for (const std::string& line : lines) on_warning(line);
    }
    void warn(const Sentence& line) const {
        if (on_warning) on_warning(line);
    }
    void saved(const Sentence& sentence) const {
        if (on_saved) on_saved(sentence);
    }
};

}  // namespace qchopper
