// The person for whom something is sent to a cell: what is asked, and whether there is somebody to answer.

#pragma once

#include <functional>
#include <string>

namespace qchopper {

struct Operator {
    bool can_answer = false;
    // Throws InputError (use) where nobody can answer, and Cancelled if a stop was requested.
    std::function<bool(const std::string& question)> confirm;
};

}  // namespace qchopper
