// Welds, then counts by points (links.h) and by shells (shells.h, containment.h). O(n log n) in the triangles apart
// from the search for self-intersections and the repair that is tried where anything is wrong; the mesh is not copied.

#include "segment/import/inspect.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/connectivity/links.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/repair/fragments.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/repair/open_components.h"
#include "segment/repair/repair.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

constexpr std::size_t max_places = 10;
constexpr std::size_t max_solids = 100;
constexpr double places_apart = 0.01;  // of the diagonal

// One inspection of one mesh.
class Inspecting {
 public:
    Inspecting(RawMesh scan, const InspectOptions& options, const Context& context)
        : options_(options), context_(context), mesh_(std::move(scan.mesh)) {
        mesh_.cap_of = {};
        result_.format = scan.format;
        result_.mm_per_unit = scan.mm_per_unit;
        result_.warnings = std::move(scan.warnings);
        result_.faces_in_file = scan.faces_in_file;
        result_.faces_without_area = scan.faces_without_area;
        result_.welded = scan.welded;
        result_.points_in_file = mesh_.points.size() + scan.welded;
        result_.triangles_in_file = mesh_.triangles.size();
    }

    Inspection inspect() {
        step("points welded");
        add_collapsed_places(result_.places, mesh_);
        const WeldCounts counts = weld(mesh_);
        result_.welded += counts.welded;
        result_.collapsed = counts.collapsed;
        result_.unreferenced = counts.unreferenced;
        result_.triangles = mesh_.triangles.size();
        result_.vertices = mesh_.points.size();
        step("edges counted");
        count_edges();
        step("shells counted");
        count_shells();
        if (options_.deep) find_self_intersections();
        if (!is_solid()) ask_repair();
        return std::move(result_);
    }

 private:
    void step(const char* what) {
        context_.check_cancelled();
        context_.progress(what, ++steps_, 4);
    }

    // Whether there is nothing to repair but surfaces that touch in points.
    bool is_solid() const {
        return result_.is_closed() && result_.repeated + result_.degenerate + result_.inside_out == 0 &&
               result_.volume > 0;
    }

    // By the same steps as the import: what counts as a solid is decided there alone.
    void ask_repair() {
        step("repair tried");
        result_.refused = refusal_of(repair(std::move(mesh_), {}, context_).report);
    }

    void find_self_intersections() {
        const SelfIntersections found = self_intersections(mesh_, {}, context_);
        SelfIntersected result;
        result.pairs = found.pairs.size();
        result.is_complete = found.is_complete;
        const double apart = places_apart * norm(result_.box.size());
        std::vector<Vec3> places;
        for (const auto& pair : found.pairs) {
            if (places.size() == max_places_of_kind) break;
            const Vec3 place = meeting_place(mesh_, pair);
            const bool is_near =
                std::any_of(places.begin(), places.end(), [&](Vec3 other) { return norm(place - other) < apart; });
            if (!is_near) places.push_back(place);
        }
        add_places(result_.places, "self_intersections", places.size(), [&](std::size_t i) { return places[i]; });
        places.resize(std::min(places.size(), max_places));
        result.places = std::move(places);
        result_.self_intersected = std::move(result);
    }

    void count_edges() {
        links_ = links(mesh_);
        result_.open_edges = links_.faults.open;
        result_.inconsistent = links_.faults.inconsistent;
        result_.non_manifold = links_.faults.non_manifold;
        const std::vector<IrregularEdge> edges = irregular_edges(mesh_, links_);
        result_.touching = static_cast<std::size_t>(
            std::count_if(edges.begin(), edges.end(), std::mem_fn(&IrregularEdge::is_touching)));
        result_.non_manifold_vertices = links_.extra_fans.size();
        result_.repeated = links_.repeated;
        add_link_places(result_.places, mesh_, links_, edges);
        // As in repair, surfaces that only touch in points are two shells; not in a mesh with non-manifold edges, which
        // would fall into pieces.
        if (result_.non_manifold + result_.inconsistent == 0) split_fans(mesh_, links_.extra_fans);
        links_.extra_fans = {};
        loops_ = border_loops(mesh_, links_.open);
        for (const std::span<const std::uint32_t> loop : loops_) {
            BorderLoop hole{centre_of(mesh_, loop), loop.size(), 0};
            for (const std::uint32_t h : loop) {
                hole.length += norm(mesh_.points[end_of(mesh_, h)] - mesh_.points[start_of(mesh_, h)]);
            }
            result_.holes.push_back(hole);
        }
        add_places(result_.places, "holes", result_.holes.size(),
                   [&](std::size_t i) { return result_.holes[i].centre; });
    }

