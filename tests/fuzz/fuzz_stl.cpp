// Both STL readers: the text reader gets the bytes as they are, the binary reader gets them cut to whole triangles with
// the right count, which no mutation would find.

#include "segment/io/formats/read_stl.h"
#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qchopper::Bytes bytes(data, data + size);
    qchopper::try_to_read([&] { return qchopper::parse_ascii_stl(bytes, "fuzz"); });
    if (size < 84) return 0;
    const std::size_t count = (size - 84) / 50;
    bytes.resize(84 + 50 * count);
    for (std::size_t i = 0; i < 4; ++i) bytes[80 + i] = static_cast<std::uint8_t>(count >> 8 * i);
    if (!qchopper::is_binary_stl(bytes)) std::abort();
    for (const bool weld : {false, true}) {
        qchopper::try_to_read([&] { return qchopper::parse_binary_stl(bytes, "fuzz", weld); });
    }
    return 0;
}
