// Small JSON documents: an error (docs/user/troubleshooting.md), a specimen that was made, a simulated cell that
// listens, its faults.

#pragma once

#include <string>

#include "app/report/document.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/sample.h"

namespace qchopper {

Document error_document(const std::string& error, const std::string& unchanged, const std::string& to_do,
                        int exit_code);

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
