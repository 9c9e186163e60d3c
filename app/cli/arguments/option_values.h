// Reads values of options that are one word each, and checks them. O(characters).

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/engine/discard_request.h"
#include "app/engine/work_project.h"
#include "app/jobs/entered/entered_values.h"
#include "app/store/decisions.h"
#include "cam/cell/taught_poses.h"
#include "devices/wire/modbus_tcp.h"
#include "segment/io/formats/raw_mesh.h"
#include "segment/mesh/plane.h"
#include "segment/structure/stress.h"

namespace qchopper {

// The readers return nothing for a text that they cannot read.

// "face_ratio=10,undercut=2" in any order, each at most once, or four numbers in the order face ratio, fragility, piece
// count, undercut. Weights are from 0 to 1e12.
std::optional<GivenWeights> weights_from(const std::string& text);

// The names of the methods that propose planes, each once: "none", "all", or names by commas.
std::optional<std::vector<std::string>> proposers_from(const std::string& text);

// The objectives of which a value of 1 can be forbidden.
std::vector<std::string> forbiddable();

// "nx,ny,nz,d": a direction of any length but zero, and the distance along it in mm. The normal is a unit vector.
std::optional<Plane> plane_from(const std::string& text);

// "X,Y,Z": three lengths in mm, greater than zero.
std::optional<Vec3> lengths_from(const std::string& text);

// "J1,J2,J3,J4,J5,J6=X,Y,Z,A,B,C": joints in degrees, then what the controller shows for them, mm and degrees.
std::optional<TaughtPose> taught_pose_from(const std::string& text);

// "X,Y,Z,A,B,C": mm and degrees, as the controller shows a base.
std::optional<EnteredBase> base_from(const std::string& text);

// "3=199.2": the number of a tool from 0 to 65535, and its length in mm, greater than zero.
std::optional<EnteredLength> tool_length_from(const std::string& text);

// The same as lengths_from, each at least 1.
std::optional<Vec3> print_volume_from(const std::string& text);

// "upright=+z,density=100,strength=0.5,load=weight": the load of the objective structure; any order, each at most once.
// upright is +x, -x, +y, -y, +z, -z or X:Y:Z of any length but zero; density in kg/m3, strength in MPa; load is weight,
// a force in N, or weight+FORCE. Also voxel, in mm, and poisson may be given, the others must.
std::optional<StructureOptions> load_from(const std::string& text);

// "A,C,below=50ml": names of pieces and at most one volume above 0 in mm3, cm3, ml or l, in any order.
std::optional<DiscardRequest> discard_from(const std::string& text);

// "0/4": number and count of a shard, 0 <= number < count <= 1e6.
std::optional<Shard> shard_from(const std::string& text);

// A whole number from 1 to 1e6, the place in a ranking.
std::optional<std::size_t> place_from(const std::string& text);

// As parse_tcp_address(), which throws, but port 0 is allowed: any free port.
TcpAddress listen_address(const std::string& text);

// Numbers in ascending order, each once.
std::vector<std::uint16_t> ascending(std::vector<std::uint16_t> numbers);

// Returns an empty text for a right value, else what is wrong with it, without a full stop.
using OptionCheck = std::function<std::string(const std::string&)>;

constexpr double many = 1e15;  // more than any count or length that makes sense

// `what` follows in the message: "... is not a count of faces". Both bounds are allowed values.
OptionCheck number_between(double low, double high, const std::string& what);
OptionCheck one_of(const std::vector<std::string>& values);
// For one of the readers above. `what` follows in the message: "... is not nx,ny,nz,d".
template <typename Reader>
OptionCheck read_by(Reader reader, const std::string& what) {
    return [=](const std::string& text) { return reader(text) ? std::string() : "\"" + text + "\" is " + what; };
}

// The formats of scans, for help texts.
const std::string scan_formats = std::string(mesh_formats) + ", packed by gzip or not";

// Milliseconds since 1970 of "2026-11-22 17:43:28" in UTC, as utc_text() writes it, or of a day alone, "2026-11-22",
// which is its beginning. Nothing for any other text, for no day or time, and before 1970.
std::optional<std::uint64_t> ms_from_utc(std::string_view text);

}  // namespace qchopper
