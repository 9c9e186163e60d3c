#include "segment/repair/report.h"

#include <cmath>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double warn_added_share = 0.05;

std::string in_digits(double value) {
    return significant(value, 3);
}

// "2 holes closed, 5 faces dropped": what did not happen is left out.
class Words {
 public:
    Words& add(std::size_t count, const std::string& one, const std::string& many) {
        if (count > 0) add(counted(count, one, many));
        return *this;
    }
    Words& add(const std::string& words) {
        text_ += (text_.empty() ? "" : ", ") + words;
        return *this;
    }
    std::string text() const { return text_.empty() ? "nothing to do" : text_; }

 private:
    std::string text_;
};

std::string filling(const RepairReport& r) {
    Words words;
    words.add(r.holes_filled, "hole closed", "holes closed");
    if (r.holes_filled > 0) words.add("with " + counted(r.faces_added, "face", "faces"));
    words.add(r.holes_faired, "of them faired", "of them faired");
    words.add(r.points_added, "point added", "points added");
    words.add(r.left_open.size(), "hole left open", "holes left open");
    words.add(r.open_components, "open component taken away", "open components taken away");
    return words.text();
}

std::string fragments(const RepairReport& r) {
    if (r.fragments == 0) return "none";
    return counted(r.fragments, "fragment", "fragments") + " with " + in_digits(100 * r.fragment_area_share) +
           " % of the surface " + (r.fragments_dropped ? "dropped" : "kept");
}

std::string resolving(const RepairReport& r) {
    if (!r.resolved) return "not asked for";
    if (r.resolved->pairs == 0) return "nothing to do";
    return counted(r.resolved->places, "place", "places") + " mended, " +
           counted(r.resolved->left, "pair of faces", "pairs of faces") + " left of " +
           std::to_string(r.resolved->pairs) + (r.resolving_undone ? "; undone" : "");
}

std::string smoothing(const RepairReport& r) {
    if (!r.marks) return "not asked for";
    if (r.marks->marks == 0) return "no marks found";
    return counted(r.marks->marks, "mark", "marks") + " lifted, " + in_digits(r.marks->area_mm2) + " mm2, at most " +
           in_digits(r.marks->most_depth) + " mm deep";
}

// The sentences of warnings(), of what there is.
class Sentences {
 public:
    void add(std::size_t count, const std::string& one, const std::string& many, const std::string& rest) {
        if (count > 0) all.push_back(counted(count, one, many) + rest);
    }
    std::vector<std::string> all;
};

void tell_of_surface(const RepairReport& r, Sentences& say) {
    say.add(r.borders_snapped, "border point", "border points",
            " moved up to " + in_digits(r.border_moved_mm) + " mm onto another one.");
    say.add(r.edges_split, "edge belonged", "edges belonged", " to three faces or more; the surface was parted there.");
    say.add(r.edges_cut, "edge was", "edges were", " cut open, because the faces there cannot be made to agree.");
    say.add(r.faces_turned, "face was", "faces were", " turned to agree with the neighbours.");
    say.add(r.repeated + r.of_double_sheets, "face", "faces", " that lay on another one dropped.");
    say.add(r.holes_filled, "hole", "holes", " closed with " + counted(r.faces_added, "face", "faces") + ".");
    if (r.added_area_share > warn_added_share) {
        say.all.push_back("What closes the holes makes up " + in_digits(std::round(100 * r.added_area_share)) +
                          " % of the surface: compare the picture with the bone.");
    }
    say.add(r.open_components, "small open component was", "small open components were",
            " taken away (" + counted(r.open_component_faces, "face", "faces") + ").");
}

void tell_of_shells(const RepairReport& r, Sentences& say) {
    say.add(r.shells_turned, "shell was", "shells were", " inside out and turned.");
    say.add(r.overlapping, "shell lies", "shells lie",
            " inside another one that faces the same way: the scan overlaps itself there.");
    say.add(r.left_inside_out, "shell is", "shells are",
            " inside out and left so, because they touch others that are not: the surface is folded there.");
    say.add(r.fragments_dropped ? r.fragments : 0, "fragment was", "fragments were", " dropped.");
}

