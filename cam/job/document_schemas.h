// JSON schemas of the documents in a job file, made from the tables by which they are written and read.
//
// docs/developer/formats holds them for programs that read jobs: manifest.schema.json, envelope.schema.json and
// ticket.schema.json are these texts, and the grammar in job-folder.md has their keys
// (tests/cam/job/document_schema_test.cpp). base/json_schema.h says what a schema leaves to the reader.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cam/cell/material.h"

namespace qchopper {

std::string manifest_schema();
std::string envelope_schema();
std::string ticket_schema();  // of the template, without what dispatch adds

// The words of materials.
void put_schema(nlohmann::ordered_json& at, Material material);

}  // namespace qchopper
