// A file of kept evaluations, as it is and with its SHA-256 made right.

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/store/caches/evaluation_store.h"
#include "base/sha256.h"
#include "tests/fuzz/demand.h"
#include "tests/fuzz/memory_folder.h"

namespace qchopper {
namespace {

// The name of such a file is the SHA-256 of its piece, and its last bytes are the SHA-256 of the rest. So it is written
// where the store reads it.
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
    bytes.insert(bytes.end(), digest.bytes.begin(), digest.bytes.end());
    cache.read(bytes);
    return 0;
}
