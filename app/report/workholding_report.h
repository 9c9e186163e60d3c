// Whether the setup of a piece is held, in words and as JSON (cam/setup/workholding.h).

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cam/setup/setup.h"

namespace qchopper {

// "yes" or "no"; "-" where it was not checked.
std::string workholding_word(const Setup& setup);

// The figures, and of a piece that is not held what is wrong and what to do.
std::vector<std::string> lines(const Workholding& check);

// As in the manifest (docs/developer/formats/job-folder.md), with `problem` and `remedy`, empty where it is held; null:
// not checked.
nlohmann::ordered_json workholding_json(const Setup& setup);

}  // namespace qchopper
