// Two pictures of the whole, one per step, two per piece, on several threads: O(triangles that each shows + pixels).
// All else is text.

#include "app/guide/make_guide.h"

#include <algorithm>
#include <map>

#include "app/guide/guide_pictures.h"
#include "base/parallel.h"
#include "base/shared_progress.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Of foam, so that a mass can be told where the cell file names no density.
constexpr double shown_density = 100;  // kg/m3
constexpr double mm3_per_m3 = 1e9;

std::string names_of(const std::vector<std::size_t>& indices, const ProjectJoints& joints) {
    std::string names;
    for (const std::size_t i : indices) names += (names.empty() ? "" : ", ") + joints.pieces[i];
    return names;
}

std::string cm2(double mm2) {
    return fixed(mm2 / 100, 1);
}

GuidePicture picture_of(const Pixels& pixels, std::string caption) {
    return {to_png(pixels), pixels.width, pixels.height, std::move(caption)};
}

// All pictures of a guide, drawn before the pages are made.
struct Drawn {
    std::vector<GuidePicture> apart;                // both sides
    std::vector<GuidePicture> steps;                // one per step
    std::vector<std::vector<GuidePicture>> pieces;  // both sides of each
};

Drawn draw(const GuideInput& in, const Context& context) {
    const StageTimer stage(context, "guide drawn");
    const std::vector<AssemblyStep>& steps = in.joints.assembly.steps;
    constexpr std::array sides{GuideSide::front, GuideSide::back};
    Drawn drawn;
    drawn.apart.resize(sides.size());
    drawn.steps.resize(steps.size());
    drawn.pieces.assign(in.pieces.size(), std::vector<GuidePicture>(sides.size()));
    SharedProgress progress(context, "pictures of the guide drawn", 2 + steps.size() + in.pieces.size());
    parallel_for(0, 2 + steps.size() + in.pieces.size(), [&](std::size_t i) {
        context.check_cancelled();
        if (i < 2) {
            drawn.apart[i] = picture_of(draw_apart(in.pieces, sides[i], context),
                                        i == 0 ? "All pieces, apart" : "The same from the opposite side");
        } else if (i < 2 + steps.size()) {
            const AssemblyStep& step = steps[i - 2];
            drawn.steps[i - 2] = picture_of(
                draw_step(in.pieces, in.joints, step, context),
                step.joints.empty() ? "Grey: what stands." : "Grey: what stands. Orange: faces that are glued now.");
        } else {
            const std::size_t p = i - 2 - steps.size();
            for (std::size_t s = 0; s < sides.size(); ++s) {
                drawn.pieces[p][s] =
                    picture_of(draw_piece(in.pieces, p, in.joints, sides[s], context).pixels,
                               s == 0 ? "Orange: glue faces, and who is glued to them" : "From the opposite side");
            }
        }
        progress.add(1);
    });
    return drawn;
}

// Of the sizes of dowels how many are needed, the thickest first.
GuideTable dowel_table(const ProjectJoints& joints) {
    std::map<std::pair<double, double>, std::size_t> counts;  // by diameter and depth of the holes, negative
    for (const PieceJoint& joint : joints.joints) {
        for (const Dowel& dowel : joint.dowels) ++counts[{-dowel.size.diameter, -dowel.size.depth}];
    }
    GuideTable table{{{"dowels", "for holes of, mm", "length at most, mm"}}, {true, true, true}};
    for (const auto& [size, count] : counts) {
        table.rows.push_back({std::to_string(count), significant(-size.first, 4), significant(-2 * size.second, 4)});
    }
    return table;
}

