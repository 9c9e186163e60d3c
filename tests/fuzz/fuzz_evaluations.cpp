#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/project/evaluation_store.h"
#include "base/sha256.h"
#include "tests/fuzz/demand.h"
#include "tests/fuzz/memory_folder.h"

namespace qchopper {
namespace {

// A file of evaluations bears the SHA-256 of its piece as name and of itself as end, so it is put where the cache looks
// for it, once as it is and once with the right end.
struct Cache {
    MemoryFolder folder;
    EvaluationStore store = evaluation_store(folder.path, {}, {});
    Piece piece{"A", std::make_shared<const TriangleMesh>(), {}};
    std::filesystem::path file;

    Cache() {
        store.keep(piece, {});
        file = std::filesystem::directory_iterator(folder.path)->path();
    }

    void read(const Bytes& bytes) const {
        write_file(file, bytes);
        const std::optional<PieceEvaluations> evaluations = store.find(piece);
        if (!evaluations) return;
        demand(evaluations->candidates.size() == evaluations->evaluations.size());
        store.keep(piece, *evaluations);
        const Bytes again = read_file(file);
        demand(again.size() == bytes.size());
        demand(store.find(piece).has_value());
    }
};

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const qchopper::Cache cache;
    qchopper::Bytes bytes(data, data + size);
    cache.read(bytes);
    const qchopper::Sha256 digest = qchopper::sha256(bytes);
    bytes.insert(bytes.end(), digest.begin(), digest.end());
    cache.read(bytes);
    return 0;
}
