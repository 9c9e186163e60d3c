// Bytes that begin with "PK" are a job file. Mutations do not keep its checksums, so other bytes are the text of the
// ticket and, after a zero each, of the manifest and of the envelope report; they are packed here, once as they are and
// once with the sizes and hashes in the manifest made right.

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/files/zip.h"
#include "base/sha256.h"
#include "cam/job/read_job.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

Bytes to_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

// The manifest with the sizes and hashes of these files, in the one form that is taken, so that the checks after them
// are reached. A text that is no
// JSON object is unchanged.
std::string agreeing(const std::string& manifest, const std::map<std::string, Bytes>& files) {
    using Json = nlohmann::ordered_json;
    Json json = Json::parse(manifest, nullptr, false);
    if (!json.is_object()) return manifest;
    Json list = Json::array();
    for (const auto& [name, bytes] : files) {
        list.push_back({{"name", name}, {"size", bytes.size()}, {"sha256", to_hex(sha256(bytes))}});
    }
    json["files"] = list;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void try_job(const Bytes& bytes) {
    or_refused(InputFault::mesh, [&] {
        const ReadJob job = parse_job(bytes, "fuzz.qjob");
        demand(job.file_size == bytes.size() && job.file_sha256 == sha256(bytes));
        demand(job.files.size() == job.entries.size() + 1);
        std::set<std::string> names;
        for (const JobEntry& entry : job.entries) {
            demand(names.insert(entry.name).second);
            demand(job.files.at(entry.name).size() == entry.size);
            demand(sha256(job.files.at(entry.name)) == entry.sha256);
        }
        demand(job.ticket.piece == job.piece && job.ticket.stock == job.setup.block.size);
        demand(!job.stock_fit.margins.empty());
        demand(job.max_unreachable >= 0 && job.max_unreachable <= 1);
        demand(job.setup.access.unreachable_mm2() >= 0);
        try {  // it was read from a text, so its own text must be readable
            demand(ticket_template_from_json(to_json(job.ticket), "fuzz") == job.ticket);
        } catch (const InputError&) {
            std::abort();
        }
    });
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace qchopper;
    const std::string text = text_of(data, size);
    if (text.starts_with("PK")) {
        try_job({data, data + size});
        return 0;
    }
    const std::size_t end = text.find('\0');
    const std::string rest = end == std::string::npos ? "" : text.substr(end + 1);
    const std::size_t middle = rest.find('\0');
    const std::string manifest = rest.substr(0, middle);
    const std::string envelope = middle == std::string::npos ? "" : rest.substr(middle + 1);
    std::map<std::string, Bytes> files{{"envelope.json", to_bytes(envelope)},
                                       {"piece.stl", to_bytes("solid")},
                                       {"preview.glb", to_bytes("glTF")},
                                       {"setup-1.png", to_bytes("PNG")},
                                       {"setup-2.png", to_bytes("PNG")},
                                       {"setup.html", to_bytes("setup")},
                                       {"ticket.json", to_bytes(text.substr(0, end))}};
    if (manifest.find("\"cap_in_piece\"") != std::string::npos) {  // the cap of the seed
        files["template-4.pdf"] = to_bytes("%PDF");
        files["template-4.svg"] = to_bytes("svg");
    }
    const std::string right = agreeing(manifest, files);
    for (const std::string& one : {manifest, right}) {
        std::map<std::string, Bytes> all = files;
        all["manifest.json"] = to_bytes(one);
        try_job(zip(all));
    }
    return 0;
}
