// A table of primitives: the skull of a giant carnivore, without its lower jaw.

#include "segment/sample/bones.h"

namespace qchopper {
namespace {

void add_brain_case(std::vector<FieldPart>& parts) {
    parts.push_back(added(0, {ellipsoid({0, -560, 130}, {255, 350, 245})}));
    parts.push_back(added(90, {cone({0, -840, 60}, 150, {0, -700, 20}, 170)}));
    // the crest along the top and the two that run down from it behind
    parts.push_back(added(40, {plate({0, -180, 330}, {0, -560, 350}, {0, -860, 480}, 20),
                               plate({0, -860, 480}, {0, -560, 350}, {0, -880, 240}, 20)}));
    parts.push_back(added(36, both_sides({plate({0, -880, 440}, {0, -880, 180}, {210, -820, 120}, 20),
                                          cone({0, -872, 470}, 24, {220, -800, 130}, 22)})));
    parts.push_back(added(24, both_sides({ellipsoid({74, -958, -26}, {52, 50, 62})})));  // occipital condyles
    parts.push_back(added(24, both_sides({cone({190, -800, 20}, 46, {200, -830, -120}, 26)})));
    parts.push_back(added(24, both_sides({ellipsoid({120, -690, -120}, {62, 92, 56})})));
}

void add_face(std::vector<FieldPart>& parts) {
    parts.push_back(added(120, both_sides(tube({{{84, -330, 130}, 190},
                                                {{90, -60, 110}, 172},
                                                {{74, 250, 60}, 148},
                                                {{58, 560, 20}, 122},
                                                {{44, 790, -4}, 100},
                                                {{34, 872, -14}, 84}},
                                               5))));
    parts.push_back(
        added(60, {cone({0, -150, 270}, 60, {0, 420, 150}, 46), cone({0, 420, 150}, 46, {0, 800, 62}, 36)}));
    // brows over the orbits, ending in a point behind the eye
    parts.push_back(added(
        50, both_sides(tube(
                {{{130, 90, 232}, 42}, {{222, -60, 270}, 46}, {{290, -220, 236}, 40}, {{322, -300, 176}, 26}}, 4))));
    // the ridge that carries the teeth
    parts.push_back(added(60, both_sides(tube({{{196, -60, -104}, 48},
                                               {{180, 200, -126}, 52},
                                               {{146, 480, -128}, 48},
                                               {{112, 720, -120}, 46},
                                               {{66, 866, -104}, 42},
                                               {{0, 920, -92}, 40}},
                                              4))));
    parts.push_back(carved(60, {cone({0, -120, -260}, 110, {0, 640, -210}, 70)}));  // the palate's vault
}

// From the cheek outwards and back to the ear: a topological handle on either side.
void add_cheek_arches(std::vector<FieldPart>& parts) {
    parts.push_back(added(50, both_sides(tube({{{200, 60, -20}, 64},
                                               {{300, -70, -46}, 52},
                                               {{392, -240, -34}, 42},
                                               {{424, -420, 0}, 40},
                                               {{396, -580, 30}, 42},
                                               {{310, -690, 40}, 54},
                                               {{215, -730, 40}, 70}},
                                              5))));
    parts.push_back(added(26, both_sides({plate({330, -110, -60}, {420, -380, -2}, {384, -260, -96}, 24),
                                          cone({392, -290, 0}, 30, {366, -300, 60}, 20)})));
    parts.push_back(carved(30, both_sides({ellipsoid({300, -640, -40}, {70, 40, 34})})));  // seat of the jaw
}

void carve_openings(std::vector<FieldPart>& parts) {
    // orbits, with the eye's stalk leading in
    parts.push_back(carved(34, both_sides({ellipsoid({292, -120, 130}, {116, -30, 0}, {30, 118, 0}, 104)})));
    parts.push_back(carved(20, both_sides({cone({240, -150, 120}, 50, {150, -240, 110}, 34)})));
    // openings before the orbits, and the small ones of the nerves along the snout
    parts.push_back(carved(26, both_sides({ellipsoid({222, 240, 70}, {62, -12, 0}, {18, 120, 0}, 66)})));
    parts.push_back(
        carved(10, both_sides({ball({186, 470, -30}, 22), ball({168, 580, -40}, 18), ball({150, 690, -48}, 16)})));
    // nostrils
    parts.push_back(carved(
        24,
        both_sides(tube({{{74, 1000, 74}, 50}, {{68, 860, 68}, 46}, {{62, 700, 60}, 38}, {{56, 540, 60}, 30}}, 4))));
    // temporal hollows beside the brain case
    parts.push_back(carved(50, both_sides({ellipsoid({318, -430, 190}, {80, 190, 160})})));
    parts.push_back(carved(14, both_sides({cone({330, -770, 30}, 26, {190, -740, 34}, 20)})));  // ears
    // the hollow of the brain and the foramen magnum that opens it
    parts.push_back(
        carved(20, {ellipsoid({0, -560, 130}, {178, 262, 166}), cone({0, -330, 120}, 90, {0, -250, 110}, 60)}));
    parts.push_back(carved(20, {cone({0, -640, 90}, 80, {0, -1150, 20}, 84)}));
}

// Nine on a side; the fourth is the fang.
void add_teeth(std::vector<FieldPart>& parts) {
    struct Tooth {
        Vec3 root;
        double length;
        double radius;
    };
    const Tooth teeth[] = {{{26, 912, -100}, 96, 22},   {{76, 868, -108}, 110, 24},  {{112, 770, -124}, 130, 27},
                           {{122, 672, -128}, 250, 42}, {{140, 560, -132}, 100, 26}, {{152, 450, -138}, 130, 30},
                           {{164, 330, -140}, 160, 36}, {{178, 200, -138}, 150, 38}, {{188, 70, -132}, 110, 36}};
    std::vector<FieldPrimitive> crowns;
    for (const Tooth& tooth : teeth) {
        const Vec3 middle = tooth.root + Vec3{0.02 * tooth.length, 0.04 * tooth.length, -0.65 * tooth.length};
        const Vec3 tip = tooth.root + Vec3{-0.02 * tooth.length, -0.12 * tooth.length, -1.15 * tooth.length};
        crowns.push_back(cone(tooth.root, tooth.radius, middle, 0.72 * tooth.radius));
        crowns.push_back(cone(middle, 0.72 * tooth.radius, tip, 0.3 * tooth.radius));
    }
    parts.push_back(added(14, both_sides(crowns)));
}

}  // namespace

Bone skull() {
    Bone bone;
    std::vector<FieldPart>& parts = bone.field.parts;
    add_brain_case(parts);
    add_face(parts);
    carve_openings(parts);
    add_cheek_arches(parts);
    add_teeth(parts);
    bone.field.textures = {{3.5, 230, 0.17}, {2.0, 96, 0.41}, {0.8, 53, 0.77}};
    bone.box = {{-560, -1100, -520}, {560, 1080, 600}};
    bone.base_spacing = 18;
    return bone;
}

}  // namespace qchopper
