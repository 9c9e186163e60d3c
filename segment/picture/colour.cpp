// Begun from Okabe and Ito's scheme (2008), then moved apart as seen with all and with two kinds of cones
// (tests/segment/picture/colour_test.cpp). Not too dark, so that shading shows on all of them.

#include <array>

#include "segment/picture/colour.h"

namespace qchopper {

Rgb piece_colour(std::size_t index) {
    static constexpr std::array<Rgb, 12> palette{{{85, 144, 226},
                                                  {244, 192, 42},
                                                  {38, 181, 135},
                                                  {202, 97, 163},
                                                  {238, 226, 131},
                                                  {33, 75, 159},
                                                  {241, 58, 30},
                                                  {183, 228, 210},
                                                  {131, 36, 101},
                                                  {127, 167, 78},
                                                  {160, 195, 244},
                                                  {104, 85, 64}}};
    return palette[index % palette.size()];
}

}  // namespace qchopper
