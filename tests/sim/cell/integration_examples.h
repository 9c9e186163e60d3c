// The worked examples of docs/user/cell-integration.md: each request of a dispatcher as bytes, with its answer.

#pragma once

#include <string>
#include <vector>

#include "base/files/file.h"
#include "devices/wire/codes.h"

namespace qchopper {

struct WorkedRequest {
    std::string title;
    Bytes request;
    Bytes answer;                        // of a read the first bytes only
    AckResult wanted = AckResult::none;  // in ACK_RESULT of STATUS afterwards; none: not a command
};

// From the first read of a new simulated cell to RELEASE. START has a TOKEN that the cell has to give first.
std::vector<WorkedRequest> worked_requests();
constexpr std::uint32_t example_token = 0x12345678;

// As the page shows them, in Markdown.
std::string print_examples();

}  // namespace qchopper