void tell_of_what_was_asked_for(const RepairReport& r, Sentences& say) {
    if (r.resolving_undone) {
        say.all.emplace_back(
            "The places where the scan runs through itself are left: mending them would have opened it.");
    } else if (r.resolved && r.resolved->left > 0) {
        say.all.push_back("The scan still runs through itself: " +
                          counted(r.resolved->left, "pair of faces", "pairs of faces") + ".");
    }
    if (r.marks) {
        say.add(r.marks->marks, "mark was", "marks were",
                " lifted by up to " + in_digits(r.marks->most_depth) + " mm.");
    }
    if (r.marks && r.marks->is_too_coarse) {
        say.all.emplace_back("The faces are too large to tell a marker's line: no mark was looked for.");
    }
    if (r.wrapped) {
        say.all.push_back("The scan was wrapped: no point of it is in the result, and gaps narrower than " +
                          in_digits(2 * r.wrapped->alpha_mm) + " mm are closed.");
    }
}

}  // namespace

std::vector<RepairStep> steps(const RepairReport& r) {
    std::vector<RepairStep> all;
    all.push_back({"weld", r.welded + r.collapsed + r.unreferenced,
                   Words()
                       .add(r.welded, "point welded", "points welded")
                       .add(r.collapsed, "collapsed face dropped", "collapsed faces dropped")
                       .add(r.unreferenced, "unused point dropped", "unused points dropped")
                       .text()});
    all.push_back({"weld_borders", r.borders_snapped,
                   Words().add(r.borders_snapped, "border point welded", "border points welded").text()});
    all.push_back(
        {"faces", r.repeated + r.of_double_sheets,
         Words()
             .add(r.repeated, "repeated face dropped", "repeated faces dropped")
             .add(r.of_double_sheets, "face of flat double sheets dropped", "faces of flat double sheets dropped")
             .text()});
    all.push_back({"split", r.edges_split + r.edges_cut + r.points_copied,
                   Words()
                       .add(r.edges_split, "edge of more than two faces split", "edges of more than two faces split")
                       .add(r.edges_cut, "edge cut open", "edges cut open")
                       .add(r.points_copied, "copy of a point made", "copies of points made")
                       .text()});
    all.push_back({"orient", r.faces_turned,
                   Words()
                       .add(r.faces_turned, "face turned to agree with its neighbours",
                            "faces turned to agree with their neighbours")
                       .text()});
    all.push_back({"stitch", r.stitched, Words().add(r.stitched, "edge stitched", "edges stitched").text()});
    all.push_back({"degenerate", r.degenerate_removed,
                   Words()
                       .add(r.degenerate_removed, "face without area removed", "faces without area removed")
                       .add(r.degenerate_left, "face without area left", "faces without area left")
                       .text()});
    all.push_back({"fill", r.holes_filled + r.open_components, filling(r)});
    all.push_back({"outwards", r.shells_turned,
                   Words().add(r.shells_turned, "shell turned outwards", "shells turned outwards").text()});
    all.push_back({"fragments", r.fragments, fragments(r)});
    all.push_back({"resolve", r.resolved ? r.resolved->places : 0, resolving(r)});
    all.push_back({"marks", r.marks ? r.marks->marks : 0, smoothing(r)});
    all.push_back({"wrap", r.wrapped ? std::size_t{1} : 0,
                   r.wrapped ? "wrapped with a ball of " + in_digits(r.wrapped->alpha_mm) + " mm, " +
                                   in_digits(r.wrapped->offset_mm) + " mm outside"
                             : "not asked for"});
    return all;
}

std::vector<std::string> warnings(const RepairReport& r) {
    Sentences say;
    tell_of_surface(r, say);
    tell_of_shells(r, say);
    tell_of_what_was_asked_for(r, say);
    return std::move(say.all);
}

}  // namespace qchopper
