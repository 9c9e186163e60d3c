// Writes and reads the text of project.json, schema qchopper-project-4 (docs/developer/formats/project-folder.md);
// others are refused.
//
// A project that is written and read again is the same project (tests/app/store/project_test.cpp). O(cuts + pieces).

#pragma once

#include <string>
#include <string_view>

#include "app/store/project.h"
#include "base/enum_names.h"

namespace qchopper {

constexpr auto names_of(Stage) {
    return EnumNames<Stage, 3>{{{Stage::cutting, "cutting"}, {Stage::cut, "cut"}, {Stage::done, "done"}}};
}

std::string to_json(const Project& project);

// `name` is the name of the file in messages. Throws InputError (config) for text that is not JSON, a missing or wrong
// value, and values that contradict each other.
Project project_from_json(std::string_view text, const std::string& name);

// Of that text (base/json_schema.h).
std::string project_schema();

}  // namespace qchopper
