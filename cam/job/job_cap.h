// The caps of a piece in its job: with which pieces they are joined, and the holes for the dowels.
//
// Values; mm. The frame of a cap has z along its outward normal and its origin in the least corner of the cap's
// rectangle, so that it is what one sees who looks at the cap.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/pose.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

struct JobHole {
    std::size_t number = 0;  // from 1, through all caps of the piece in their order
    double diameter = 0;
    double depth = 0;
    Point2 on_cap;          // of its middle, in the frame of the cap
    Vec3 point;             // the same in setup coordinates
    Vec3 axis;              // unit vector in setup coordinates, into the piece
    bool by_robot = false;  // the program of the job drills it; otherwise by hand with the template
    std::string by_hand;    // why it is not the robot's, without a full stop; empty: it is, or nobody has said so yet
    bool operator==(const JobHole&) const = default;
};

// What one piece touches of a cap.
struct CapJoint {
    std::string neighbour;
    double area_mm2 = 0;  // of the contact
    std::string note;     // what is wrong with the joint, for people; empty: nothing
    std::vector<JobHole> holes;
    bool operator==(const CapJoint&) const = default;
};

struct JobCap {
    std::int32_t cut = 0;
    Pose cap_in_piece;
    std::vector<CapJoint> joints;
    bool operator==(const JobCap&) const = default;
};

// A cap with what its template draws, in the frame of the cap.
struct DrawnCap {
    JobCap cap;
    std::vector<std::vector<Point2>> outline;
    std::vector<Point2> names_at;  // one per joint: where the neighbour's name stands
    Point2 size;                   // of the rectangle around the outline
    // Of a cap that is a sawn side of the block: the corners of that side. The template is laid along its edges,
    // because the holes are drilled before the outline is milled.
    std::vector<Point2> block_side = {};
};

// All holes in the order of their numbers.
std::vector<JobHole> holes_of(const std::vector<JobCap>& caps);

// "template-3.svg", "template-3.pdf", of the cap of cut 3.
std::string template_name(std::int32_t cut, const std::string& ending);

}  // namespace qchopper
