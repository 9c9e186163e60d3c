// Lengths are in the unit of the scans, of which nothing is known: with three significant digits.

#include "app/report/fuse_report.h"

#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "base/printable.h"
#include "base/text.h"

namespace qchopper {
namespace {

using Json = nlohmann::ordered_json;

constexpr int digits = 3;

std::string solid_name(std::filesystem::path out) {
    const std::string ending = out.extension().string();
    return out.replace_extension("").string() + "-solid" + ending;
}

}  // namespace

std::vector<std::string> lines(const Fused& fused, const std::filesystem::path& out) {
    const FuseReport& report = fused.report;
    std::vector<std::vector<std::string>> rows{{"scan", "points", "triangles", "pairs", "median distance"}};
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
    text.push_back("Next: qchopper repair " + shell_word(out) + " -o " + shell_word(solid_name(out)));
    return text;
}

Document document(const Fused& fused, const std::filesystem::path& out) {
    const FuseReport& report = fused.report;
    Json scans = Json::array();
    for (const FusedScan& scan : report.scans) {
        Json pose = Json::array();
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 row = scan.pose.row[i];
            pose.push_back({row.x, row.y, row.z, scan.pose.shift[static_cast<int>(i)]});
        }
        scans.push_back({{"file", scan.file},
                         {"points", scan.points},
                         {"triangles", scan.triangles},
                         {"pairs", scan.pairs},
                         {"median_distance", scan.residual},
                         {"fits", scan.fits},
                         {"pose", pose}});
    }
    return compose({{"schema", "qchopper-fuse-1"},
                    {"file", out.string()},
                    {"scans", scans},
                    {"opposite_sign_of_qr", report.is_other_sign},
                    {"rounds", report.rounds},
                    {"median_distance", report.residual},
                    {"spacing", report.spacing},
                    {"voxel", report.voxel},
                    {"faces", fused.mesh.triangles.size()},
                    {"open_edges", report.open_edges},
                    {"shells_left_out", report.shells_left_out}});
}

}  // namespace qchopper