GuideSection first_section(const GuideInput& in, Drawn& drawn, const std::string& title) {
    GuideSection section{title, {}, true};
    const ProjectJoints& joints = in.joints;
    section.blocks.emplace_back(GuideText{
        counted(in.pieces.size(), "piece") + ", " + counted(joints.joints.size(), "joint") + ", " +
        counted(joints.assembly.steps.size(), "step") +
        ". Write the name of each piece, and on each glue face the name of its neighbour, before it leaves the table: "
        "the pages of the pieces show where."});
    section.blocks.emplace_back(GuidePictures{std::move(drawn.apart)});
    if (const GuideTable dowels = dowel_table(joints); dowels.rows.size() > 1) section.blocks.emplace_back(dowels);
    std::size_t holes = 0;
    for (const SheetOfOrder& sheet : in.jobs.sheets) holes += sheet.part.number > 1 ? 0 : sheet.holes_by_hand;
    section.blocks.emplace_back(GuideText{"Holes that are drilled by hand: " + std::to_string(holes) + "."});
    const auto faults =
        std::count_if(joints.faults.begin(), joints.faults.end(), [](const std::string& f) { return !f.empty(); });
    if (faults > 0) {
        section.blocks.emplace_back(GuideText{"Joints that can be turned or swapped, or have no dowel: " +
                                              std::to_string(faults) + ". Their steps say so."});
    }
    return section;
}

const SheetOfOrder* sheet_of(const GuideInput& in, const std::string& piece) {
    const auto found = std::find_if(in.jobs.sheets.begin(), in.jobs.sheets.end(),
                                    [&](const SheetOfOrder& sheet) { return sheet.piece == piece; });
    return found == in.jobs.sheets.end() ? nullptr : &*found;
}

const SawnBlock* block_of(const GuideInput& in, const std::string& piece) {
    const auto found = std::find_if(in.jobs.blocks.begin(), in.jobs.blocks.end(),
                                    [&](const SawnBlock& block) { return block.piece == piece; });
    return found == in.jobs.blocks.end() ? nullptr : &*found;
}

// "x 1000 to 320.0, z 500 to 200.5 at both ends"
std::string cuts_of(const SawnBlock& block) {
    std::string text;
    for (const SawCuts& cuts : block.cuts) {
        text += (text.empty() ? "" : ", ") + std::string(1, "xyz"[cuts.axis]) + " " + significant(cuts.from, 5) +
                " to " + fixed(cuts.length, 1) + (cuts.count > 1 ? " at both ends" : "");
    }
    return text;
}

std::string offcuts_of(const SawnBlock& block) {
    std::string text;
    for (const Vec3& offcut : offcuts_of(block.cuts)) text += (text.empty() ? "" : "; ") + sheet::size_text(offcut);
    return text.empty() ? "-" : text;
}

GuideSection blocks_section(const GuideInput& in) {
    GuideSection section{"Blocks", {}, true};
    GuideTable table{
        {{"piece", "job", "block", "stands as, mm", "saw cuts, mm", "offcuts, mm", "volume", "g at 100 kg/m3"}},
        {false, false, false, false, false, false, true, true}};
    for (const Piece& piece : in.pieces) {
        const SheetOfOrder* sheet = sheet_of(in, piece.name);
        const SawnBlock* block = block_of(in, piece.name);
        const double volume = volume_mm3(*piece.mesh);
        table.rows.push_back({piece.name,
                              sheet != nullptr   ? sheet->file
                              : block != nullptr ? "sawn only"
                                                 : "none",
                              sheet != nullptr   ? sheet->block_name
                              : block != nullptr ? block->stock.name
                                                 : "-",
                              sheet != nullptr   ? sheet::size_text(sheet->block)
                              : block != nullptr ? sheet::size_text(block->size)
                                                 : "-",
                              block != nullptr ? cuts_of(*block) : "none", block != nullptr ? offcuts_of(*block) : "-",
                              describe_volume(volume), fixed(1000 * volume / mm3_per_m3 * shown_density, 0)});
    }
    section.blocks.emplace_back(std::move(table));
    return section;
}

std::string sentence_of(const AssemblyStep& step, const ProjectJoints& joints) {
    std::string text = "Move " + names_of(step.moved, joints) + " to " + names_of(step.standing, joints) +
                       " along the arrow, against cut " + std::to_string(step.cut);
    if (step.solids > 1) text += "; its " + std::to_string(step.solids) + " solids interlock and move together";
    return text + ".";
}

GuideTable joint_table(const AssemblyStep& step, const ProjectJoints& joints) {
    GuideTable table{{{"joint", "cut", "cm2", "dowel holes, mm", "faces"}}, {false, true, true, false, false}};
    for (const std::size_t j : step.joints) {
        const PieceJoint& joint = joints.joints[j];
        table.rows.push_back({joints.pieces[joint.below] + "-" + joints.pieces[joint.above], std::to_string(joint.cut),
                              cm2(joint.contact.area_mm2), describe_dowels(joint),
                              joints.faces.empty() ? "-" : names_of(joints.faces[j])(joints.faces[j])});
    }
    return table;
}

