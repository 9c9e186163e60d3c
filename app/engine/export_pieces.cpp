// Reads the pieces that the project has written, or cuts the scan again; a folder of files is staged and renamed.
// O(faces) beside simplification.

#include "app/engine/export_pieces.h"

#include <algorithm>
#include <cmath>

#include "app/store/project_folder.h"
#include "base/error.h"
#include "base/files/staged_folder.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/shared_progress.h"
#include "base/text.h"
#include "base/timings.h"
#include "segment/io/read_mesh.h"
#include "segment/joint/drill.h"
#include "segment/mesh/measure.h"
#include "segment/picture/picture.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double gap_in_row = 20;  // mm

void check_options(const ExportRequest& a) {
    if (a.simplify_mm && a.max_faces) {
        throw InputError(InputFault::use, "a deviation to simplify by and a number of faces exclude each other",
                         "give one of them");
    }
    if (a.max_distance_mm && !a.max_faces) {
        throw InputError(InputFault::use, "the largest distance limits what a number of faces does, and none is given",
                         Sentence::with_key("max_faces_too", {}, "give the number of faces too"));
    }
    if (a.holes && (a.simplify_mm || a.max_faces)) {
        throw InputError(InputFault::use, "holes cannot be made in simplified pieces", "export twice");
    }
}

bool is_one_file(const ExportRequest& a) {
    return a.piece || holds_many(export_format_named(a.format));
}

// The path of --out, or NAME.3mf, NAME-A.stl, NAME-stl in that folder if it exists, without --out beside the project.
fs::path output_of(const ExportRequest& a, const fs::path& project) {
    const std::string name =
        project.stem().string() + (a.piece ? "-" + *a.piece : "") + (is_one_file(a) ? "." : "-") + a.format;
    std::error_code error;
    if (!a.out) return project.parent_path() / name;
    if (fs::is_directory(*a.out, error)) return *a.out / name;
    fs::path out = without_slash(*a.out);
    if (is_one_file(a) != (out.extension() == "." + a.format)) {
        throw InputError(InputFault::use,
                         is_one_file(a) ? out.string() + " does not end in ." + a.format
                                        : out.string() + " is one file, and of " + a.format + " every piece has one",
                         is_one_file(a)
                             ? Sentence("name a ." + a.format + " file, or a folder that is there")
                             : Sentence::with_key("folder_or_piece", {}, "name a folder to make, or one piece"));
    }
    return out;
}

