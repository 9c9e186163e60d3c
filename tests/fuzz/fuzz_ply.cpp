// The PLY reader.

#include "segment/io/formats/read_ply.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const qchopper::Bytes bytes(data, data + size);
    qchopper::try_to_read([&] { return qchopper::parse_ply(bytes, "fuzz"); });
    return 0;
}
