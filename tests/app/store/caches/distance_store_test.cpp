#include "app/store/caches/distance_store.h"

#include <gtest/gtest.h>

#include "base/files/file.h"
#include "segment/search/segmentation.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct DistanceFiles : ::testing::Test {
    Folder folder;
    fs::path cache() const { return folder.path / "cache"; }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(cache())) all.push_back(entry.path());
        return all;
    }
    // The distances of a scan, by a store that keeps them here; whether rays were cast for them.
    std::pair<std::vector<std::vector<float>>, bool> distances(const TriangleMesh& scan) const {
        Segmentation segmentation = uncut(scan, 0);
        DistanceStore store = distance_store(cache());
        bool were_cast = false;
        const auto keep = store.keep;
        store.keep = [&](const SampledScan& s, const std::vector<PieceAccessibility>& pieces) {
            were_cast = true;
            keep(s, pieces);
        };
        sample_uncut(segmentation.pieces, store, 400);
        std::vector<std::vector<float>> all;
        for (const Piece& piece : segmentation.pieces) all.push_back(piece.samples->accessibility.distance);
        return {all, were_cast};
    }
};

TEST_F(DistanceFiles, AreFoundAgainForTheSameScanOnly) {
    const auto first = distances(shapes::linked_tori());
    EXPECT_TRUE(first.second);
    const auto second = distances(shapes::linked_tori());
    EXPECT_FALSE(second.second);
    EXPECT_EQ(second.first, first.first);
    TriangleMesh other = shapes::linked_tori();
    other.points[7].x += 1e-9;
    EXPECT_TRUE(distances(other).second);
    EXPECT_EQ(files().size(), 2U);
}

TEST_F(DistanceFiles, ThatAreDamagedOrCutShortAreIgnored) {
    const auto whole = distances(shapes::linked_tori());
    const fs::path file = files().front();
    const Bytes good = read_file(file);
    for (const std::size_t at : {std::size_t{0}, std::size_t{9}, good.size() / 2, good.size() - 1}) {
        Bytes bad = good;
        bad[at] ^= 1;
        write_file(file, bad);
        EXPECT_TRUE(distances(shapes::linked_tori()).second) << at;
        EXPECT_EQ(read_file(file), good) << "written again";
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{31}, good.size() / 3}) {
        write_file(file, Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)));
        const auto again = distances(shapes::linked_tori());
        EXPECT_TRUE(again.second) << size;
        EXPECT_EQ(again.first, whole.first);
    }
}

TEST_F(DistanceFiles, ThatCannotBeWrittenCostTimeOnly) {
    write_file(cache(), Bytes{1});  // a file where the folder would be
    EXPECT_TRUE(distances(shapes::linked_tori()).second);
    EXPECT_TRUE(distances(shapes::linked_tori()).second);
}

}  // namespace
}  // namespace qchopper