// The pieces in the project's folder; while the project is being cut there are none, and the scan is cut again. So it
// is for setups, which need the half-spaces.
std::vector<Piece> pieces_of(OpenProject& open, bool with_half_spaces) {
    const Project& project = open.project();
    if (project.stage == Stage::cutting || with_half_spaces) return open.segmentation().pieces;
    std::vector<Piece> pieces;
    for (const SolidRecord& solid : project.pieces) {
        const fs::path file = open.folder() / "pieces" / (solid.name + ".ply");
        Piece piece;
        piece.name = solid.name;
        piece.mesh = std::make_shared<const TriangleMesh>(read_mesh(file).mesh);
        if (piece.mesh->triangles.size() != solid.faces) {
            throw InputError(InputFault::mesh, file.string() + " is not the piece that the project made",
                             "write it again by: qchopper prepare " + shell_word(open.folder()));
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

// Whether the file shows how all pieces are joined.
bool is_animated(const ExportRequest& request) {
    return request.format == "glb" && request.pose == "place" && !request.piece;
}

// Cuts the holes in and adds the moves of the assembly, where they are asked for. `rows` are some of the segmentation's
// pieces.
void add_joints(OpenProject& open, const ExportRequest& request, std::vector<ExportedPiece>& rows,
                const Context& context) {
    if (!request.holes && !is_animated(request)) return;
    const StageTimer stage(context, "joints found");
    const Segmentation& segmentation = open.segmentation();
    const Setups* setups = open.setups();
    const JointSettings settings = joint_settings(setups != nullptr ? &setups->cell() : nullptr);
    const std::vector<PieceJoint> joints = request.holes ? piece_joints(segmentation.pieces, settings, context)
                                                         : contacts_of(segmentation.pieces, settings.min_mm2);
    std::vector<std::vector<AssemblyKey>> keys(segmentation.pieces.size());
    if (is_animated(request)) {
        keys = assembly_keys(assembly_of(segmentation, joints, context), segmentation.pieces.size());
    }
    for (std::size_t i = 0; i < segmentation.pieces.size(); ++i) {
        for (ExportedPiece& row : rows) {
            if (row.piece.name != segmentation.pieces[i].name) continue;
            for (const AssemblyKey& key : keys[i]) row.piece.moves.push_back({key.time_s, key.shift});
            if (!request.holes) continue;
            row.piece.mesh = std::make_shared<const TriangleMesh>(drilled(segmentation.pieces[i], i, joints));
        }
    }
}

// In setup pose unless `setups` is nullptr.
std::vector<ExportedPiece> rows_of(OpenProject& open, const ExportRequest& request, Setups* setups,
                                   const Context& context) {
    StageTimer stage(context, "pieces read");
    const std::vector<Piece> pieces = pieces_of(open, setups != nullptr || request.holes);
    if (setups != nullptr) stage.next("setups chosen");
    std::vector<ExportedPiece> rows;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (request.piece && pieces[i].name != *request.piece) continue;
        ExportedPiece row{exported(pieces[i], i, open.project()), {}, {}};
        if (setups != nullptr) {
            const PlacedSetup& piece_setup = setups->placed(pieces[i]);
            row.piece.pose = piece_setup.setup().piece_in_setup;
            row.piece.fits = piece_setup.fits();
        }
        rows.push_back(std::move(row));
    }
    if (rows.empty()) {
        throw InputError(InputFault::use, "the project has no piece " + request.piece.value_or("at all"),
                         "see its pieces by: qchopper segment " + shell_word(open.folder()));
    }
    return rows;
}

// What --max-faces makes of a piece may not be another shape.
void check_shape(const ExportedPiece& row, double piece_diagonal, const ExportRequest& request) {
    const double limit = request.max_distance_mm.value_or(max_distance_share * piece_diagonal);
    const SimplifyReport& made = row.simplified;
    std::string faults;
    if (made.deviation() > limit) {
        faults = "moves the surface of piece " + row.piece.name + " by up to " + significant(made.deviation(), 3) +
                 " mm, more than " + significant(limit, 3) + " mm" +
                 (request.max_distance_mm ? "" : " (1 % of its diagonal)");
    }
    if (made.crossings > 0) {
        faults += (faults.empty() ? "makes " : ", and makes ") + counted(made.crossings, "pair") +
                  " of faces of piece " + row.piece.name + " run through each other";
    }
    if (faults.empty()) return;
    const double usual = std::min(limit, max_distance_share * piece_diagonal);
    throw InputError(InputFault::use, "simplifying to " + std::to_string(*request.max_faces) + " faces " + faults,
                     Sentence::with_key("simplify_by_deviation", {significant(usual, 2)},
                                        "allow more faces; or simplify by a deviation of " + significant(usual, 2) +
                                            " mm to as few as that allows"));
}

// Pieces on several threads.
void simplify_all(std::vector<ExportedPiece>& rows, const ExportRequest& request, const Context& context) {
    const StageTimer stage(context, "pieces simplified");
    SimplifyOptions options;
    options.tolerance = request.simplify_mm;
    options.max_faces = request.max_faces;
    std::size_t points = 0;
    for (const ExportedPiece& row : rows) points += row.piece.mesh->points.size();
    SharedProgress shared(context, "points removed", points);
    std::vector<double> diagonals(rows.size());
    parallel_for(0, rows.size(), [&](std::size_t i) {
        const Context of_piece = shared.of_part();
        of_piece.check_cancelled();
        TriangleMesh mesh = *rows[i].piece.mesh;
        diagonals[i] = norm(bounds(mesh).size());
        rows[i].simplified = simplify(mesh, options, of_piece);
        rows[i].piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    });
    if (!request.max_faces) return;
    for (std::size_t i = 0; i < rows.size(); ++i) check_shape(rows[i], diagonals[i], request);
}

// The folder appears whole or not at all.
void write_folder(std::vector<ExportedPiece>& rows, ExportFormat format, const std::string& ending, const fs::path& out,
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

void write_all(ExportedProject& exported, const ExportRequest& request, const ExportNotes& notes,
               const Context& context) {
    const StageTimer stage(context, "pieces written");
    const ExportFormat format = export_format_named(request.format);
    if (!is_one_file(request)) return write_folder(exported.pieces, format, request.format, exported.out, context);
    for (ExportedPiece& row : exported.pieces) row.file = exported.out;
    if (!holds_many(format)) return write_file(exported.out, export_file(format, exported.pieces.front().piece));
    std::vector<ExportPiece> pieces;
    for (const ExportedPiece& row : exported.pieces) pieces.push_back(row.piece);
    if (request.pose == "setup" && pieces.size() > 1) stand_in_a_row(pieces, gap_in_row);
    context.check_cancelled();
    write_file(exported.out, export_file(format, pieces, notes));
}

}  // namespace

bool ExportedProject::is_demand_met() const {
    return std::none_of(pieces.begin(), pieces.end(),
                        [](const ExportedPiece& p) { return p.simplified.has_too_many_faces; });
}

ExportedProject export_pieces(OpenProject& project, const ExportRequest& request, const std::string& program_version,
                              const Context& context) {
    check_options(request);
    ExportedProject exported{output_of(request, project.folder()), request.simplify_mm || request.max_faces, {}};
    check_output(exported.out);
    const bool in_setup = request.pose == "setup";
    if (in_setup && project.setups() == nullptr) {
        throw InputError(InputFault::use, project.folder().string() + " has no cell, so its pieces have no setup pose",
                         Sentence::with_key("cell_for_pose", {project.folder().string()},
                                            "give the project a cell, or export in the pose of the scan"));
    }
    exported.pieces = rows_of(project, request, in_setup ? project.setups() : nullptr, context);
    add_joints(project, request, exported.pieces, context);
    if (exported.is_simplified) simplify_all(exported.pieces, request, context);
    const ScanSource& scan = project.project().scan;
    const ExportNotes notes{project.folder().stem().string(), program_version, scan.sha256, scan.centre};
    write_all(exported, request, notes, context);
    return exported;
}

}  // namespace qchopper
