// Reads a list of range scans with their first poses, as Stanford's .conf files state them.
//
// A line is "bmesh FILE tx ty tz qi qj qk qr" (or "mesh"): a translation in the unit of the scans, and a unit
// quaternion whose real part is last. Lines that begin with # or with another word, as "camera", say nothing of scans.
// The sign of qr is not agreed on: of both rotations that with which the scans come to lie together is meant
// (tests/segment/fuse/range_scan_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/pose.h"

namespace qchopper {

struct PosedScan {
    std::string file;  // beside the list
    Pose pose;         // of the scan in the common frame, by the quaternion as it is written
    Pose other;        // and with the opposite sign of qr
    bool operator==(const PosedScan&) const = default;
};

// At least two. Throws InputError (mesh), with the line, for a scan without a pose, a pose that is no rotation (the
// quaternion's length is not 1 within 1 %), one file twice, or fewer than two scans; `name` stands for the list.
std::vector<PosedScan> parse_scan_list(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
