// The result of inspect: lines for people and the document of docs/user/inspect.md for programs. O(holes).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report/document.h"
#include "segment/import/inspect.h"

namespace qchopper {

struct InspectedFile {
    std::string name;
    std::optional<std::string> units;  // as given by the operator, or else by the file; nothing: by neither
    const Inspection& inspection;      // outlives this object
};

std::vector<std::string> lines(const InspectedFile& file);
Document document(const InspectedFile& file);

}  // namespace qchopper
