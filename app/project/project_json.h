// The text of project.json, schema qchopper-project-3; others are refused.

#pragma once

#include <string>
#include <string_view>

#include "app/project/project.h"

namespace qchopper {

std::string to_json(const Project& project);

// Throws InputError (config); `name` is how messages call the file.
Project project_from_json(std::string_view text, const std::string& name);

}  // namespace qchopper
