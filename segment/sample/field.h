// A body as a field: negative inside, positive outside, zero on its surface; about a distance in mm near it.
//
// A field is a row of parts that are added or carved out one after the other with rounded joints. What a region of
// space needs of it can be picked out beforehand, and gives the same bits there as the whole field
// (tests/segment/sample/field_test.cpp).

#pragma once

#include <limits>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

struct FieldPrimitive {
    enum class Kind {
        cone,      // two balls of radius r1 about a and r2 about b, and all balls between them
        plate,     // everything within r1 of the triangle a, b, c
        ellipsoid  // about a; b, c, d are its orthogonal half axes divided by their squared lengths
    };
    Kind kind = Kind::cone;
    Vec3 a;
    Vec3 b;
    Vec3 c;
    Vec3 d;
    double r1 = 0;
    double r2 = 0;
    double least = 0;     // of an ellipsoid: its shortest half axis
    double greatest = 0;  // and its longest
};

// Primitives joined without rounding, then added to or carved out of what is there with a joint of about `blend` mm.
struct FieldPart {
    bool is_added = true;
    double blend = 0;
    std::vector<FieldPrimitive> primitives;
};

struct Texture {
    double depth = 0;   // mm
    double period = 1;  // mm
    double phase = 0;   // of a period
};

struct BoneField {
    std::vector<FieldPart> parts;
    std::vector<Texture> textures;
    double start = std::numeric_limits<double>::infinity();  // before the first part
};

double value_at(const BoneField& field, Vec3 point);

struct FieldRange {
    double low = 0;
    double high = 0;
};

// Bounds of the value within a ball, and in `local` (may be null) what the field amounts to there.
FieldRange range_in_ball(const BoneField& field, Vec3 centre, double radius, BoneField* local);

// Builders.
FieldPrimitive cone(Vec3 a, double radius_a, Vec3 b, double radius_b);
FieldPrimitive ball(Vec3 centre, double radius);
FieldPrimitive plate(Vec3 a, Vec3 b, Vec3 c, double half_thickness);
// Half axes along x, y, z; or two of any direction, square to each other, and the length of the third.
FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axes);
FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axis_a, Vec3 half_axis_b, double half_axis_c);

struct TubeStation {
    Vec3 point;
    double radius = 0;
};
// A smooth curve through the stations, as `steps` cones between each two of them.
std::vector<FieldPrimitive> tube(const std::vector<TubeStation>& stations, int steps = 6);

// The primitives and their mirror images at the plane x = 0.
std::vector<FieldPrimitive> both_sides(std::vector<FieldPrimitive> primitives);

FieldPart added(double blend, std::vector<FieldPrimitive> primitives);
FieldPart carved(double blend, std::vector<FieldPrimitive> primitives);

}  // namespace qchopper
