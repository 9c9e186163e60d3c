// Small JSON documents: an error and how far work is (docs/user/troubleshooting.md), a specimen or a guide that
// was made, a simulated cell that listens, its faults.

#pragma once

#include <optional>
#include <string>

#include "app/guide/write_guide.h"
#include "app/report/document.h"
#include "base/sentence.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/sample.h"

namespace qchopper {

// `to_do` is worded as the command line does; `unchanged` is to be so too.
Document error_document(const std::string& error, const std::string& unchanged, const Sentence& to_do, int exit_code);

// What --progress json prints: how far work is, and a line for the operator.
struct ProgressState {
    std::string progress;  // "planes evaluated"
    std::size_t done = 0;
    std::optional<std::size_t> total;  // nothing: not known
    double elapsed_s = 0;
    std::optional<double> left_s;  // as estimated; nothing: not known yet
};
Document document(const ProgressState& state);
// Of such a line; nothing of any other.
std::optional<ProgressState> read_progress(const std::string& line);

enum class NoticeKind { message, warning, error };
Document notice_document(NoticeKind kind, const std::string& line);
// What such a line says; nothing of any other.
std::optional<std::string> read_notice(const std::string& line);

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

// An assembly guide that was written.
Document document(const WrittenGuide& guide);

// `address`: HOST:PORT.
Document listening_document(const std::string& address);
// The address of that document as it is printed; empty for any other text.
std::string listening_address(const std::string& document);

// A display mesh that was made: its id, and how far it deviates at most, in the units of its file.
Document mesh_document(const std::string& id, double deviation);
// The id of that document as it is printed; empty for any other text.
std::string read_mesh_id(const std::string& document);

// Points of a scan that were asked whether they are painted.
Document painted_document(std::size_t points);

// The faults that a simulated cell can be told to have.
std::vector<std::string> fault_lines();
Document fault_document();

}  // namespace qchopper
