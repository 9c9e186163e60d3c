// Writes and reads the envelope report of a job, envelope.json: every check of every pose that milling needs, with its
// margin, and the tightest pose of each.
//
// Rounded to 1e-6, so that the last digits of sines, which processors differ in, are not seen
// (tests/cam/job/envelope_document_test.cpp). docs/developer/formats/job-folder.md holds the grammar,
// docs/user/envelope.md explains the checks.

#pragma once

#include <string>
#include <string_view>

#include "cam/job/job.h"

namespace qchopper {

// JSON text. Of a cell without a machine it says that the arm was not checked, and has no checks.
std::string envelope_document(const JobInput& input);

// What a reader compares with the manifest.
struct ReachabilitySummary {
    std::string piece;
    bool is_arm_checked = false;
    bool holds = true;
    BlockPlacement placement;
};

// Throws InputError (mesh) naming `source` if a value is missing or of another kind, if a verdict contradicts its
// margin, or if the text is not in the form that envelope_document writes.
ReachabilitySummary read_envelope_document(std::string_view text, const std::string& source);

}  // namespace qchopper
