// The answer of verify: a table for people, one JSON document for programs.

#pragma once

#include <string>
#include <vector>

#include "app/project/verify_jobs.h"

namespace qchopper {

bool is_all_positive(const VerifyAnswer& answer);

// The figures that people look at first: "gouge 0.08 mm, 99.81 % within tolerance, 96.2 % reachable".
std::string figures_word(const JobVerdict& verdict);

std::vector<std::string> lines(const VerifyAnswer& answer);
// The document qchopper-verify-1 (tests/app/cli/verify_test.cpp).
std::string document(const VerifyAnswer& answer);

}  // namespace qchopper