GuideSection step_section(std::size_t number, const GuideInput& in, GuidePicture picture) {
    const ProjectJoints& joints = in.joints;
    const AssemblyStep& step = joints.assembly.steps[number];
    GuideSection section{
        "Step " + std::to_string(number + 1) + " of " + std::to_string(joints.assembly.steps.size()), {}, number == 0};
    section.blocks.emplace_back(GuideText{sentence_of(step, joints)});
    if (must_be_held(step)) section.blocks.emplace_back(GuideText{"Hold it: it touches nothing yet.", true});
    if (!step.is_clear) section.blocks.emplace_back(GuideText{"SOMETHING IS IN THE WAY of this move.", true});
    section.blocks.emplace_back(GuidePictures{{std::move(picture)}});
    if (!step.joints.empty()) section.blocks.emplace_back(joint_table(step, joints));
    for (const std::size_t j : step.joints) {
        if (!joints.faults[j].empty()) section.blocks.emplace_back(GuideText{joints.faults[j] + "."});
    }
    return section;
}

std::string by_hand(const SheetOfOrder& sheet) {
    std::string text;
    if (sheet.foam_mm3 > 0) {
        text = "Left to the hand: foam that no tool reaches, " + fixed(sheet.foam_mm3 / 1000, 1) + " cm3 (" +
               sheet::percent(sheet.unreachable_share) + " of the surface). ";
    }
    if (sheet.holes_by_hand > 0) {
        text += "Drill " + counted(sheet.holes_by_hand, "hole") + " by hand, by the templates in " + sheet.file + ".";
    }
    return text.empty() ? "Nothing is left to the hand." : text;
}

GuideSection piece_section(std::size_t p, const GuideInput& in, std::vector<GuidePicture> pictures) {
    const ProjectJoints& joints = in.joints;
    GuideSection section{"Piece " + joints.pieces[p], {}, p == 0};
    section.blocks.emplace_back(GuidePictures{std::move(pictures)});
    GuideTable table{{{"write", "on the face of cut", "cm2", "dowel holes, mm", "faces"}},
                     {false, true, true, false, false}};
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        const PieceJoint& joint = joints.joints[j];
        if (joint.below != p && joint.above != p) continue;
        table.rows.push_back({joints.pieces[joint.below == p ? joint.above : joint.below], std::to_string(joint.cut),
                              cm2(joint.contact.area_mm2), describe_dowels(joint),
                              joints.faces.empty() ? "-" : names_of(joints.faces[j])(joints.faces[j])});
    }
    if (table.rows.size() > 1) {
        section.blocks.emplace_back(std::move(table));
    } else {
        section.blocks.emplace_back(GuideText{"It is glued to no other piece."});
    }
    if (const SheetOfOrder* sheet = sheet_of(in, joints.pieces[p])) {
        section.blocks.emplace_back(GuideText{by_hand(*sheet)});
    } else if (block_of(in, joints.pieces[p]) != nullptr) {
        section.blocks.emplace_back(GuideText{"The saw alone makes it."});
    } else {
        section.blocks.emplace_back(GuideText{"It has no job: it does not fit the cell.", true});
    }
    return section;
}

}  // namespace

bool must_be_held(const AssemblyStep& step) {
    return step.joints.empty();
}

AssemblyGuide make_guide(const GuideInput& input, const Context& context) {
    Drawn drawn = draw(input, context);
    AssemblyGuide guide{"Assembly guide: " + input.order, {}};
    guide.sections.push_back(first_section(input, drawn, guide.title));
    guide.sections.push_back(blocks_section(input));
    for (std::size_t i = 0; i < drawn.steps.size(); ++i) {
        guide.sections.push_back(step_section(i, input, std::move(drawn.steps[i])));
    }
    for (std::size_t p = 0; p < drawn.pieces.size(); ++p) {
        guide.sections.push_back(piece_section(p, input, std::move(drawn.pieces[p])));
    }
    return guide;
}

}  // namespace qchopper
