// Converts values to JSON and back, for project.json and the documents of the commands.
//
// Keys are those of docs/developer/formats/project-folder.md (VECTOR, WEIGHTS, TERMS, SOLID, IGNORED, SETTINGS, CUT).
// The readers throw nlohmann::json::exception for a missing or wrong value, and InputError (config) for an unknown name
// of an enumeration.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/store/project.h"

namespace qchopper {

nlohmann::ordered_json json_of(Vec3 v);
nlohmann::ordered_json json_of(const Weights& weights);
nlohmann::ordered_json json_of(const Terms& terms);
nlohmann::ordered_json json_of(const SolidRecord& solid);  // a fragment has no name
nlohmann::ordered_json json_of(const IgnoredSurface& ignored);
nlohmann::ordered_json json_of(const NoCutSurface& no_cut);
nlohmann::ordered_json json_of(const SymmetryPlane& symmetry);
nlohmann::ordered_json json_of(const SearchSettings& settings);
nlohmann::ordered_json json_of(const Cut& cut);
nlohmann::ordered_json json_of(const CutReview& review);

// What was found on the scan before the first cut: the keys ignored, no_cut and symmetry, where there is something.
void add_scan(nlohmann::ordered_json& document, const Project& project);

Vec3 vec3_from(const nlohmann::ordered_json& json);
Weights weights_from(const nlohmann::ordered_json& json);
SolidRecord solid_from(const nlohmann::ordered_json& json);
SearchSettings settings_from(const nlohmann::ordered_json& json);
Cut cut_from(const nlohmann::ordered_json& json);
CutReview cut_review_from(const nlohmann::ordered_json& json);

// The text of a document, indented by one space a level; bytes that are not UTF-8 are replaced. No line end.
std::string text_of(const nlohmann::ordered_json& document);

}  // namespace qchopper