    // Of shells: the centres of their boxes.
    void add_shell_places(const char* kind, const std::vector<std::size_t>& found) {
        add_places(result_.places, kind, found.size(),
                   [&](std::size_t i) { return 0.5 * (shells_.box[found[i]].min + shells_.box[found[i]].max); });
    }

    void count_shells() {
        shells_ = shells(mesh_);
        result_.shells = shells_.count();
        if (result_.shells == 0) return;
        result_.box = shells_.box[0];
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            result_.volume += shells_.volume[s];
            extend(result_.box, shells_.box[s].min);
            extend(result_.box, shells_.box[s].max);
        }
        area_.assign(shells_.count(), 0);
        std::vector<std::uint32_t> degenerate;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const double area = norm(area_vector(mesh_, t));
            if (area == 0) degenerate.push_back(static_cast<std::uint32_t>(t));
            area_[shells_.shell_of[t]] += area;
        }
        for (const double area : area_) result_.area += area;
        result_.degenerate = degenerate.size();
        add_face_places(result_.places, "faces_without_area", mesh_, degenerate);
        is_open_.assign(shells_.count(), false);
        for (const std::vector<std::uint32_t>* half_edges : {&links_.open, &links_.non_manifold}) {
            for (const std::uint32_t h : *half_edges) is_open_[shells_.shell_of[h / 3]] = true;
        }
        find_cavities();
        find_open_components();
    }

    // Closed shells of negative volume are cavities if other shells are around them, otherwise inside out. The volume
    // of a solid is that of its outer shell without that of its cavities.
    void find_cavities() {
        std::vector<bool> is_negative(shells_.count());
        double whole = 0;
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            is_negative[s] = !is_open_[s] && shells_.volume[s] < 0;
            if (!is_open_[s]) whole += shells_.volume[s];
        }
        std::vector<double> of_solid = shells_.volume;
        std::vector<double> area_of_solid = area_;
        std::vector<bool> is_solid = is_open_;
        is_solid.flip();
        std::vector<std::size_t> cavities;
        std::vector<std::size_t> inside_out;
        std::vector<std::size_t> fragments;
        const IndexLists around = shells_around(mesh_, shells_, is_negative);
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            if (!is_negative[s]) continue;
            if (around[s].empty()) {
                inside_out.push_back(s);
                of_solid[s] = -of_solid[s];
                whole += 2 * of_solid[s];
                continue;
            }
            cavities.push_back(s);
            is_solid[s] = false;
            const std::uint32_t outer = *std::min_element(around[s].begin(), around[s].end(), [&](auto a, auto b) {
                return std::abs(shells_.volume[a]) < std::abs(shells_.volume[b]);
            });
            of_solid[outer] += shells_.volume[s];
            area_of_solid[outer] += area_[s];
        }
        note_solids(is_solid, of_solid);
        double area = 0;
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            if (!is_solid[s] || !(of_solid[s] < fragment_share * whole)) continue;
            fragments.push_back(s);
            area += area_of_solid[s];
        }
        if (result_.area > 0) result_.fragment_area_share = area / result_.area;
        result_.cavities = cavities.size();
        result_.inside_out = inside_out.size();
        result_.fragments = fragments.size();
        add_shell_places("cavities", cavities);
        add_shell_places("inside_out", inside_out);
        add_shell_places("fragments", fragments);
    }

    void note_solids(const std::vector<bool>& is_solid, const std::vector<double>& volume) {
        std::vector<std::size_t> solids;
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            if (is_solid[s]) solids.push_back(s);
        }
        std::ranges::stable_sort(solids, [&](std::size_t a, std::size_t b) { return volume[a] > volume[b]; });
        result_.solid_count = solids.size();
        solids.resize(std::min(solids.size(), max_solids));
        std::vector<std::size_t> faces(shells_.count());
        for (const std::uint32_t shell : shells_.shell_of) ++faces[shell];
        for (const std::size_t s : solids) {
            result_.solids.push_back({volume[s], faces[s], 0.5 * (shells_.box[s].min + shells_.box[s].max)});
        }
    }

    // The area of a hole is that of its loop projected along its mean normal: no fill is smaller.
    void find_open_components() {
        std::vector<double> lids(shells_.count());
        for (const std::span<const std::uint32_t> loop : loops_) {
            const Vec3 origin = mesh_.points[start_of(mesh_, loop[0])];
            Vec3 sum;
            for (const std::uint32_t h : loop) {
                sum = sum + cross(mesh_.points[start_of(mesh_, h)] - origin, mesh_.points[end_of(mesh_, h)] - origin);
            }
            lids[shells_.shell_of[loop[0] / 3]] += 0.5 * norm(sum);
        }
        double area = 0;
        std::vector<std::size_t> open_components;
        for (std::size_t s = 0; s < shells_.count(); ++s) {
            if (!(lids[s] > max_fill_of_surface * area_[s])) continue;
            open_components.push_back(s);
            area += area_[s];
        }
        if (result_.area > 0) result_.open_component_area_share = area / result_.area;
        result_.open_components = open_components.size();
        add_shell_places("open_components", open_components);
    }

    const InspectOptions& options_;
    const Context& context_;
    std::size_t steps_ = 0;
    TriangleMesh mesh_;
    Inspection result_;
    Links links_;
    IndexLists loops_;
    Shells shells_;
    std::vector<double> area_;   // per shell
    std::vector<bool> is_open_;  // per shell: it has an open or non-manifold edge
};

