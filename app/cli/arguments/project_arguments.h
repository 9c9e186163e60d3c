// Translates checked arguments into the values that app/engine takes.
//
// Precondition: parse_arguments() has checked the values.

#pragma once

#include <optional>
#include <string>

#include "app/cli/arguments/arguments.h"
#include "app/engine/decide.h"
#include "app/engine/presets.h"
#include "app/store/project_scan.h"

namespace qchopper {

// The stop rules that are given, which replace all earlier ones but max_cuts; nothing if none is given.
std::optional<StopRules> given_rules(const ProjectArguments& arguments);

// Of a new project, without a plan. `preset_if_none` is taken where the operator names no preset; empty: none.
ProjectChoices choices_of(const ProjectArguments& arguments, const std::string& preset_if_none = default_preset);

ProjectRequest request_of(const SegmentArguments& arguments);

// Throws InputError (use) for limits of pen grooves that are not looked for.
ImportOptions import_options_of(const RepairArguments& arguments);

}  // namespace qchopper
