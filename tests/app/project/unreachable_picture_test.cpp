#include "app/project/unreachable_picture.h"

#include <gtest/gtest.h>

#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A box whose triangles all have one state, but the first one, which has another.
Bytes drawn(SurfaceState state, SurfaceState first) {
    const std::vector<Piece> pieces = uncut(shapes::box({0, 0, 0}, {40, 40, 40}, 2), 0).pieces;
    std::vector<SurfaceState> states(pieces[0].mesh->triangles.size(), state);
    states[0] = first;
    const Vec3 shift{};
    const CarvedPiece carved{states, {}};
    return draw_unreachable(pieces, std::span(&shift, 1), std::span(&carved, 1));
}

TEST(UnreachablePicture, EveryStateHasAColourOfItsOwn) {
    const std::vector<SurfaceState> all{SurfaceState::reached, SurfaceState::too_narrow, SurfaceState::steep,
                                        SurfaceState::holder,  SurfaceState::hidden,     SurfaceState::ignored};
    std::vector<Bytes> pictures;
    for (const SurfaceState state : all) {
        pictures.push_back(drawn(state, state));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i], pictures.back());
    }
    EXPECT_EQ(pictures[0], drawn(SurfaceState::reached, SurfaceState::reached)) << "same input, same bytes";
}

TEST(UnreachablePicture, TheLegendNamesWhatOccurs) {
    // One triangle of 48: without the legend's entry of the holder the pictures would hardly differ.
    EXPECT_NE(drawn(SurfaceState::reached, SurfaceState::holder), drawn(SurfaceState::reached, SurfaceState::reached));
}

TEST(UnreachablePicture, APieceOfUnknownStatesIsDrawnAsReached) {
    const std::vector<Piece> pieces = uncut(shapes::box({0, 0, 0}, {40, 40, 40}, 2), 0).pieces;
    const Vec3 shift{};
    const CarvedPiece carved{};
    EXPECT_EQ(draw_unreachable(pieces, std::span(&shift, 1), std::span(&carved, 1)),
              drawn(SurfaceState::reached, SurfaceState::reached));
}

}  // namespace
}  // namespace qchopper
