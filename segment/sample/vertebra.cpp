// A table of primitives: a lumbar vertebra of a large mammal.

#include "segment/sample/bones.h"

namespace qchopper {
namespace {

// A spool: two thick end plates, a waist between them, dished ends.
void add_body(std::vector<FieldPart>& parts) {
    parts.push_back(added(0, {ellipsoid({0, 0, 0}, {46, 60, 41})}));
    parts.push_back(added(34, {ellipsoid({0, 47, -2}, {63, 13, 53})}));
    parts.push_back(added(34, {ellipsoid({0, -47, -2}, {64, 13, 54})}));
    parts.push_back(carved(10, {ellipsoid({0, 74, 0}, {52, 19, 42})}));
    parts.push_back(carved(10, {ellipsoid({0, -75, 0}, {52, 19, 42})}));
    parts.push_back(added(10, {cone({0, -34, -46}, 7, {0, 34, -46}, 7)}));  // the keel below
    // openings of the vessels at the waist
    parts.push_back(carved(5, both_sides({cone({60, 4, 2}, 6, {34, 2, 4}, 4.5)})));
    parts.push_back(carved(4, {cone({9, -6, -58}, 5, {6, -4, -30}, 4), cone({-11, 8, -58}, 4.5, {-7, 6, -30}, 4)}));
}

// Pedicles and laminae close the foramen above the body.
void add_arch(std::vector<FieldPart>& parts) {
    parts.push_back(added(
        16, both_sides(tube({{{38, -18, 28}, 19}, {{43, -16, 60}, 16}, {{44, -12, 84}, 16}, {{38, 0, 104}, 14}}, 4))));
    parts.push_back(added(12, both_sides({plate({40, -22, 98}, {36, 32, 94}, {4, -14, 130}, 8.5),
                                          plate({36, 32, 94}, {4, 40, 124}, {4, -14, 130}, 8.5)})));
    // the notch through which the nerve leaves, behind the pedicle
    parts.push_back(carved(8, both_sides({cone({70, 26, 62}, 13, {22, 26, 62}, 13)})));
    // the foramen itself, a rounded triangle
    parts.push_back(carved(6, {cone({-15, -90, 66}, 11, {-15, 90, 66}, 11), cone({15, -90, 66}, 11, {15, 90, 66}, 11),
                               cone({0, -90, 88}, 14, {0, 90, 88}, 14), ellipsoid({0, 0, 74}, {21, 200, 17})}));
}

// The blade in the middle, leaning back, with a thick rough tip.
void add_spinous_process(std::vector<FieldPart>& parts) {
    parts.push_back(added(16, {plate({0, -10, 122}, {0, 40, 120}, {0, -34, 232}, 7.5),
                               plate({0, 40, 120}, {0, -34, 232}, {0, 18, 240}, 7.5)}));
    parts.push_back(
        added(14, tube({{{0, -40, 229}, 9}, {{0, -22, 241}, 12.5}, {{0, 4, 247}, 13.5}, {{0, 24, 240}, 10}}, 4)));
    parts.push_back(added(8, {cone({0, -14, 128}, 10, {0, -34, 226}, 7), cone({0, 38, 122}, 8.5, {0, 19, 236}, 7)}));
}

// Long thin wings with a keel and a blunt end.
void add_transverse_processes(std::vector<FieldPart>& parts) {
    parts.push_back(added(18, both_sides({plate({40, -20, 84}, {40, 16, 82}, {158, -22, 96}, 6.5),
                                          plate({40, 16, 82}, {158, -22, 96}, {150, 8, 94}, 6.5)})));
    parts.push_back(added(
        12, both_sides(tube({{{36, -10, 86}, 13}, {{80, -10, 92}, 10}, {{130, -9, 98}, 8.5}, {{160, -8, 96}, 9}}, 5))));
    parts.push_back(added(8, both_sides({cone({163, -22, 95}, 9, {160, 6, 94}, 8)})));
    parts.push_back(added(9, both_sides({cone({52, 18, 74}, 7, {66, 30, 66}, 5)})));  // accessory process
}

// Four facets: the front pair face inwards and up, the hind pair outwards and down.
void add_facets(std::vector<FieldPart>& parts) {
    parts.push_back(added(12, both_sides(tube({{{38, -12, 100}, 13}, {{42, -38, 112}, 13}, {{42, -54, 120}, 13}}, 4))));
    parts.push_back(added(7, both_sides({ellipsoid({42, -54, 122}, {12.5, 5, 9}, {0, 24, 0}, 22),
                                         cone({52, -44, 128}, 11, {56, -34, 138}, 9)})));
    parts.push_back(carved(4, both_sides({ellipsoid({17, -64, 131}, {18, 7, 14}, {0, 30, 0}, 23)})));
    parts.push_back(added(12, both_sides(tube({{{26, 24, 108}, 12}, {{24, 48, 104}, 12}, {{23, 64, 99}, 11}}, 4))));
    parts.push_back(added(6, both_sides({ellipsoid({25, 66, 96}, {7, 3, 4}, {0, 20, 0}, 18)})));
}

}  // namespace

Bone vertebra() {
    Bone bone;
    std::vector<FieldPart>& parts = bone.field.parts;
    add_body(parts);
    add_spinous_process(parts);
    add_transverse_processes(parts);
    add_facets(parts);
    add_arch(parts);
    bone.field.textures = {{1.0, 47, 0.13}, {0.6, 21, 0.37}};
    bone.box = {{-200, -120, -90}, {200, 120, 290}};
    bone.base_spacing = 5.5;
    return bone;
}

}  // namespace qchopper
