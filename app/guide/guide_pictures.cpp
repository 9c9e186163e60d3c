// Every picture is a scene of its own, of the pieces that it shows. O(their triangles + samples).

#include "app/guide/guide_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "cam/job/sheet/solid_shapes.h"
#include "segment/mesh/measure.h"
#include "segment/picture/exploded.h"
#include "segment/picture/film.h"
#include "segment/picture/lettering.h"
#include "segment/picture/picture.h"
#include "segment/picture/scene.h"

namespace qchopper {
namespace {

constexpr Rgb arrow_colour{30, 30, 34};
constexpr Rgb white{255, 255, 255};

PictureOptions options_of(int width, int height) {
    PictureOptions options;
    options.width = width;
    options.height = height;
    options.background = white;
    options.ambient_rays = 0;
    options.letters = 0.028;
    return options;
}

// 1 for the triangles of the cap of this cut, else 0.
std::vector<std::uint8_t> cap_flags(const TriangleMesh& mesh, std::int32_t cut) {
    std::vector<std::uint8_t> flags(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = cap_of(mesh, t) == cut ? 1 : 0;
    return flags;
}

bool has(const std::vector<std::size_t>& sorted, std::size_t value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

// Precondition: there is one.
Box bounds_of(std::span<const Piece> pieces, const std::vector<std::size_t>& which) {
    Box all = bounds(*pieces[which.front()].mesh);
    for (const std::size_t p : which) {
        const Box box = bounds(*pieces[p].mesh);
        extend(all, box.min);
        extend(all, box.max);
    }
    return all;
}

// What a picture shows; colours of triangles stay here while it is drawn.
class StepScene {
 public:
    void add(const Piece& piece, Rgb colour, Vec3 shift, const std::string& name, std::optional<std::int32_t> glued) {
        ColouredMesh mesh{piece.mesh.get(), colour, shift, name, {}, {}};
        if (glued) {
            palettes_.push_back({colour, glue_colour});
            flags_.push_back(cap_flags(*piece.mesh, *glued));
            coloured_.push_back(meshes_.size());
        }
        meshes_.push_back(mesh);
    }
    void add(const TriangleMesh& mesh, Rgb colour) { meshes_.push_back({&mesh, colour, {}, {}, {}, {}}); }

    Pixels draw(const PictureOptions& options, const Context& context) {
        for (std::size_t i = 0; i < coloured_.size(); ++i) {
            meshes_[coloured_[i]].palette = palettes_[i];
            meshes_[coloured_[i]].colour_of = flags_[i];
        }
        return render(Scene(meshes_, false), options, context);
    }

 private:
    std::vector<ColouredMesh> meshes_;
    std::vector<std::array<Rgb, 2>> palettes_;
    std::vector<std::vector<std::uint8_t>> flags_;
    std::vector<std::size_t> coloured_;
};

// Rows of one picture are no progress of many.
Context quiet(const Context& context) {
    Context only_cancelled;
    only_cancelled.cancelled = context.cancelled;
    return only_cancelled;
}

struct SeenSample {
    double x = 0;  // pixels
    double y = 0;
};

// The sample of this cap of the only mesh that is nearest to a point of it; nothing if none is seen.
std::optional<SeenSample> nearest_sample(const Film& film, const Scene& scene, const Camera& camera, std::int32_t cut,
                                         Vec3 point) {
    const Vec3 from_middle = point - camera.origin;
    const double x = static_cast<double>(film.width) / 2 + dot(from_middle, camera.right) / film.mm_per_sample;
    const double y = static_cast<double>(film.height) / 2 - dot(from_middle, camera.up) / film.mm_per_sample;
    std::optional<SeenSample> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < film.height; ++row) {
        for (std::size_t column = 0; column < film.width; ++column) {
            const std::uint64_t seen = film.at(column, row);
            if (seen == Film::nothing || scene.region_of(Film::triangle(seen)).cap != cut) continue;
            const double dx = static_cast<double>(column) + 0.5 - x;
            const double dy = static_cast<double>(row) + 0.5 - y;
            if (dx * dx + dy * dy >= least) continue;
            least = dx * dx + dy * dy;
            best = {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
        }
    }
    return best;
}

}  // namespace

Pixels draw_apart(std::span<const Piece> pieces, GuideSide side, const Context& context) {
    PictureOptions options = options_of(900, 760);
    const Vec3 view = options.view;
    if (side == GuideSide::back) options.view = {-view.x, -view.y, view.z};
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    return render(Scene(coloured(pieces, shifts), false), options, quiet(context));
}

Vec3 view_of_step(Vec3 move) {
    constexpr int azimuths = 64;
    constexpr double wanted = 0.25;  // cosine between view and move
    const double pi = std::acos(-1.0);
    Vec3 best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < azimuths; ++k) {
        const double angle = 2 * pi * (k + 0.35) / azimuths;
        const Vec3 view = normalized({std::cos(angle), std::sin(angle), -0.45});
        const double off = std::abs(dot(view, move) - wanted);
        if (off >= least - 1e-9) continue;
        least = off;
        best = view;
    }
    return best;
}

Pixels draw_step(std::span<const Piece> pieces, const ProjectJoints& joints, const AssemblyStep& step,
                 const Context& context) {
    const Box moved = bounds_of(pieces, step.moved);
    Box whole = bounds_of(pieces, step.standing);
    extend(whole, moved.min);
    extend(whole, moved.max);
    const double size = norm(whole.size());
    const double gap = step.distance_mm + 0.22 * size;
    const Vec3 shift = -gap * step.direction;

    std::vector<std::size_t> touched;
    Vec3 middle = moved.centre();
    if (!step.joints.empty()) middle = {};
    for (const std::size_t j : step.joints) {
        const PieceJoint& joint = joints.joints[j];
        touched.push_back(joint.below);
        touched.push_back(joint.above);
        middle = middle + 1 / static_cast<double>(step.joints.size()) * middle_of(joint.contact, joint.plane);
    }
    std::sort(touched.begin(), touched.end());
    StepScene drawing;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const bool moves = has(step.moved, p);
        if (!moves && !has(step.standing, p)) continue;
        const bool is_touched = has(touched, p);
        drawing.add(pieces[p], moves ? piece_colour(p) : standing_colour, moves ? shift : Vec3{},
                    moves || is_touched ? pieces[p].name : std::string(),
                    is_touched ? std::optional(step.cut) : std::nullopt);
    }
    // From the moved side to the place, within the gap.
    const double length = 0.8 * gap;
    const double radius = 0.012 * size;
    const double head = std::min(0.4 * length, 4 * radius);
    const TriangleMesh arrow =
        turned_profile(middle - 0.9 * gap * step.direction, step.direction,
                       {{0, 0}, {0, radius}, {length - head, radius}, {length - head, 2.4 * radius}, {length, 0}});
    drawing.add(arrow, arrow_colour);
    PictureOptions options = options_of(900, 640);
    options.view = view_of_step(step.direction);
    return drawing.draw(options, quiet(context));
}

DrawnPiece draw_piece(std::span<const Piece> pieces, std::size_t piece, const ProjectJoints& joints, GuideSide side,
                      const Context& context) {
    const TriangleMesh& mesh = *pieces[piece].mesh;
    std::vector<std::uint8_t> flags(mesh.triangles.size(), 0);
    for (const PieceJoint& joint : joints.joints) {
        if (joint.below != piece && joint.above != piece) continue;
        for (std::size_t t = 0; t < flags.size(); ++t) flags[t] |= cap_of(mesh, t) == joint.cut ? 1 : 0;
    }
    const std::array<Rgb, 2> palette{piece_colour(piece), glue_colour};
    const std::array<ColouredMesh, 1> shown{{{&mesh, palette[0], {}, {}, palette, flags}}};
    PictureOptions options = options_of(560, 460);
    if (side == GuideSide::back) options.view = -options.view;
    const Scene scene(shown, false);
    DrawnPiece drawn{render(scene, options, quiet(context)), {}};
    options.supersampling = 1;
    const Camera camera = framed(shown, options);
    const Film film = rasterised(shown, camera, options);
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        const PieceJoint& joint = joints.joints[j];
        if (joint.below != piece && joint.above != piece) continue;
        const std::optional<SeenSample> at =
            nearest_sample(film, scene, camera, joint.cut, middle_of(joint.contact, joint.plane));
        if (!at) continue;
        const std::size_t neighbour = joint.below == piece ? joint.above : joint.below;
        draw_text(drawn.pixels, at->x, at->y, pieces[neighbour].name, 16);
        drawn.seen.push_back(j);
    }
    return drawn;
}

}  // namespace qchopper
