// What inspect has found, as lines for the operator and as the document of docs/inspect.md.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "segment/import/inspect.h"

namespace qchopper {

struct InspectedFile {
    std::string name;
    std::optional<std::string> units;  // what the operator said, or else the file; nothing: nobody did
    const Inspection& inspection;
};

std::vector<std::string> lines(const InspectedFile& file);
std::string document(const InspectedFile& file);

}  // namespace qchopper
