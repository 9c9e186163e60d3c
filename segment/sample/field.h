// The shape of a bone as a field, an approximate signed distance function: negative inside, positive outside.
//
// mm. The shape is the isosurface at value 0 (isosurface.h). A field is a sequence of parts that are added or carved
// out one after the other with rounded joints. For a ball in space a local field can be selected that has fewer parts
// and gives the same bits there (tests/segment/sample/field_test.cpp).

#pragma once

#include <limits>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

struct FieldPrimitive {
    enum class Kind {
        cone,      // round cone: the balls of radius r1 about a and r2 about b, and all balls between them
        plate,     // all points within r1 of the triangle a, b, c
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

// A union of primitives, added to or carved out of the parts before it with a rounded joint of about `blend` mm.
struct FieldPart {
    bool is_added = true;
    double blend = 0;
    std::vector<FieldPrimitive> primitives;
};

// A periodic roughness of the whole surface.
struct Texture {
    double depth = 0;   // mm
    double period = 1;  // mm
    double phase = 0;   // of a period
};

struct BoneField {
    std::vector<FieldPart> parts;
    std::vector<Texture> textures;
    double start = std::numeric_limits<double>::infinity();  // the value before the first part
};

// An estimate of the signed distance: exact for a single cone or plate without texture. O(primitives).
double value_at(const BoneField& field, Vec3 point);

struct FieldRange {
    double low = 0;
    double high = 0;
};

// Bounds of the value within a ball. `local` receives the field reduced to the ball: there it gives the same bits.
// O(primitives).
FieldRange range_in_ball(const BoneField& field, Vec3 centre, double radius, BoneField& local);

FieldPrimitive cone(Vec3 a, double radius_a, Vec3 b, double radius_b);
FieldPrimitive ball(Vec3 centre, double radius);
FieldPrimitive plate(Vec3 a, Vec3 b, Vec3 c, double half_thickness);
// Half axes along x, y, z; or two of any direction, perpendicular to each other, and the length of the third.
FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axes);
FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axis_a, Vec3 half_axis_b, double half_axis_c);

struct TubeStation {
    Vec3 point;
    double radius = 0;
};
// Cones along a smooth curve through the stations, of which there is one or more: `steps` between each two of them.
std::vector<FieldPrimitive> tube(const std::vector<TubeStation>& stations, int steps);

// The primitives and their mirror images at the plane x = 0.
std::vector<FieldPrimitive> both_sides(std::vector<FieldPrimitive> primitives);

FieldPart added(double blend, std::vector<FieldPrimitive> primitives);
FieldPart carved(double blend, std::vector<FieldPrimitive> primitives);

}  // namespace qchopper
