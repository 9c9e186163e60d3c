// From M. Okabe and K. Ito, "Color Universal Design", 2008, with the distances enlarged for normal sight and for two
// kinds of colour blindness. No colour is too dark for shading to show.

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
