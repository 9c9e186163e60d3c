// Lengths are in the unit of the scans, of which nothing is known: with three significant digits.

#include "app/report/scan/fuse_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr int digits = 3;
constexpr double most_missing = 0.1;  // of more repair makes no solid

// What the document says beside the report itself.
struct WrittenMesh {
    const Fused& fused;
    std::string file;
};

std::string solid_name(std::filesystem::path out) {
    const std::string ending = out.extension().string();
    return out.replace_extension("").string() + "-solid" + ending;
}

std::vector<std::vector<double>> matrix_of(const Pose& pose) {
    std::vector<std::vector<double>> rows;
    for (int i = 0; i < 3; ++i) {
        const Vec3 row = pose.row[static_cast<std::size_t>(i)];
        rows.push_back({row.x, row.y, row.z, pose.shift[i]});
    }
    return rows;
}

}  // namespace

template <class V, Of<FusedScan> T>
void fields(V& v, T& scan) {
    v("file", scan.file);
    v("points", scan.points);
    v("triangles", scan.triangles);
    v("pairs", scan.pairs);
    v("median_distance", scan.residual);
    v("fits", scan.fits);
    v.written("pose", [&] { return matrix_of(scan.pose); });
}

namespace {

template <class V, Of<WrittenMesh> T>
void fields(V& v, T& mesh) {
    const FuseReport& report = mesh.fused.report;
    v.constant("schema", "qchopper-fuse-1", "");
    v("file", mesh.file);
    v("scans", report.scans);
    v("opposite_sign_of_qr", report.is_other_sign);
    v("rounds", report.rounds);
    v("median_distance", report.residual);
    v("spacing", report.spacing);
    v("voxel", report.voxel);
    v.written("faces", [&] { return mesh.fused.mesh.triangles.size(); });
    v("open_edges", report.open_edges);
    v("missing_share", report.missing_share);
    v("shells_left_out", report.shells_left_out);
}

}  // namespace

std::vector<std::string> lines(const Fused& fused, const std::filesystem::path& out) {
    const FuseReport& report = fused.report;
    std::vector<std::vector<std::string>> rows{{"range scan", "points", "triangles", "pairs", "median distance"}};
    for (const FusedScan& scan : report.scans) {
        rows.push_back({printable(scan.file), with_commas(scan.points), with_commas(scan.triangles),
                        with_commas(scan.pairs),
                        significant(scan.residual, digits) + (scan.fits ? "" : "  does not fit: look at its pose")});
    }
    std::vector<std::string> text = columns(rows);
    text.push_back("Lengths are in the unit of the scans. Aligned in " + counted(report.rounds, "round") +
                   ": the median distance of paired points is " + significant(report.residual, digits));
    if (report.is_other_sign) text.emplace_back("The scans lie together with the opposite sign of qr");
    text.push_back(printable(out.string()) + ": " + with_commas(fused.mesh.triangles.size()) + " faces, voxel " +
                   significant(report.voxel, digits) + ", " + counted(report.open_edges, "open edge") +
                   (report.shells_left_out > 0 ? ", " + counted(report.shells_left_out, "small shell") + " left out"
                                               : std::string()));
    if (report.missing_share > most_missing) {
        text.push_back("The scans do not go around the specimen: closing the mesh takes at least " +
                       fixed(100 * report.missing_share, 0) + " % of its area. Scan the other sides too");
        text.push_back("Next: qchopper inspect " + shell_word(out));
    } else {
        text.push_back("Next: qchopper repair " + shell_word(out) + " -o " + shell_word(solid_name(out)));
    }
    return text;
}

Document document(const Fused& fused, const std::filesystem::path& out) {
    return compose(json_of(WrittenMesh{fused, out.string()}));
}

}  // namespace qchopper
