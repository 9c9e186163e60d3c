// The text of a cell file for a known arm: the arm as published, all else plausible, marked as assumed, and to be
// edited.
//
// The arm stands in the cell's origin with its foot on the floor. Spindle, tools and blocks are those of the ready
// cells; an arm of less than 30 kg payload has a lighter spindle and no long or wide tools. The table stands where the
// arm holds the tool straight down (straight_down_box.h). parse_cell() takes every text
// (tests/cam/cell/new_cell_test.cpp).

#pragma once

#include <string>

#include "cam/cell/known_arms.h"

namespace qchopper {

struct NewCell {
    std::string name;  // of the cell, at most 60 bytes
    int id = 1;        // 1 to 65535
};

// Throws InputError (use) where the arm is too small for any table. O(places of straight_down_box).
std::string new_cell_text(const KnownArm& arm, const NewCell& cell);

}  // namespace qchopper
