// Scallop height: what stays between two neighbouring passes of a ball.
//
// mm. The ball centres of two passes lie `chord` apart, square to the passes; the surface on which the centres would
// lie if every point were cut runs `bulge` above the middle of that chord (negative: below it), along its normal. A
// plane of slope t with a step s has chord s / cos t and no bulge; a convex surface of radius rho has a bulge of
// (rho + R) - sqrt((rho + R)^2 - s^2 / 4), a bowl the negative of the same with rho - R.

#pragma once

namespace qchopper {

// Infinite where the balls do not overlap, chord >= 2 * radius. Precondition: radius > 0.
double scallop_height(double radius, double chord, double bulge = 0);

// The chord at which the scallop height on a plane is h. Precondition: 0 < h <= radius.
double chord_for_scallop(double radius, double h);

}  // namespace qchopper
