#include "app/pictures/deviation_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/parallel.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

const TriangleMesh& piece() {
    static const TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 30, 20}, 2);
    return mesh;
}

// All triangles deviate by the same.
Bytes drawn(float deviation) {
    const std::vector<float> values(piece().triangles.size(), deviation);
    return deviation_picture(piece(), values);
}

TEST(DeviationPicture, EveryRangeHasAColourOfItsOwn) {
    constexpr std::array<float, 6> one_of_each{-1, -0.1F, 0, 0.5F, 1, 10};
    std::vector<Bytes> pictures;
    for (const float value : one_of_each) {
        pictures.push_back(drawn(value));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i], pictures.back()) << value;
    }
    EXPECT_EQ(drawn(0.74F), drawn(0.31F)) << "both within the same range";
    EXPECT_EQ(drawn(-0.24F), drawn(-0.06F)) << "both within the same range";
}

TEST(DeviationPicture, BothSidesAreShown) {
    const Bytes even = drawn(0);
    for (std::size_t t = 0; t < piece().triangles.size(); ++t) {
        std::vector<float> values(piece().triangles.size(), 0);
        values[t] = 10;
        EXPECT_NE(deviation_picture(piece(), values), even) << "triangle " << t << " is not to be seen";
    }
}

TEST(DeviationPicture, WhatIsGivenUpHasAColourOfItsOwnAndStandsInTheLegendIfThereIsAny) {
    const std::size_t count = piece().triangles.size();
    const std::vector<float> values(count, 1);
    const Bytes none = deviation_picture(piece(), values, std::vector<bool>(count, false));
    EXPECT_EQ(none, deviation_picture(piece(), values));
    std::vector<bool> one(count, false);
    one[3] = true;
    const Bytes some = deviation_picture(piece(), values, one);
    EXPECT_NE(some, none);
    EXPECT_NE(some, deviation_picture(piece(), values, std::vector<bool>(count, true)));
}

TEST(DeviationPicture, SameBytesWhateverTheNumberOfThreads) {
    std::vector<float> values;
    for (std::size_t t = 0; t < piece().triangles.size(); ++t) values.push_back(0.3F * static_cast<float>(t) - 2);
    const Bytes several = deviation_picture(piece(), values);
    const ThreadLimit one(1);
    EXPECT_EQ(deviation_picture(piece(), values), several);
}

}  // namespace
}  // namespace qchopper
