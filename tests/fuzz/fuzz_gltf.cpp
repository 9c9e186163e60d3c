// The glTF reader. Bytes that begin with "glTF" are a GLB; others are read as JSON.

#include "segment/io/formats/read_gltf.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const qchopper::Bytes bytes(data, data + size);
    qchopper::try_to_read([&] { return qchopper::parse_gltf(bytes, "fuzz", {}); });
    return 0;
}
