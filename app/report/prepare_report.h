// What prepare tells at its end: a table for people, one JSON document for programs.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "cam/setup/envelope.h"
#include "cam/setup/setup.h"

namespace qchopper {

// How a piece is carved.
struct Carving {
    Setup setup;
    EnvelopeReport envelope;
    std::shared_ptr<const TriangleMesh> keeps_alive;
};

struct PieceReport {
    std::string name;
    std::size_t faces = 0;
    double volume_mm3 = 0;
    Carving carving;
    std::filesystem::path job;  // empty: it does not fit and has none
};

struct PreparedProject {
    std::filesystem::path folder;
    Project project;
    std::vector<PieceReport> pieces;
    bool rules_hold = true;
    bool all_fit() const;
};

std::vector<std::string> table(const PreparedProject& prepared, const Cell& cell);
std::string document(const PreparedProject& prepared, const Cell& cell);

}  // namespace qchopper
