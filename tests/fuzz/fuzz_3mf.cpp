// Bytes that begin with "PK" are a package. Mutations do not keep the checksums of one, so other bytes are the text of
// its model, or of two models with a zero between them, and are packed here.

#include <string>

#include "segment/io/formats/read_3mf.h"
#include "tests/fuzz/reader.h"
#include "tests/segment/io/wrappings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const qchopper::Bytes bytes(data, data + size);
    if (qchopper::is_3mf(bytes)) {
        qchopper::try_to_read([&] { return qchopper::parse_3mf(bytes, "fuzz"); });
        return 0;
    }
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t end = text.find('\0');
    std::vector<std::pair<std::string, std::string>> parts{{"3D/a.model", text.substr(0, end)}};
    if (end != std::string::npos) parts.emplace_back("3D/b.model", text.substr(end + 1));
    const qchopper::Bytes package = qchopper::package_3mf(parts);
    qchopper::try_to_read([&] { return qchopper::parse_3mf(package, "fuzz"); });
    return 0;
}
