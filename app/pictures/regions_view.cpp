// O(triangles log triangles) beside the method itself.

#include "app/pictures/regions_view.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <set>

#include "base/error.h"
#include "base/files/file.h"
#include "base/timings.h"
#include "segment/io/write_mesh.h"
#include "segment/picture/two_sides.h"
#include "segment/regions/methods.h"

namespace qchopper {
namespace {

constexpr std::size_t colours = 12;  // those of piece_colour() that differ
constexpr Rgb paper{255, 255, 255};

// Per region the first colour that no region before has which touches it, counted on from the region's number so that
// all colours are used.
std::vector<std::uint8_t> colours_of_regions(const FaceGraph& graph, const Labels& labels) {
    std::vector<std::set<std::uint32_t>> around(labels.count);
    for (const DualEdge& edge : graph.edges) {
        const std::uint32_t a = labels.of[edge.face[0]];
        const std::uint32_t b = labels.of[edge.face[1]];
        if (a != b) around[std::max(a, b)].insert(std::min(a, b));
    }
    std::vector<std::uint8_t> colour(labels.count);
    for (std::uint32_t r = 0; r < labels.count; ++r) {
        const auto is_taken = [&](std::size_t c) {
            return std::ranges::any_of(around[r], [&](std::uint32_t other) { return colour[other] == c; });
        };
        std::size_t c = r % colours;
        for (std::size_t tried = 0; tried < colours && is_taken(c); ++tried) c = (c + 1) % colours;
        colour[r] = static_cast<std::uint8_t>(c);
    }
    return colour;
}

Bytes picture_of(const ScanRegions& regions, const FaceGraph& graph, const std::string& sentence,
                 const Context& context) {
    const std::vector<std::uint8_t> colour = colours_of_regions(graph, regions.labels);
    std::array<Rgb, colours> palette;
    for (std::size_t c = 0; c < colours; ++c) palette[c] = piece_colour(c);
    std::vector<std::uint8_t> of;
    of.reserve(regions.labels.of.size());
    for (const std::uint32_t region : regions.labels.of) of.push_back(colour[region]);
    ColouredMesh mesh;
    mesh.mesh = &regions.copy;
    mesh.palette = palette;
    mesh.colour_of = of;
    return draw_two_sides({&mesh, 1}, std::array{LegendEntry{paper, sentence}}, whole_scan_layout, context);
}

Bytes ply_of(const ScanRegions& regions, const TriangleMesh& scan) {
    const Labels labels = on_scan(regions, scan);
    const std::vector<std::uint8_t> colour = colours_of_regions(face_graph(scan), labels);
    PlyFaces faces;
    faces.region.reserve(labels.of.size());
    faces.colour.reserve(labels.of.size());
    for (const std::uint32_t region : labels.of) {
        const Rgb c = piece_colour(colour[region]);
        faces.region.push_back(region);
        faces.colour.push_back({c.r, c.g, c.b});
    }
    return to_ply(scan, faces);
}

}  // namespace

std::string region_sentence(const std::string& method, std::size_t regions, const RegionPlanes& found) {
    std::string text = method + " finds ";
    if (regions == 1) return text + "one region only, and proposes no plane.";
    text += std::to_string(regions) + " regions and proposes ";
    if (found.planes.empty()) return text + "no plane: their borders are too short or lie on lines.";
    text += std::to_string(found.planes.size()) + (found.planes.size() == 1 ? " plane" : " planes");
    text += " along their borders";
    if (found.beyond > 0) text += ", those of the longest ones; " + std::to_string(found.beyond) + " more are left out";
    return text + ".";
}

ShownRegions show_regions(const TriangleMesh& scan, const RegionsRequest& request, const Context& context) {
    const bool is_picture = request.file.extension() == ".png";
    if (!is_picture && request.file.extension() != ".ply") {
        throw InputError(InputFault::use, request.file.string() + " ends neither in .png nor in .ply",
                         "name a .png file for a picture, a .ply file for the mesh");
    }
    const RegionMethod* method = region_method(request.method);
    assert(method != nullptr);
    StageTimer stage(context, "regions by " + request.method);
    const ScanRegions regions = scan_regions(scan, *method, {}, context);
    const FaceGraph graph = face_graph(regions.copy);
    ShownRegions shown{request.method, regions.labels.count, regions.copy.triangles.size(),
                       region_planes(graph, regions.labels), request.file};
    stage.next("regions drawn");
    const std::string sentence = region_sentence(shown.method, shown.regions, shown.planes);
    write_file(request.file, is_picture ? picture_of(regions, graph, sentence, context) : ply_of(regions, scan));
    return shown;
}

}  // namespace qchopper
