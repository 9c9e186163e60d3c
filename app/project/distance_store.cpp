// One file per scan. O(triangles) for the name, O(samples x directions) for the content.

#include "app/project/distance_store.h"

#include "app/project/cache_bytes.h"
#include "base/error.h"
#include "base/hex.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever distances of the same samples change.
constexpr std::uint32_t version_of_distances = 1;

std::string name_of_file(const SampledScan& scan) {
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
    return to_hex(sha256(out.bytes())) + ".distances";
}

Bytes to_bytes(const std::vector<PieceAccessibility>& pieces) {
    CacheWriter out;
    out.put(pieces.size());
    for (const PieceAccessibility& piece : pieces) {
        out.put_all(piece.sample);
        out.put_all(piece.distance);
    }
    return sealed(std::move(out.bytes()));
}

std::optional<std::vector<PieceAccessibility>> from_bytes(std::span<const std::uint8_t> bytes,
                                                          const SampledScan& scan) {
    const auto body = unsealed(bytes);
    if (!body) return std::nullopt;
    CacheReader in(*body);
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
    store.find = [=](const SampledScan& scan) -> std::optional<std::vector<PieceAccessibility>> {
        try {
            return from_bytes(read_file(folder / name_of_file(scan)), scan);
        } catch (const InputError&) {
            return std::nullopt;
        }
    };
    store.keep = [=](const SampledScan& scan, const std::vector<PieceAccessibility>& pieces) {
        std::error_code error;
        fs::create_directories(folder, error);
        try {
            write_file(folder / name_of_file(scan), to_bytes(pieces));
        } catch (const InputError&) {  // a full disk costs time, not work
        }
    };
    return store;
}

}  // namespace qchopper
