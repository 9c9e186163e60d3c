#include "app/store/caches/evaluation_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/files/file.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

struct EvaluationFiles : ::testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("cache" + std::to_string(::getpid()));
    void TearDown() override { fs::remove_all(folder); }

    // Ranks every piece by a cache of its own beside these files; returns how many it had to evaluate.
    std::size_t evaluated(const Segmentation& segmentation, const SearchSettings& settings) const {
        EvaluationCache cache(settings.objectives, settings.candidates,
                              evaluation_store(folder, settings.objectives, settings.candidates));
        for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
            EvaluationCache without(settings.objectives, settings.candidates);
            EXPECT_EQ(rank(segmentation, p, settings, cache, {}), rank(segmentation, p, settings, without, {}));
        }
        return cache.evaluated_count();
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
        return all;
    }
};

Segmentation some_pieces(const SearchSettings& settings) {
    Segmentation segmentation = uncut(shapes::linked_tori(), 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    SearchSettings search_settings = settings;
    search_settings.stop.min_cuts = 2;
    search(segmentation, search_settings, cache, {}, [](const Segmentation&) {}, {});
    return segmentation;
}

SearchSettings quick() {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = 5;
    return settings;
}

TEST_F(EvaluationFiles, AnotherCacheFindsEveryEvaluationToTheLastBit) {
    const SearchSettings settings = quick();
    const Segmentation segmentation = some_pieces(settings);
    EXPECT_EQ(evaluated(segmentation, settings), segmentation.pieces.size());
    EXPECT_EQ(evaluated(segmentation, settings), 0U);
    SearchSettings other = settings;
    other.objectives.weights = {1, 2, 3, 4};
    other.objectives.face_ratio_threshold = 3;
    EXPECT_EQ(evaluated(segmentation, other), 0U) << "weights and thresholds are no part of an evaluation";
}

TEST_F(EvaluationFiles, OtherSettingsOrPiecesFindNothing) {
    const SearchSettings settings = quick();
    const Segmentation segmentation = uncut(shapes::linked_tori(), 0);
    const std::size_t count = segmentation.pieces.size();
    EXPECT_EQ(evaluated(segmentation, settings), count);
    SearchSettings other = settings;
    other.objectives.undercut_by_area = false;
    EXPECT_EQ(evaluated(segmentation, other), count);
    other = settings;
    other.objectives.fragility_form = FragilityForm::thesis;
    EXPECT_EQ(evaluated(segmentation, other), count);
    other = settings;
    other.objectives.fragility_distance = 7;
    EXPECT_EQ(evaluated(segmentation, other), count);
    other = settings;
    other.candidates.offsets_per_normal = 6;
    EXPECT_EQ(evaluated(segmentation, other), count);
    EXPECT_EQ(evaluated(uncut(shapes::moved(shapes::linked_tori(), {0, 0, 1}), 0), settings), count);
}

TEST_F(EvaluationFiles, BrokenFilesAreAsIfTheyWereNotThere) {
    const SearchSettings settings = quick();
    const Segmentation segmentation = uncut(shapes::torus({0, 0, 0}, 40, 12), 0);
    evaluated(segmentation, settings);
    ASSERT_EQ(files().size(), 1U);
    const fs::path file = files().front();
    const Bytes whole = read_file(file);
    for (std::size_t length = 0; length < whole.size(); length += whole.size() / 7 + 1) {
        write_file(file, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        EXPECT_EQ(evaluated(segmentation, settings), 1U) << length;
    }
    for (std::size_t at = 0; at < whole.size(); at += whole.size() / 7 + 1) {
        Bytes turned = whole;
        turned[at] ^= 0x10;
        write_file(file, turned);
        EXPECT_EQ(evaluated(segmentation, settings), 1U) << at;
    }
    fs::remove_all(folder);
    EXPECT_EQ(evaluated(segmentation, settings), 1U) << "deleting is always safe";
    EXPECT_EQ(evaluated(segmentation, settings), 0U);
}

TEST_F(EvaluationFiles, WhereNothingCanBeWrittenEvaluationsStillCome) {
    write_file(folder, std::string_view("in the way"));  // a file where the folder should be
    const SearchSettings settings = quick();
    EXPECT_EQ(evaluated(uncut(shapes::torus({0, 0, 0}, 40, 12), 0), settings), 1U);
}

}  // namespace
}  // namespace qchopper
