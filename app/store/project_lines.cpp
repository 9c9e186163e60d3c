// Text from the records of a project.

#include "app/store/project_lines.h"

#include <algorithm>

#include "base/text.h"

namespace qchopper {

std::vector<std::string> discarded_lines(const Project& project) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < project.discarded.size(); ++i) {
        const SolidRecord& solid = project.discarded[i];
        const std::size_t after = project.discards.at(i).after;
        lines.push_back("discarded " + (after > 0 ? "after cut " + std::to_string(after) : "before the first cut") +
                        ": piece " + solid.name + ", " + with_commas(solid.faces) + " faces, " +
                        fixed(solid.volume_mm3 / 1000, 3) + " ml (" +
                        fixed(100 * solid.volume_mm3 / project.scan.volume_mm3, 2) + " % of the scan)");
    }
    return lines;
}

std::string fragments_line(const Project& project) {
    if (project.fragment_list.empty()) return {};
    double volume = 0;
    for (const SolidRecord& fragment : project.fragment_list) volume += fragment.volume_mm3;
    return counted(project.fragment_list.size(), "fragment") + " (" + describe_volume(volume) +
           " in all), listed in project.json" +
           (project.fragments == FragmentChoice::drop ? ", dropped"
            : project.stage == Stage::cutting         ? " and kept"
                                                      : " and kept in pieces/fragments.ply");
}

std::string ignored_line(const IgnoredSurface& ignored) {
    std::string by = ignored.painted.empty() ? "" : "painted in " + ignored.painted.string();
    if (ignored.inside) by += by.empty() ? "inside" : ", inside";
    return "ignored: " + fixed(100 * ignored.share, 2) + " % of the scan's surface (" + by + ")";
}

std::string no_cut_line(const NoCutSurface& no_cut) {
    return "no cut: through " + with_commas(no_cut.points) + (no_cut.points == 1 ? " point" : " points") +
           " of the scan (painted in " + no_cut.painted.string() + ")";
}

std::string symmetry_line(const SymmetryPlane& s) {
    const Vec3 n = s.plane.normal;
    return "symmetry plane: normal " + fixed(n.x, 4) + " " + fixed(n.y, 4) + " " + fixed(n.z, 4) + ", offset " +
           fixed(s.plane.offset, 3) + " mm; mirror images miss by " + fixed(s.ratio(), 2) +
           " of the distance of samples: " + (s.is_symmetric() ? "symmetric" : "not symmetric");
}

std::vector<std::string> scan_lines(const Project& project) {
    std::vector<std::string> lines;
    if (project.ignored) lines.push_back(ignored_line(*project.ignored));
    if (project.no_cut) lines.push_back(no_cut_line(*project.no_cut));
    const std::optional<SymmetryPlane>& symmetry = project.settings.candidates.symmetry;
    if (symmetry) lines.push_back(symmetry_line(*symmetry));
    return lines;
}

std::vector<std::string> stress_lines(const StressedModel& stress) {
    const StructureReport& r = stress.report;
    const Vec3 at = r.largest_tension_at;
    std::vector<std::string> lines{
        "structure: voxels of " + significant(stress.grid.size, 3) + " mm, " + with_commas(r.unknowns) + " unknowns, " +
        with_commas(r.iterations) + " iterations; largest tension " +
        significant(100 * r.largest_tension_mpa / stress.strength_mpa, 3) + " % of the strength, at " + fixed(at.x, 1) +
        " " + fixed(at.y, 1) + " " + fixed(at.z, 1) + " mm"};
    const auto share = [&](std::size_t voxels, std::size_t of) {
        return fixed(100 * static_cast<double>(voxels) / static_cast<double>(of), 2) + " %";
    };
    std::size_t floating = 0;
    std::size_t hinged = 0;
    for (const FloatingSolid& solid : r.floating) {
        floating += solid.voxels;
        hinged += solid.is_hinged ? 1 : 0;
    }
    if (floating > 0) {
        lines.push_back("structure: " + counted(r.floating.size(), "solid") + " of voxels, " +
                        share(floating, stress.voxels.size()) + " of them, " +
                        "hang on nothing that stands and get no stress; " + std::to_string(hinged) +
                        " of them by an edge or a corner of a voxel");
    }
    if (r.hinges > 0) {
        lines.push_back("structure: at " + counted(r.hinges, "place") + " voxels meet by an edge or a corner only");
    }
    if (r.thin_voxels > 0) {
        lines.push_back("structure: " + share(r.thin_voxels, r.standing_voxels) +
                        " of what stands is under 3 voxels thick, too coarse for its stress");
    }
    return lines;
}

std::string kept_cuts(std::size_t cuts, const std::filesystem::path& folder, bool is_beam) {
    return "The " + std::to_string(cuts) + " cuts " + (is_beam ? "of the best segmentation so far" : "made so far") +
           " are kept in " + folder.string();
}

std::vector<std::string> round_lines(const std::vector<Cut>& cuts, std::size_t told, const SearchSettings& settings) {
    std::vector<std::string> lines;
    if (cuts.empty()) return lines;
    const std::size_t first = settings.beam > 1 ? cuts.size() - 1 : std::min(told, cuts.size());
    for (std::size_t i = first; i < cuts.size(); ++i) {
        lines.push_back(cut_line(cuts[i], settings));
    }
    return lines;
}

namespace {

std::string percent(const MilledSurface& surface) {
    return fixed(100 * surface.share(), 2);
}

// What follows "cut 7 of piece K: ".
std::string outcome_of(const CutReview& v) {
    const std::string now =
        percent(v.before) + " % of what is left of its pieces is out of reach of the setups, more than expected";
    if (v.outcome == ReviewOutcome::carries_cut) {
        return now + "; it carries other cuts, which another plane would take back; kept";
    }
    if (v.outcome == ReviewOutcome::decided) return now + "; you decided it, or a piece of it or of a later cut; kept";
    if (v.planes == 0) return now + "; no other plane keeps the rules that hold; kept";
    if (v.outcome == ReviewOutcome::replaced) {
        return "by their setups another plane leaves " + percent(v.best) + " instead of " + percent(v.before) +
               " % of its pieces out of reach; taken";
    }
    return "by their setups no other of " + std::to_string(v.planes) + " planes leaves enough less than " +
           percent(v.before) + " % of its pieces out of reach (the best one " + percent(v.best) + " %); kept";
}

}  // namespace

std::vector<std::string> review_lines(const SetupReview& review) {
    std::vector<std::string> lines;
    for (const CutReview& v : review.cuts) {
        lines.push_back("cut " + std::to_string(v.cut) + " of piece " + v.piece + ": " + outcome_of(v));
    }
    return lines;
}

}  // namespace qchopper
