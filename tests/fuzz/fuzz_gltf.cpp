#include "segment/io/read_gltf.h"
#include "tests/fuzz/reader.h"

// Whatever begins with "glTF" is a GLB; everything else is taken for JSON.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const qchopper::Bytes bytes(data, data + size);
    qchopper::try_to_read([&] { return qchopper::parse_gltf(bytes, "fuzz", {}); });
    return 0;
}
