// The texts of the report, made of its counts alone. O(1).

#include "segment/repair/report.h"

#include <cmath>
#include <initializer_list>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double warn_added_share = 0.05;

std::string in_digits(double value) {
    return significant(value, 3);
}

// A count with what it is of; with the count 0 it is left out.
struct Clause {
    std::size_t count = 0;
    std::string one;
    std::string many;
};

// "2 holes closed, 5 faces dropped"
std::string clauses(std::initializer_list<Clause> all) {
    std::string text;
    for (const auto& [count, one, many] : all) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
    }
    return text.empty() ? "nothing to do" : text;
}

std::string fragments(const RepairReport& r) {
    if (r.fragments == 0) return "none";
    return counted(r.fragments, "fragment") + " with " + in_digits(100 * r.fragment_area_share) + " % of the surface " +
           (r.fragments_dropped ? "dropped" : "kept");
}

std::string resolving(const RepairReport& r) {
    if (!r.resolved) return "not asked for";
    if (r.resolved->pairs == 0) return "nothing to do";
    return counted(r.resolved->places, "place") + " repaired, " +
           counted(r.resolved->left, "pair of faces", "pairs of faces") + " left of " +
           std::to_string(r.resolved->pairs) + (r.resolving_undone ? "; undone" : "");
}

std::string smoothing(const RepairReport& r) {
    if (!r.pen_grooves) return "not asked for";
    if (r.pen_grooves->count == 0) return "no pen grooves found";
    return counted(r.pen_grooves->count, "pen groove") + " lifted, " + in_digits(r.pen_grooves->area_mm2) +
           " mm2, at most " + in_digits(r.pen_grooves->max_depth) + " mm deep";
}

std::string wrapping(const RepairReport& r) {
    if (!r.alpha_wrapped) return "not asked for";
    return "wrapped with a ball of " + in_digits(r.alpha_wrapped->alpha_mm) + " mm, " +
           in_digits(r.alpha_wrapped->offset_mm) + " mm outside";
}

// The warnings; those with a count of 0 are left out.
struct Sentences {
    void add(std::size_t count, const std::string& one, const std::string& many, const std::string& rest) {
        if (count > 0) all.push_back(counted(count, one, many) + rest);
    }
    std::vector<std::string> all;
};

void add_surface_warnings(const RepairReport& r, Sentences& sentences) {
    sentences.add(r.borders_snapped, "border point", "border points",
                  " moved up to " + in_digits(r.border_moved_mm) + " mm onto another one.");
    sentences.add(r.edges_split, "edge belonged", "edges belonged",
                  " to three faces or more; the surface was split there.");
    sentences.add(r.edges_cut, "edge was", "edges were", " cut open, because the faces there cannot be made to agree.");
    sentences.add(r.faces_reoriented, "face was", "faces were", " turned to agree with the neighbours.");
    sentences.add(r.repeated + r.of_doubled_components, "face", "faces", " that lay on another one dropped.");
    sentences.add(r.holes_filled, "hole", "holes", " closed with " + counted(r.faces_added, "face") + ".");
    if (r.added_area_share > warn_added_share) {
        sentences.all.push_back("What closes the holes makes up " + in_digits(std::round(100 * r.added_area_share)) +
                                " % of the surface: compare the picture with the bone.");
    }
    sentences.add(r.open_components_dropped, "small open component was", "small open components were",
                  " dropped (" + counted(r.open_component_faces, "face") + ").");
}

void add_shell_warnings(const RepairReport& r, Sentences& sentences) {
    sentences.add(r.shells_reoriented, "shell was", "shells were", " inside out and turned.");
    sentences.add(r.overlapping, "shell lies", "shells lie",
                  " inside another one that faces the same way: the scan overlaps itself there.");
    sentences.add(r.left_inside_out, "shell is", "shells are",
                  " inside out and left so, because they touch others that are not: the surface is folded there.");
    sentences.add(r.fragments_dropped ? r.fragments : 0, "fragment was", "fragments were", " dropped.");
}

void add_warnings_of_options(const RepairReport& r, Sentences& sentences) {
    if (r.resolving_undone) {
        sentences.all.emplace_back(
            "The places where the scan runs through itself are left: to repair them would have opened it.");
    } else if (r.resolved && r.resolved->left > 0) {
        sentences.all.push_back("The scan still runs through itself: " +
                                counted(r.resolved->left, "pair of faces", "pairs of faces") + ".");
    }
    if (r.pen_grooves) {
        sentences.add(r.pen_grooves->count, "pen groove was", "pen grooves were",
                      " lifted by up to " + in_digits(r.pen_grooves->max_depth) + " mm.");
        if (r.pen_grooves->is_too_coarse) {
            sentences.all.emplace_back("The faces are too large to show a marker's line: no pen groove was searched.");
        }
    }
    if (r.alpha_wrapped) {
        sentences.all.push_back("The scan was wrapped: no point of it is in the result, and gaps narrower than " +
                                in_digits(2 * r.alpha_wrapped->alpha_mm) + " mm are closed.");
    }
}

}  // namespace

