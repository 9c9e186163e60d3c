// Distances after I. Quilez, "Distance functions" (2013-2020): round cone, triangle, ellipsoid estimate; the joints are
// his quadratic smooth minimum, which is an exact minimum where the two differ by more than the blend. Tubes along the
// splines of E. Catmull and R. Rom, "A class of local interpolating splines" (1974). O(primitives) a point.

#include "segment/sample/field.h"

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

double squared(Vec3 v) {
    return dot(v, v);
}

double distance_to_cone(const FieldPrimitive& cone, Vec3 p) {
    const Vec3 axis = cone.b - cone.a;
    const double length2 = squared(axis);
    const double slope = cone.r1 - cone.r2;
    const double straight2 = length2 - slope * slope;
    const Vec3 from_a = p - cone.a;
    if (!(straight2 > 0)) {  // one ball contains the other
        return std::min(norm(from_a) - cone.r1, norm(p - cone.b) - cone.r2);
    }
    const double y = dot(from_a, axis);
    const double z = y - length2;
    const double x2 = squared(length2 * from_a - y * axis);
    const double y2 = y * y * length2;
    const double z2 = z * z * length2;
    const double k = std::copysign(slope * slope * x2, slope);
    if (std::copysign(straight2 * z2, z) > k) return std::sqrt(x2 + z2) / length2 - cone.r2;
    if (std::copysign(straight2 * y2, y) < k) return std::sqrt(x2 + y2) / length2 - cone.r1;
    return (std::sqrt(x2 * straight2 / length2) + y * slope) / length2 - cone.r1;
}

double squared_to_edge(Vec3 edge, Vec3 p) {
    return squared(std::clamp(dot(edge, p) / squared(edge), 0.0, 1.0) * edge - p);
}

double distance_to_plate(const FieldPrimitive& plate, Vec3 p) {
    const Vec3 ab = plate.b - plate.a;
    const Vec3 bc = plate.c - plate.b;
    const Vec3 ca = plate.a - plate.c;
    const Vec3 from_a = p - plate.a;
    const Vec3 from_b = p - plate.b;
    const Vec3 from_c = p - plate.c;
    const Vec3 normal = cross(ab, plate.c - plate.a);
    const bool is_over =
        dot(cross(normal, ab), from_a) > 0 && dot(cross(normal, bc), from_b) > 0 && dot(cross(normal, ca), from_c) > 0;
    if (is_over) return std::abs(dot(normal, from_a)) / norm(normal) - plate.r1;
    const double d2 = std::min({squared_to_edge(ab, from_a), squared_to_edge(bc, from_b), squared_to_edge(ca, from_c)});
    return std::sqrt(d2) - plate.r1;
}

// The point in units of the half axes.
Vec3 in_half_axes(const FieldPrimitive& e, Vec3 p) {
    const Vec3 q = p - e.a;
    return {dot(e.b, q), dot(e.c, q), dot(e.d, q)};
}

double distance_to_ellipsoid(const FieldPrimitive& e, Vec3 p) {
    const Vec3 q = in_half_axes(e, p);
    const double k0 = norm(q);
    const double k1 = norm(q.x * e.b + q.y * e.c + q.z * e.d);
    return k1 > 0 ? std::clamp(k0 / k1, e.least, e.greatest) * (k0 - 1) : -e.least;
}

double distance_to(const FieldPrimitive& primitive, Vec3 p) {
    switch (primitive.kind) {
        case FieldPrimitive::Kind::cone:
            return distance_to_cone(primitive, p);
        case FieldPrimitive::Kind::plate:
            return distance_to_plate(primitive, p);
        case FieldPrimitive::Kind::ellipsoid:
            break;
    }
    return distance_to_ellipsoid(primitive, p);
}

FieldRange range_of(const FieldPrimitive& primitive, Vec3 centre, double radius) {
    if (primitive.kind != FieldPrimitive::Kind::ellipsoid) {
        const double d = distance_to(primitive, centre);
        return {d - radius, d + radius};
    }
    const double k0 = norm(in_half_axes(primitive, centre));
    const double low = k0 - radius / primitive.least - 1;
    const double high = k0 + radius / primitive.least - 1;
    return {low * (low > 0 ? primitive.least : primitive.greatest),
            high * (high > 0 ? primitive.greatest : primitive.least)};
}

double smooth_min(double a, double b, double blend) {
    const double h = blend > 0 ? std::max(blend - std::abs(a - b), 0.0) / blend : 0;
    return std::min(a, b) - h * h * blend * 0.25;
}

// Joins a part's distance to the value so far.
double joined(double value, double distance, const FieldPart& part) {
    return part.is_added ? smooth_min(value, distance, part.blend) : -smooth_min(-value, distance, part.blend);
}

// A sine approximated by parabolas: no library function, so that every machine gets the same bits.
double wave(double turns) {
    const double x = turns - std::floor(turns);
    return x < 0.5 ? 16 * x * (0.5 - x) : -16 * (x - 0.5) * (1 - x);
}

double texture_at(const Texture& texture, Vec3 p) {
    const double s = 1 / texture.period;
    const double u = wave(s * (p.x + 0.31 * p.y) + texture.phase);
    const double v = wave(s * (p.y - 0.27 * p.z) + 2 * texture.phase);
    const double w = wave(s * (p.z + 0.23 * p.x) + 3 * texture.phase);
    return texture.depth * (u * v + v * w + w * u) / 3;
}

// A margin for rounding where bounds decide which parts are omitted.
constexpr double safe_mm = 1e-6;

}  // namespace

