// Pieces of a project as files for other programs, in place or as they lie in their stock, simplified where asked.

#include "cam/export/export.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/segment_project.h"
#include "app/cli/segment_setups.h"
#include "app/cli/version.h"
#include "app/report/columns.h"
#include "app/report/segment_report.h"
#include "app/report/shell_word.h"
#include "base/staged_folder.h"
#include "base/text.h"
#include "segment/io/read_mesh.h"
#include "segment/picture/picture.h"
#include "segment/simplify/simplify.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double gap_in_row = 20;  // mm

struct Row {
    ExportPiece piece;
    SimplifyReport simplified;
    fs::path file;
};

void check_options(const ExportArguments& a) {
    if (a.simplify_mm && a.max_faces) {
        throw InputError(InputFault::use, "--simplify and --max-faces are two ways to say the same", "say one of them");
    }
}

bool is_one_file(const ExportArguments& a) {
    return a.piece || holds_many(export_format_named(a.format));
}

// What is named, or NAME.3mf, NAME-A.stl, NAME-stl beside the project; in the folder that is named if there is one.
fs::path output_of(const ExportArguments& a, const fs::path& project) {
    const std::string name =
        project.stem().string() + (a.piece ? "-" + *a.piece : "") + (is_one_file(a) ? "." : "-") + a.format;
    std::error_code error;
    if (!a.out) return project.parent_path() / name;
    if (fs::is_directory(*a.out, error)) return *a.out / name;
    const fs::path out = without_slash(*a.out);
    if (is_one_file(a) != (out.extension() == "." + a.format)) {
        throw InputError(InputFault::use,
                         is_one_file(a) ? out.string() + " does not end in ." + a.format
                                        : out.string() + " is one file, and of " + a.format + " every piece has one",
                         is_one_file(a) ? "name a ." + a.format + " file, or a folder that is there"
                                        : "name a folder to make, or one piece by --piece");
    }
    return out;
}

// The pieces as the project's folder has them; else, while it is being cut, the scan is cut again. So it is, too, for
// setups, which want to know the planes.
std::vector<Piece> pieces_of(const fs::path& folder, const Project& project, bool with_bounds, Terminal& terminal) {
    if (project.stage == Stage::cutting || with_bounds) {
        return replay(project, take_in_scan(project, terminal).mesh).pieces;
    }
    std::vector<Piece> pieces;
    for (const SolidRecord& solid : project.pieces) {
        const fs::path file = folder / "pieces" / (solid.name + ".ply");
        Piece piece;
        piece.name = solid.name;
        piece.mesh = std::make_shared<const TriangleMesh>(read_mesh(file).mesh);
        if (piece.mesh->triangles.size() != solid.faces) {
            throw InputError(InputFault::mesh, file.string() + " is not the piece that the project made",
                             "write it again by: qchopper prepare " + shell_word(folder));
        }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

double linear(std::uint8_t srgb) {
    const double c = srgb / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

ExportPiece exported(const Piece& piece, std::size_t place, const Project& project) {
    ExportPiece made;
    made.name = piece.name;
    made.mesh = piece.mesh;
    for (const Cut& cut : project.cuts) {
        if (std::find(cut.pieces.begin(), cut.pieces.end(), piece.name) == cut.pieces.end()) continue;
        made.step = cut.number;
        made.parent = cut.piece;
    }
    const Rgb colour = piece_colour(place);
    made.colour = {linear(colour.r), linear(colour.g), linear(colour.b)};
    return made;
}

// In setup pose where `cell` is known.
std::vector<Row> rows_of(const std::vector<Piece>& pieces, const Project& project, const ExportArguments& a,
                         const std::optional<Cell>& cell) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (a.piece && pieces[i].name != *a.piece) continue;
        Row row;
        row.piece = exported(pieces[i], i, project);
        if (cell) {
            const Setup setup = choose_setup(pieces[i], *cell);
            row.piece.pose = setup.piece_in_setup;
            row.piece.fits = check_envelope(setup, *cell).fits();
        }
        rows.push_back(std::move(row));
    }
    if (rows.empty()) {
        throw InputError(InputFault::use, "the project has no piece " + a.piece.value_or("at all"),
                         "see its pieces by: qchopper segment " + shell_word(a.project));
    }
    return rows;
}

void simplify_all(std::vector<Row>& rows, const ExportArguments& a, Terminal& terminal) {
    if (!a.simplify_mm && !a.max_faces) return;
    SimplifyOptions options;
    options.tolerance = a.simplify_mm;
    options.most_faces = a.max_faces;
    for (Row& row : rows) {
        TriangleMesh mesh = *row.piece.mesh;
        row.simplified = simplify(mesh, options, terminal.context());
        row.piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
        if (row.simplified.has_too_many_faces) {
            terminal.warn("piece " + row.piece.name + " keeps " + with_commas(row.simplified.faces_after) +
                          " faces, more than " + with_commas(*a.max_faces) + ": " +
                          with_commas(row.simplified.cap_faces) + " are caps, which stay as they are");
        }
    }
}

// The folder appears whole or not at all.
void write_folder(std::vector<Row>& rows, ExportFormat format, const std::string& ending, const fs::path& out,
                  const Context& context) {
    try {
        StagedFolder aside(out);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            context.check_cancelled();
            context.progress("pieces written", i, rows.size());
            const std::string name = rows[i].piece.name + "." + ending;
            write_file(aside.path() / name, export_file(format, rows[i].piece));
            rows[i].file = out / name;
        }
        aside.move_to_its_place();
    } catch (const fs::filesystem_error& e) {
        throw InputError(InputFault::create, out.string() + " cannot be made: " + e.code().message(),
                         "choose another place");
    }
}

