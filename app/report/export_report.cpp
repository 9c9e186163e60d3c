// Text and JSON from a value.

#include "app/report/export_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "app/report/segment_report.h"
#include "app/store/project_lines.h"
#include "base/text.h"

namespace qchopper {

using Json = nlohmann::ordered_json;

std::vector<std::string> warnings(const ExportedProject& exported, const ExportRequest& request,
                                  const Project& project) {
    std::vector<std::string> text;
    if (!request.piece && !project.fragment_list.empty()) {
        text.push_back(fragments_line(project) + ": not exported, because they are too small to be pieces");
    }
    for (const ExportedPiece& row : exported.pieces) {
        if (row.simplified.is_by_queue) {
            text.push_back("piece " + row.piece.name +
                           " took longer: passes of collapses kept too many faces, so it was simplified by a queue");
        }
        if (!row.simplified.has_too_many_faces) continue;
        text.push_back("piece " + row.piece.name + " keeps " + with_commas(row.simplified.faces_after) +
                       " faces, more than " + with_commas(*request.max_faces) + ": " +
                       with_commas(row.simplified.cap_faces) + " are caps, which stay as they are");
    }
    return text;
}

std::vector<std::string> lines(const ExportedProject& exported, const Project& project) {
    std::vector<std::vector<std::string>> cells{{"piece", "faces"}};
    if (exported.is_simplified) cells[0].insert(cells[0].end(), {"before", "distance (mm)"});
    cells[0].push_back("file");
    for (const ExportedPiece& row : exported.pieces) {
        cells.push_back({row.piece.name, with_commas(row.piece.mesh->triangles.size())});
        if (exported.is_simplified) {
            cells.back().push_back(with_commas(row.simplified.faces_before));
            cells.back().push_back(fixed(row.simplified.deviation(), 4));
        }
        cells.back().push_back(row.file.string());
    }
    std::vector<std::string> text = columns(cells);
    for (const std::string& line : discarded_lines(project)) text.push_back(line);
    return text;
}

Document document(const ExportedProject& exported, const ExportRequest& request, const Project& project,
                  const std::filesystem::path& folder) {
    Json pieces = Json::array();
    for (const ExportedPiece& row : exported.pieces) {
        Json piece{{"piece", row.piece.name},
                   {"file", row.file.string()},
                   {"faces", row.piece.mesh->triangles.size()},
                   {"cut", row.piece.step},
                   {"fits", row.piece.fits ? Json(*row.piece.fits) : Json()}};
        if (exported.is_simplified) {
            piece["simplified"] = {
                {"faces_before", row.simplified.faces_before}, {"cap_faces", row.simplified.cap_faces},
                {"from_piece_mm", row.simplified.from_piece},  {"from_result_mm", row.simplified.from_result},
                {"crossings", row.simplified.crossings},       {"by_queue", row.simplified.is_by_queue}};
        }
        pieces.push_back(std::move(piece));
    }
    return compose({{"schema", "qchopper-export-1"},
                    {"project", folder.string()},
                    {"format", request.format},
                    {"pose", request.pose},
                    {"units", request.format == "glb" ? "m" : "mm"},
                    {"output", exported.out.string()},
                    {"centre_mm", json_of(project.scan.centre)},
                    {"pieces", pieces},
                    {"fragments", project.fragment_list.size()},
                    {"discarded", discarded_json(project)}});
}

}  // namespace qchopper
