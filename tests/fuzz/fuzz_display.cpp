// Display meshes, states of their faces and ways of tools, as the bytes are, and meshes with a head that counts what
// follows; what is accepted is valid, and written again it is the same.

#include <algorithm>

#include "app/display/display_format.h"
#include "app/display/display_path.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

void read(const Bytes& bytes) {
    or_refused(InputFault::mesh, [&] {
        const DisplayMesh mesh = decode_display_mesh(bytes);
        demand(is_valid(mesh));
        demand(encode_display_mesh(mesh) == bytes);
    });
    or_refused(InputFault::mesh, [&] {
        const DisplayPath path = decode_display_path(bytes);
        demand(is_valid(path));
        demand(encode_display_path(path) == bytes);
    });
    or_refused(InputFault::mesh, [&] { demand(encode_display_states(decode_display_states(bytes)) == bytes); });
}

// Numbers of points, faces and groups from three bytes; then origin and step, positions, indices and groups, of which
// the indices take what the others leave.
Bytes with_right_head(Input in) {
    const std::uint8_t points = in.u8();
    const std::uint8_t faces = in.u8();
    const auto groups = static_cast<std::uint8_t>(in.u8() % 4);
    const Bytes body = in.bytes(1 << 16);
    const std::size_t others = 32 + 6U * points + 13U * groups;
    const std::size_t indices = body.size() < others ? 0 : body.size() - others;
    Bytes file{'Q', 'C', 'D', '1', points, 0, 0, 0, faces, 0, 0, 0};
    for (const std::size_t byte : {indices % 256, indices / 256 % 256, indices / 65536}) {
        file.push_back(static_cast<std::uint8_t>(byte));
    }
    file.insert(file.end(), {0, groups, 0, 0, 0});
    file.insert(file.end(), body.begin(), body.end());
    return file;
}

// A number of points from a byte; then grid, positions, kinds and codes, of which the codes take what the others leave.
Bytes path_with_right_head(Input in) {
    const std::uint8_t points = in.u8();
    const Bytes body = in.bytes(1 << 16);
    const std::size_t others = 32 + 7U * points;
    const std::size_t codes = body.size() < others ? 0 : body.size() - others;
    Bytes file{'Q', 'C', 'P', '1', points, 0, 0, 0};
    for (const std::size_t byte : {codes % 256, codes / 256 % 256, codes / 65536}) {
        file.push_back(static_cast<std::uint8_t>(byte));
    }
    file.push_back(0);
    file.insert(file.end(), body.begin(), body.end());
    return file;
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qchopper::read(qchopper::Bytes(data, data + size));
    qchopper::read(qchopper::with_right_head({data, size}));
    qchopper::read(qchopper::path_with_right_head({data, size}));
    return 0;
}
