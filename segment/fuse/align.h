// Moves scans until they lie together, all of them at once, the first one fixed.
//
// In the unit of the scans. Iterative closest points: points of each scan are paired with the nearest point of every
// other scan that is near, the squared distances to the planes there are made least over the motions of all scans
// together, and again (P. Besl and N. McKay, "A method for registration of 3-D shapes" (1992); to planes: Y. Chen and
// G. Medioni, "Object modelling by registration of multiple range images" (1992); all together: K. Pulli, "Multiview
// registration for large data sets" (1999)). Dropped are pairs that are too far apart, at borders, or of normals more
// than 45 degrees apart; the others are weighted by Tukey's biweight. The result does not depend on the number of
// threads (tests/segment/fuse/fuse_test.cpp).

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/context.h"
#include "base/pose.h"
#include "segment/fuse/scan_surface.h"

namespace qchopper {

struct AlignOptions {
    double spacing = 0;  // of the points of a scan: pairs are sought from 3 times that, or farther at first
    std::size_t points_per_scan = 1500;
    int max_rounds = 60;
};

struct AlignedScan {
    Pose pose;              // of the scan in the frame of the list
    std::size_t pairs = 0;  // with other scans
    double residual = 0;    // the median distance of its pairs from the planes; 0 without pairs
};

struct Alignment {
    std::vector<AlignedScan> scans;  // in the order of the surfaces
    double residual = 0;             // the median of all pairs
    int rounds = 0;
};

// How far apart the scans lie: the mean distance of points of each from the nearest of any other, none counted as more
// than `limit`; infinite without a point. Both spans have the same size. Throws Cancelled.
double apart(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, double limit,
             const Context& context = {});

// From these first poses. Throws Cancelled. Preconditions: at least one surface, as many poses, spacing > 0.
Alignment align(std::span<const ScanSurface> surfaces, std::span<const Pose> poses, const AlignOptions& options,
                const Context& context = {});

}  // namespace qchopper
