// The JSON schema of a verdict (job_verdict.h), made from its tables (base/json_schema.h;
// tests/app/jobs/job_verdict_test.cpp).

#pragma once

#include <string>

namespace qchopper {

std::string verdict_schema();

}  // namespace qchopper