double value_at(const BoneField& field, Vec3 point) {
    double value = field.start;
    for (const FieldPart& part : field.parts) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const FieldPrimitive& primitive : part.primitives) {
            nearest = std::min(nearest, distance_to(primitive, point));
        }
        value = joined(value, nearest, part);
    }
    for (const Texture& texture : field.textures) value += texture_at(texture, point);
    return value;
}

FieldRange range_in_ball(const BoneField& field, Vec3 centre, double radius, BoneField& local) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    FieldRange value{field.start, field.start};
    local = {{}, field.textures, field.start};
    for (const FieldPart& part : field.parts) {
        std::vector<FieldRange> ranges;
        FieldRange nearest{infinity, infinity};
        for (const FieldPrimitive& primitive : part.primitives) {
            ranges.push_back(range_of(primitive, centre, radius));
            nearest.low = std::min(nearest.low, ranges.back().low);
            nearest.high = std::min(nearest.high, ranges.back().high);
        }
        const FieldRange before = value;
        value = {joined(value.low, part.is_added ? nearest.low : nearest.high, part),
                 joined(value.high, part.is_added ? nearest.high : nearest.low, part)};
        // a carving is an addition to the value of opposite sign
        const FieldRange other = part.is_added ? before : FieldRange{-before.high, -before.low};
        if (nearest.low > other.high + part.blend + safe_mm) continue;  // too far to matter
        if (other.low > nearest.high + part.blend + safe_mm) {          // nothing before it matters
            local.parts.clear();
            local.start = part.is_added ? infinity : -infinity;
        }
        local.parts.push_back({part.is_added, part.blend, {}});
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            if (ranges[i].low > nearest.high + safe_mm) continue;
            local.parts.back().primitives.push_back(part.primitives[i]);
        }
    }
    for (const Texture& texture : field.textures) {
        value.low -= texture.depth;
        value.high += texture.depth;
    }
    return value;
}

FieldPrimitive cone(Vec3 a, double radius_a, Vec3 b, double radius_b) {
    FieldPrimitive primitive;
    primitive.a = a;
    primitive.b = b;
    primitive.r1 = radius_a;
    primitive.r2 = radius_b;
    return primitive;
}

FieldPrimitive ball(Vec3 centre, double radius) {
    return ellipsoid(centre, {radius, radius, radius});
}

FieldPrimitive plate(Vec3 a, Vec3 b, Vec3 c, double half_thickness) {
    FieldPrimitive primitive;
    primitive.kind = FieldPrimitive::Kind::plate;
    primitive.a = a;
    primitive.b = b;
    primitive.c = c;
    primitive.r1 = half_thickness;
    return primitive;
}

FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axes) {
    return ellipsoid(centre, {half_axes.x, 0, 0}, {0, half_axes.y, 0}, half_axes.z);
}

FieldPrimitive ellipsoid(Vec3 centre, Vec3 half_axis_a, Vec3 half_axis_b, double half_axis_c) {
    FieldPrimitive primitive;
    primitive.kind = FieldPrimitive::Kind::ellipsoid;
    primitive.a = centre;
    primitive.b = (1 / squared(half_axis_a)) * half_axis_a;
    primitive.c = (1 / squared(half_axis_b)) * half_axis_b;
    primitive.d = (1 / half_axis_c) * normalized(cross(half_axis_a, half_axis_b));
    primitive.least = std::min({norm(half_axis_a), norm(half_axis_b), half_axis_c});
    primitive.greatest = std::max({norm(half_axis_a), norm(half_axis_b), half_axis_c});
    return primitive;
}

std::vector<FieldPrimitive> tube(const std::vector<TubeStation>& stations, int steps) {
    const auto station = [&](std::size_t i, int offset) {
        const auto last = static_cast<int>(stations.size()) - 1;
        return stations[static_cast<std::size_t>(std::clamp(static_cast<int>(i) + offset, 0, last))];
    };
    std::vector<FieldPrimitive> cones;
    TubeStation from = stations.front();
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        for (int step = 1; step <= steps; ++step) {
            // the same spline for the radius
            const double t = static_cast<double>(step) / steps;
            const double w0 = -0.5 * t + t * t - 0.5 * t * t * t;
            const double w1 = 1 - 2.5 * t * t + 1.5 * t * t * t;
            const double w2 = 0.5 * t + 2 * t * t - 1.5 * t * t * t;
            const double w3 = -0.5 * t * t + 0.5 * t * t * t;
            TubeStation to;
            to.point = w0 * station(i, -1).point + w1 * station(i, 0).point + w2 * station(i, 1).point +
                       w3 * station(i, 2).point;
            to.radius = w0 * station(i, -1).radius + w1 * station(i, 0).radius + w2 * station(i, 1).radius +
                        w3 * station(i, 2).radius;
            cones.push_back(cone(from.point, from.radius, to.point, to.radius));
            from = to;
        }
    }
    return cones;
}

std::vector<FieldPrimitive> both_sides(std::vector<FieldPrimitive> primitives) {
    const std::size_t count = primitives.size();
    for (std::size_t i = 0; i < count; ++i) {
        FieldPrimitive mirror = primitives[i];
        for (Vec3* v : {&mirror.a, &mirror.b, &mirror.c, &mirror.d}) v->x = -v->x;
        primitives.push_back(mirror);
    }
    return primitives;
}

FieldPart added(double blend, std::vector<FieldPrimitive> primitives) {
    return {true, blend, std::move(primitives)};
}

FieldPart carved(double blend, std::vector<FieldPrimitive> primitives) {
    return {false, blend, std::move(primitives)};
}

}  // namespace qchopper