void write_all(std::vector<Row>& rows, const ExportArguments& a, const fs::path& out, const Project& project,
               const Context& context) {
    const ExportFormat format = export_format_named(a.format);
    if (!is_one_file(a)) return write_folder(rows, format, a.format, out, context);
    for (Row& row : rows) row.file = out;
    if (!holds_many(format)) return write_file(out, export_file(format, rows.front().piece));
    std::vector<ExportPiece> pieces;
    for (const Row& row : rows) pieces.push_back(row.piece);
    if (a.pose == "setup" && pieces.size() > 1) stand_in_a_row(pieces, gap_in_row);
    context.check_cancelled();
    const ExportNotes notes{a.project.stem().string(), version, project.scan.sha256, project.scan.centre};
    write_file(out, export_file(format, pieces, notes));
}

std::vector<std::string> table(const std::vector<Row>& rows, bool is_simplified) {
    std::vector<std::vector<std::string>> cells{{"piece", "faces"}};
    if (is_simplified) cells[0].insert(cells[0].end(), {"before", "farthest (mm)"});
    cells[0].push_back("file");
    for (const Row& row : rows) {
        cells.push_back({row.piece.name, with_commas(row.piece.mesh->triangles.size())});
        if (is_simplified) {
            cells.back().push_back(with_commas(row.simplified.faces_before));
            cells.back().push_back(fixed(row.simplified.deviation(), 4));
        }
        cells.back().push_back(row.file.string());
    }
    return columns(cells);
}

std::string document(const std::vector<Row>& rows, const ExportArguments& a, const fs::path& out,
                     const Project& project) {
    const bool is_simplified = a.simplify_mm || a.max_faces;
    const Vec3 centre = project.scan.centre;
    Json pieces = Json::array();
    for (const Row& row : rows) {
        Json piece{{"piece", row.piece.name},
                   {"file", row.file.string()},
                   {"faces", row.piece.mesh->triangles.size()},
                   {"cut", row.piece.step},
                   {"fits", row.piece.fits ? Json(*row.piece.fits) : Json()}};
        if (is_simplified) {
            piece["simplified"] = {{"faces_before", row.simplified.faces_before},
                                   {"cap_faces", row.simplified.cap_faces},
                                   {"from_piece_mm", row.simplified.from_piece},
                                   {"from_result_mm", row.simplified.from_result}};
        }
        pieces.push_back(std::move(piece));
    }
    return Json{{"schema", "qchopper-export-1"},
                {"project", a.project.string()},
                {"format", a.format},
                {"pose", a.pose},
                {"units", a.format == "glb" ? "m" : "mm"},
                {"output", out.string()},
                {"centre_mm", {centre.x, centre.y, centre.z}},
                {"pieces", pieces},
                {"discarded", discarded_json(project)}}
        .dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

int run(const ExportArguments& arguments, Terminal& terminal) {
    check_options(arguments);
    const fs::path folder = without_slash(arguments.project);
    const Project project = load_project(folder);
    const fs::path out = output_of(arguments, folder);
    check_output(out);
    std::optional<Cell> cell;
    if (arguments.pose == "setup") {
        if (!fs::exists(folder / "cell.toml")) {
            throw InputError(
                InputFault::use, folder.string() + " knows no cell, so nobody knows how its pieces lie",
                "name one by: qchopper segment " + shell_word(folder) + " --cell FILE; or leave --pose out");
        }
        cell = read_cell(folder / "cell.toml");
    }
    std::vector<Row> rows = rows_of(pieces_of(folder, project, cell.has_value(), terminal), project, arguments, cell);
    simplify_all(rows, arguments, terminal);
    write_all(rows, arguments, out, project, terminal.context());
    for (const std::string& line : table(rows, arguments.simplify_mm || arguments.max_faces)) terminal.show(line);
    for (const std::string& line : discarded_lines(project)) terminal.show(line);
    terminal.json(document(rows, arguments, out, project));
    const bool is_met =
        std::none_of(rows.begin(), rows.end(), [](const Row& r) { return r.simplified.has_too_many_faces; });
    return is_met ? exit_done : exit_demand_broken;
}

}  // namespace qchopper
