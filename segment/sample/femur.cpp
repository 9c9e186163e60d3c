// A table of primitives: the left thigh bone of a very large mammal.

#include "segment/sample/bones.h"

namespace qchopper {
namespace {

// Bowed to the front, thinnest above the middle, with the rough line behind.
void add_shaft(std::vector<FieldPart>& parts) {
    parts.push_back(added(0, tube({{{0, -6, 150}, 74},
                                   {{0, 6, 260}, 60},
                                   {{2, 22, 400}, 49},
                                   {{6, 32, 560}, 44},
                                   {{10, 30, 720}, 43},
                                   {{12, 18, 860}, 47},
                                   {{10, 4, 980}, 56},
                                   {{4, -2, 1050}, 60}},
                                  5)));
    parts.push_back(added(26, tube({{{-26, -46, 250}, 11},
                                    {{-4, -22, 400}, 14},
                                    {{6, -10, 560}, 15},
                                    {{12, -12, 720}, 14},
                                    {{30, -30, 900}, 12},
                                    {{48, -40, 1000}, 10}},
                                   5)));
    parts.push_back(added(22, tube({{{28, -44, 250}, 10}, {{14, -26, 370}, 12}, {{8, -14, 480}, 12}}, 5)));
    parts.push_back(added(20, {cone({52, 2, 880}, 18, {66, -8, 800}, 12), cone({66, -8, 800}, 12, {48, 6, 730}, 10)}));
}

// Head on its neck, the two trochanters and the pit between.
void add_upper_end(std::vector<FieldPart>& parts) {
    parts.push_back(added(45, {cone({-10, 0, 1040}, 58, {-105, 14, 1112}, 43)}));
    parts.push_back(added(12, {ellipsoid({-142, 20, 1130}, {70, 70, 70})}));
    parts.push_back(carved(8, {ball({-206, 6, 1152}, 15)}));  // the fovea, for the ligament of the head
    parts.push_back(added(36, {cone({44, -8, 990}, 52, {78, -20, 1120}, 34)}));
    parts.push_back(
        added(24, {cone({72, -34, 1128}, 28, {84, 8, 1116}, 26), cone({86, 6, 1100}, 24, {70, 24, 1000}, 20)}));
    parts.push_back(carved(20, {ellipsoid({24, -64, 1098}, {24, 34, 44})}));
    parts.push_back(added(20, {cone({-26, -26, 935}, 30, {-46, -44, 915}, 22)}));
    parts.push_back(added(16, {cone({-50, -48, 912}, 14, {70, -58, 1080}, 12)}));  // the crest between them
}

// Two condyles with the notch behind and the groove of the kneecap in front.
void add_lower_end(std::vector<FieldPart>& parts) {
    parts.push_back(added(60, {ellipsoid({0, 4, 130}, {104, 66, 74})}));
    parts.push_back(added(26, {ellipsoid({-62, -38, 78}, {54, 6, 0}, {-9, 92, 0}, 78)}));
    parts.push_back(added(26, {ellipsoid({62, -32, 84}, {50, -5, 0}, {7, 86, 0}, 74)}));
    parts.push_back(
        added(30, {cone({-42, 56, 150}, 34, {-48, 52, 70}, 36), cone({46, 58, 165}, 38, {48, 54, 72}, 36)}));
    parts.push_back(added(22, {ball({-110, -22, 112}, 22), ball({108, -22, 116}, 20)}));
    parts.push_back(carved(16, {ellipsoid({0, -112, 52}, {29, 96, 92}), cone({0, -40, -20}, 26, {0, 30, -40}, 16)}));
    parts.push_back(
        carved(26, tube({{{4, 116, 240}, 22}, {{4, 112, 160}, 28}, {{2, 108, 90}, 26}, {{0, 92, 10}, 24}}, 5)));
    parts.push_back(carved(22, {ellipsoid({0, -84, 196}, {52, 26, 50})}));  // the flat face above the condyles
}

}  // namespace

Bone femur() {
    Bone bone;
    std::vector<FieldPart>& parts = bone.field.parts;
    add_shaft(parts);
    add_upper_end(parts);
    add_lower_end(parts);
    bone.field.textures = {{2.2, 140, 0.21}, {1.1, 57, 0.43}, {0.5, 31, 0.71}};
    bone.box = {{-270, -190, -50}, {190, 170, 1260}};
    bone.base_spacing = 11;
    return bone;
}

}  // namespace qchopper
