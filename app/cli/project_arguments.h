// What was typed for a project, as the values that app/project takes.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/cli/arguments.h"
#include "app/project/decide.h"
#include "app/project/project_scan.h"

namespace qchopper {

// The stop rules that were given; they replace all that stood before. Nothing was given: nothing.
std::optional<StopRules> given_rules(const ProjectArguments& arguments);

// Whether anything is said about how the scan becomes a solid.
bool is_any_given(const RepairChoiceArguments& arguments);
RepairChoices repair_choices(const RepairChoiceArguments& arguments);

// Throws InputError (use) if neither the arguments nor the scan say what one unit of it is.
void check_unit(const std::filesystem::path& scan, const ProjectArguments& arguments);

// Of a new project.
ProjectChoices choices_of(const std::filesystem::path& scan, const ProjectArguments& arguments);

// The one thing that is asked of a project, without a change of its weights.
ProjectRequest request_of(const SegmentArguments& arguments);

}  // namespace qchopper