// How lengths are written beside the longest of them.
struct LengthFormat {
    const char* unit;
    double mm;
    int decimals;  // three digits for the longest
};

LengthFormat format_for(double longest_mm) {
    const auto in = [&](const char* unit, double mm) {
        const double value = longest_mm / mm;
        return LengthFormat{unit, mm, value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2};
    };
    if (longest_mm >= 999.5) return in("m", 1000);
    return longest_mm >= 99.95 ? in("cm", 10) : in("mm", 1);
}

std::string describe(double mm, const LengthFormat& format) {
    return fixed(mm / format.mm, format.decimals) + " " + format.unit;
}

}  // namespace

const BorderLoop* Inspection::longest_hole() const {
    const auto longest = std::max_element(holes.begin(), holes.end(),
                                          [](const BorderLoop& a, const BorderLoop& b) { return a.length < b.length; });
    return longest == holes.end() ? nullptr : &*longest;
}

Inspection inspect(RawMesh scan, const InspectOptions& options, const Context& context) {
    return Inspecting(std::move(scan), options, context).inspect();
}

Judgement judge(const Inspection& i) {
    Judgement judgement;
    if (i.refused) {
        const std::string& why = i.refused->why;
        std::string sentence = why.starts_with(": ") ? why.substr(2) : "It" + why;
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
        return {Verdict::unrepairable, {sentence + ": " + i.refused->to_do + "."}};
    }
    const auto note = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) judgement.reasons.push_back(counted(count, one, many));
    };
    const auto add = [&](std::size_t count, const char* one, const char* many) {
        note(count, one, many);
        if (count > 0) judgement.verdict = Verdict::to_repair;
    };
    note(i.collapsed, "face is collapsed to a line or point and dropped.",
         "faces are collapsed to a line or point and dropped.");
    note(i.touching, "edge where solids only touch is split.", "edges where solids only touch are split.");
    note(i.non_manifold_vertices, "point where surfaces only touch is split.",
         "points where surfaces only touch are split.");
    add(i.repeated, "face lies on another one and is dropped.", "faces lie on others and are dropped.");
    add(i.non_manifold - std::min(i.non_manifold, i.touching), "edge of more than two faces is split.",
        "edges of more than two faces are split.");
    add(i.inconsistent, "edge has faces of opposite orientation, which are turned.",
        "edges have faces of opposite orientation, which are turned.");
    add(i.degenerate, "face has no area and is removed.", "faces have no area and are removed.");
    add(i.open_components, "open component is stitched to what it meets, or dropped.",
        "open components are stitched to what they meet, or dropped.");
    add(i.holes.size() - std::min(i.holes.size(), i.open_components), "hole is closed.", "holes are closed.");
    add(i.inside_out, "shell is inside out and turned.", "shells are inside out and turned.");
    if (i.self_intersected && i.self_intersected->pairs > 0) {
        judgement.reasons.push_back(counted(i.self_intersected->pairs, "pair of faces runs", "pairs of faces run") +
                                    " through each other; repair resolves places that are small.");
        judgement.verdict = Verdict::to_repair;
    }
    return judgement;
}

std::string describe_size(Vec3 size_mm) {
    const LengthFormat format = format_for(std::max({size_mm.x, size_mm.y, size_mm.z}));
    return describe(size_mm.x, format) + " x " + describe(size_mm.y, format) + " x " + describe(size_mm.z, format);
}

}  // namespace qchopper
