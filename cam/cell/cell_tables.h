// Reads the tables of a cell file; read_cell.cpp puts them together.
//
// Every reader throws InputError (config) for an impossible value: file, line, key, why. Readers of tables with origins
// add one row per value to `origins`.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/toml_reader.h"
#include "base/units.h"
#include "cam/cell/cell.h"
#include "cam/cell/cell_keys.h"

namespace qchopper {

using Origins = std::vector<ValueOrigin>;

constexpr double smallest = 0.001;    // mm; lengths on the wire and in files are rounded to 0.001 to 0.01 mm
constexpr double farthest_2 = 5'000;  // mm; a coordinate that is larger is in a wrong unit

// Adds a row for each value that the table gives. `name` is the table's name in the rows.
void add_origins(const TomlReader& reader, const TableKeys& table, const std::string& name, Origins& origins);
// Adds a row for each of these keys that the table does not give.
void add_defaults(const TomlReader& reader, Keys keys, const std::string& name, Origins& origins);

// From the keys position (mm) and abc_deg: rotation Rz(A) Ry(B) Rx(C).
Pose read_pose(const TomlReader& reader);

// Of the cell's outermost table.
Robot read_robot(const TomlReader& root, Origins& origins);
StartPose read_start(const TomlReader& root, const std::optional<Robot>& robot, const Box& workspace);
std::vector<CuttingTool> read_tools(const TomlReader& root, Origins& origins);
// Precondition: at least one tool.
Spindle read_spindle(const TomlReader& root, const std::optional<Robot>& robot, const std::vector<CuttingTool>& tools,
                     Dialect dialect, Origins& origins);
std::optional<Extraction> read_extraction(const TomlReader& root, Dialect dialect);
ProgramSettings read_program(const TomlReader& root, bool has_robot, Origins& origins);
LoadTolerance read_load_tolerance(const TomlReader& root);

}  // namespace qchopper
