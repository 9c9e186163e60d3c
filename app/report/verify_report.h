// The answer of verify: a table for people, one JSON document for programs.

#pragma once

#include <string>
#include <vector>

#include "app/dispatch/verify_jobs.h"
#include "app/report/document.h"

namespace qchopper {

bool is_all_positive(const VerifyAnswer& answer);

std::vector<std::string> lines(const VerifyAnswer& answer);
// The document qchopper-verify-1 (tests/app/cli/verify_test.cpp).
Document document(const VerifyAnswer& answer);

}  // namespace qchopper
