// One file per scan. O(triangles) for the name, O(points) for the content.

#include "app/store/caches/seam_cost_store.h"

#include <optional>

#include "app/store/caches/cache_file.h"
#include "segment/objectives/seam_cost.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever the costs of the same solids change.
constexpr std::uint32_t version_of_costs = 1;

using Costs = std::shared_ptr<const std::vector<float>>;

fs::path file_for(const fs::path& folder, std::span<const Piece> uncut) {
    CacheWriter out;
    out.put(version_of_costs);
    out.put(default_asked_points);
    for (const Piece& piece : uncut) {
        out.put_all(piece.mesh->points);
        out.put_all(piece.mesh->triangles);
    }
    return cache_file(folder, out, ".seams");
}

CacheWriter content_of(std::span<const Piece> uncut) {
    CacheWriter out;
    for (const Piece& piece : uncut) out.put_all(*piece.seam_cost);
    return out;
}

std::optional<std::vector<Costs>> found_in(const fs::path& file, std::span<const Piece> uncut) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    std::vector<Costs> costs;
    for (const Piece& piece : uncut) {
        costs.push_back(std::make_shared<const std::vector<float>>(in.get_all<float>()));
        if (costs.back()->size() != piece.mesh->points.size()) return std::nullopt;
    }
    if (!in.is_whole()) return std::nullopt;
    return costs;
}

}  // namespace

void find_kept_seam_costs(const fs::path& folder, std::span<Piece> uncut, const Context& context) {
    if (folder.empty()) return find_seam_costs(uncut, context);
    const fs::path file = file_for(folder, uncut);
    if (std::optional<std::vector<Costs>> found = found_in(file, uncut)) {
        for (std::size_t p = 0; p < uncut.size(); ++p) uncut[p].seam_cost = std::move((*found)[p]);
        return;
    }
    find_seam_costs(uncut, context);
    keep(file, content_of(uncut));
}

}  // namespace qchopper
