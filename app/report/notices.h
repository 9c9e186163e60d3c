// Small JSON documents: an error and how far work is (docs/user/troubleshooting.md), a specimen that was made, a
// simulated cell that listens, its faults.

#pragma once

#include <optional>
#include <string>

#include "app/report/document.h"
#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/sample.h"

namespace qchopper {

Document error_document(const std::string& error, const std::string& unchanged, const std::string& to_do,
                        int exit_code);

// What --progress json prints: how far work is, and a line for the operator.
struct ProgressState {
    Progress progress;
    double elapsed_s = 0;
    std::optional<double> left_s;  // as estimated; nothing: not known yet
};
Document document(const ProgressState& state);
enum class NoticeKind { message, warning, error };
Document notice_document(NoticeKind kind, const std::string& line);

// A specimen that was written to a file.
struct WrittenSample {
    std::string specimen;
    std::string file;
    int holes = 0;
    TriangleMesh mesh;  // mm
    DrawnPenGrooves pen_grooves;
};
std::vector<std::string> lines(const WrittenSample& sample);
Document document(const WrittenSample& sample);

// `address`: HOST:PORT.
Document listening_document(const std::string& address);

// The faults that a simulated cell can be told to have.
std::vector<std::string> fault_lines();
Document fault_document();

}  // namespace qchopper
