// The models of the tables: scans and samples, scaled to one metre.
//
// Millimetres.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "segment/mesh/triangle_mesh.h"
#include "segment/sample/sample.h"

namespace qchopper::bench {

struct TableModel {
    std::string name;
    std::string file;  // empty: the specimen
    std::optional<Specimen> specimen;
};

// The cheapest first.
const std::vector<TableModel>& table_models();

// Its longest side is 1 m. A specimen has so many faces. Nothing if its file is not there.
std::optional<TriangleMesh> mesh_of(const TableModel& model, const std::filesystem::path& data,
                                    std::size_t specimen_faces);

}  // namespace qchopper::bench
