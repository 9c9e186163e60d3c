// The register map as declarations of IEC 61131-3 structured text: docs/user/cell-integration.st.

#pragma once

#include <string>

namespace qchopper {

std::string print_structured_text();

}  // namespace qchopper