std::optional<Refusal> refusal_of(const RepairReport& r) {
    const std::string repair_first = "repair the scan in the scanning software, then try again";
    const std::string in_file = ") in the units of the file";
    const auto place = [](Vec3 p) {
        return "(" + significant(p.x, 6) + ", " + significant(p.y, 6) + ", " + significant(p.z, 6);
    };
    if (r.faces_out == 0) {
        return Refusal{r.of_doubled_components > 0 ? ": nothing but flat doubled components, which enclose nothing"
                                                   : ": no face has an area",
                       repair_first};
    }
    if (r.open_components_left > 0) {
        return Refusal{
            " is open: " + counted(r.open_components_left, "open component encloses", "open components enclose") +
                " nothing; the first around " + place(r.first_open_component) + in_file,
            "scan the other side too, or close the surface in the scanning software"};
    }
    if (!r.left_open.empty()) {
        const OpenHole& hole = r.left_open.front();
        return Refusal{": " + counted(r.left_open.size(), "hole") + " cannot be closed; the first has " +
                           std::to_string(hole.edges) + " edges around " + place(hole.centre) + in_file,
                       repair_first};
    }
    if (r.open_edges > 0) {
        return Refusal{" does not close at " + counted(r.open_edges, "edge") + "; the first near " +
                           place(r.first_open_edge) + in_file,
                       repair_first};
    }
    if (!(r.volume > 0)) return Refusal{" has no volume", repair_first};
    return std::nullopt;
}

std::vector<RepairStep> steps(const RepairReport& r) {
    const std::string with_faces = ", with " + counted(r.faces_added, "face");
    return {{"weld", r.welded + r.collapsed + r.unreferenced,
             clauses({{r.welded, "point welded", "points welded"},
                      {r.collapsed, "collapsed face dropped", "collapsed faces dropped"},
                      {r.unreferenced, "unused point dropped", "unused points dropped"}})},
            {"snap_borders", r.borders_snapped,
             clauses({{r.borders_snapped, "border point welded", "border points welded"}})},
            {"faces", r.repeated + r.of_doubled_components,
             clauses({{r.repeated, "repeated face dropped", "repeated faces dropped"},
                      {r.of_doubled_components, "face of flat doubled components dropped",
                       "faces of flat doubled components dropped"}})},
            {"split", r.edges_split + r.edges_cut + r.points_copied,
             clauses({{r.edges_split, "edge of more than two faces split", "edges of more than two faces split"},
                      {r.edges_cut, "edge cut open", "edges cut open"},
                      {r.points_copied, "copy of a point made", "copies of points made"}})},
            {"orient", r.faces_reoriented,
             clauses({{r.faces_reoriented, "face turned to agree with its neighbours",
                       "faces turned to agree with their neighbours"}})},
            {"stitch", r.stitched, clauses({{r.stitched, "edge stitched", "edges stitched"}})},
            {"degenerate", r.degenerate_removed,
             clauses({{r.degenerate_removed, "face without area removed", "faces without area removed"},
                      {r.degenerate_left, "face without area left", "faces without area left"}})},
            {"fill", r.holes_filled + r.open_components_dropped,
             clauses({{r.holes_filled, "hole closed" + with_faces, "holes closed" + with_faces},
                      {r.holes_faired, "of them faired", "of them faired"},
                      {r.points_added, "point added", "points added"},
                      {r.left_open.size(), "hole left open", "holes left open"},
                      {r.open_components_dropped, "open component dropped", "open components dropped"}})},
            {"orient_outward", r.shells_reoriented,
             clauses({{r.shells_reoriented, "shell turned outwards", "shells turned outwards"}})},
            {"fragments", r.fragments, fragments(r)},
            {"resolve", r.resolved ? r.resolved->places : 0, resolving(r)},
            {"pen_grooves", r.pen_grooves ? r.pen_grooves->count : 0, smoothing(r)},
            {"alpha_wrap", r.alpha_wrapped ? std::size_t{1} : 0, wrapping(r)}};
}

std::vector<std::string> warnings(const RepairReport& r) {
    Sentences sentences;
    add_surface_warnings(r, sentences);
    add_shell_warnings(r, sentences);
    add_warnings_of_options(r, sentences);
    return std::move(sentences.all);
}

}  // namespace qchopper
