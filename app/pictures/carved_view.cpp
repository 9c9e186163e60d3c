// Ranges of the deviation travel through the clustering as caps, of which it keeps faces of different ones apart.
// O(triangles + points * log(points) * doublings of the tolerance).

#include "app/pictures/carved_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "app/pictures/deviation_colours.h"
#include "segment/io/write_coloured_glb.h"
#include "segment/simplify/vertex_clustering.h"

namespace qchopper {
namespace {

constexpr double first_tolerance = 0.02;  // mm

double linear(std::uint8_t channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

GlbColour glb_colour(std::string name, Rgb colour) {
    return {std::move(name), {linear(colour.r), linear(colour.g), linear(colour.b)}};
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double length_2 = dot(along, along);
    const double t = length_2 > 0 ? std::clamp(dot(p - a, along) / length_2, 0.0, 1.0) : 0.0;
    return norm(p - (a + t * along));
}

std::size_t count_points(const std::vector<OrientationPath>& paths) {
    std::size_t count = 0;
    for (const OrientationPath& path : paths) {
        for (const std::vector<Vec3>& line : path.lines) count += line.size();
    }
    return count;
}

// Where even straight lines from end to end are too many, every k-th line stays.
void drop_lines(std::vector<OrientationPath>& paths) {
    const std::size_t keep_one_of = count_points(paths) / carved_view_points + 1;
    std::size_t number = 0;
    for (OrientationPath& path : paths) {
        std::erase_if(path.lines, [&](const std::vector<Vec3>&) { return number++ % keep_one_of != 0; });
    }
}

// Shortens the paths to carved_view_points; the tolerance that it took.
double shorten(std::vector<OrientationPath>& paths) {
    constexpr double largest_tolerance = 20;  // mm
    double tolerance = 0;
    while (count_points(paths) > carved_view_points && tolerance < largest_tolerance) {
        tolerance = tolerance == 0 ? first_tolerance : 2 * tolerance;
        for (OrientationPath& path : paths) {
            for (std::vector<Vec3>& line : path.lines) line = thinned(line, tolerance);
        }
    }
    if (count_points(paths) > carved_view_points) drop_lines(paths);
    // What was thinned before is thinned again, so that the errors add up: 1 + 1/2 + 1/4 + ... of the last tolerance.
    return 2 * tolerance;
}

std::vector<GlbColour> surface_colours() {
    std::vector<GlbColour> colours;
    colours.reserve(deviation_ranges.size() + 1);
    for (const DeviationRange& range : deviation_ranges) colours.push_back(glb_colour(range.name, range.colour));
    colours.push_back(glb_colour("given up", given_up_colour));
    return colours;
}

}  // namespace

std::vector<Vec3> thinned(const std::vector<Vec3>& line, double tolerance) {
    if (line.size() < 3) return line;
    std::vector<bool> stays(line.size(), false);
    stays.front() = stays.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        double farthest = tolerance;
        std::size_t at = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double distance = distance_to_segment(line[i], line[first], line[last]);
            if (distance > farthest) farthest = distance, at = i;
        }
        if (at == 0) continue;
        stays[at] = true;
        open.emplace_back(first, at);
        open.emplace_back(at, last);
    }
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (stays[i]) kept.push_back(line[i]);
    }
    return kept;
}

CarvedView carved_view(const CarvedScene& scene, const Context& context) {
    assert(scene.mesh != nullptr && scene.deviation.size() == scene.mesh->triangles.size());
    TriangleMesh ranged{scene.mesh->points, scene.mesh->triangles, {}};
    for (const std::uint8_t colour : deviation_classes(scene.deviation, scene.is_given_up)) {
        ranged.cap_of.push_back(colour);
    }
    const ClusteredMesh clustered = cluster_to(carved_view_faces, ranged, context);
    std::vector<OrientationPath> paths = scene.paths;
    CarvedView view;
    view.path_tolerance = shorten(paths);
    view.points = count_points(paths);
    view.faces = clustered.mesh.triangles.size();
    view.mesh_shift = clustered.largest_shift;
    std::vector<std::uint8_t> colour_of;
    for (std::size_t t = 0; t < view.faces; ++t)
        colour_of.push_back(static_cast<std::uint8_t>(cap_of(clustered.mesh, t)));
    ColouredGlb glb{scene.generator, "piece as left", &clustered.mesh, colour_of, surface_colours(), {}};
    for (OrientationPath& path : paths) {
        const std::string name = "orientation " + std::to_string(path.orientation + 1);
        glb.lines.push_back({"path/" + name, glb_colour(name, piece_colour(path.orientation)), std::move(path.lines)});
    }
    view.glb = to_glb(glb);
    return view;
}

}  // namespace qchopper
