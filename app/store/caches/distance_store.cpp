// One file per scan. O(triangles) for the name, O(samples x directions) for the content.

#include "app/store/caches/distance_store.h"

#include "app/store/caches/cache_file.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever distances of the same samples change.
constexpr std::uint32_t version_of_distances = 1;

fs::path file_for(const fs::path& folder, const SampledScan& scan) {
    CacheWriter out;
    out.put(version_of_distances);
    for (const auto& solid : scan.solid) {
        out.put_all(solid->points);
        out.put_all(solid->triangles);
    }
    out.put_all(scan.directions);
    for (const SurfaceSample& sample : scan.samples.sample) {
        for (const double x : {sample.point.x, sample.point.y, sample.point.z}) out.put(x);
    }
    return cache_file(folder, out, ".distances");
}

CacheWriter content_of(const std::vector<PieceAccessibility>& pieces) {
    CacheWriter out;
    out.put(pieces.size());
    for (const PieceAccessibility& piece : pieces) {
        out.put_all(piece.sample);
        out.put_all(piece.distance);
    }
    return out;
}

std::optional<std::vector<PieceAccessibility>> found_in(const fs::path& file, const SampledScan& scan) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    std::vector<PieceAccessibility> pieces = unasked_accessibility(scan);
    if (in.get<std::size_t>() != pieces.size()) return std::nullopt;
    for (PieceAccessibility& piece : pieces) {
        const std::vector<std::uint32_t> sample = in.get_all<std::uint32_t>();
        piece.distance = in.get_all<float>();
        if (sample != piece.sample || piece.distance.size() != sample.size() * scan.directions.size()) {
            return std::nullopt;
        }
    }
    if (!in.is_whole()) return std::nullopt;
    return pieces;
}

}  // namespace

DistanceStore distance_store(const fs::path& folder) {
    DistanceStore store;
    store.find = [=](const SampledScan& scan) { return found_in(file_for(folder, scan), scan); };
    store.keep = [=](const SampledScan& scan, const std::vector<PieceAccessibility>& pieces) {
        keep(file_for(folder, scan), content_of(pieces));
    };
    return store;
}

}  // namespace qchopper
