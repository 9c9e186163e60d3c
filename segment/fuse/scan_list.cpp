// Line by line. O(bytes).

#include "segment/fuse/scan_list.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace qchopper {
namespace {

constexpr std::size_t max_scans = 1000;

// The words of a line, apart by spaces or tabs.
std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view space = " \t\r";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(space); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(space, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(space, end);
    }
    return words;
}

Pose pose_of(Vec3 shift, Vec3 q, double real) {
    const auto [x, y, z] = q;
    return {{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - z * real), 2 * (x * z + y * real)},
             Vec3{2 * (x * y + z * real), 1 - 2 * (x * x + z * z), 2 * (y * z - x * real)},
             Vec3{2 * (x * z - y * real), 2 * (y * z + x * real), 1 - 2 * (x * x + y * y)}},
            shift};
}

class ListReader {
 public:
    explicit ListReader(const std::string& name) : name_(name) {}

    void read_line(std::string_view line) {
        ++line_;
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty() || (words[0] != "bmesh" && words[0] != "mesh")) return;
        if (words.size() != 9) refuse("a scan needs its file and its pose, tx ty tz qi qj qk qr", "state the pose");
        std::array<double, 7> number{};
        for (std::size_t i = 0; i < number.size(); ++i) number[i] = number_in(words[i + 2]);
        const double length = std::hypot(std::hypot(number[3], number[4], number[5]), number[6]);
        if (!(std::abs(length - 1) <= 0.01)) {
            refuse("the quaternion has length " + significant(length, 3) + ": this is no rotation", "state a rotation");
        }
        const Vec3 shift{number[0], number[1], number[2]};
        const Vec3 q = (1 / length) * Vec3{number[3], number[4], number[5]};
        const double real = number[6] / length;
        const std::string file(words[1]);
        if (std::ranges::find(scans, file, &PosedScan::file) != scans.end()) {
            refuse(file + " is listed twice", "list each scan once");
        }
        if (scans.size() == max_scans) refuse("more than 1,000 scans are listed", "fuse them in groups");
        scans.push_back({file, pose_of(shift, q, real), pose_of(shift, q, -real)});
    }

    std::vector<PosedScan> scans;

 private:
    [[noreturn]] void refuse(const std::string& what, const std::string& to_do) const {
        throw InputError(InputFault::mesh, name_ + ", line " + std::to_string(line_) + ": " + what, to_do);
    }

    double number_in(std::string_view word) const {
        double number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) {
            refuse("\"" + std::string(word) + "\" is no number", "state the pose as tx ty tz qi qj qk qr");
        }
        return number;
    }

    const std::string& name_;
    std::size_t line_ = 0;
};

}  // namespace

std::vector<PosedScan> parse_scan_list(const Bytes& bytes, const std::string& name) {
    std::string_view rest{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    ListReader reader(name);
    while (!rest.empty()) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        reader.read_line(rest.substr(0, length));
        rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    if (reader.scans.size() < 2) {
        throw InputError(InputFault::mesh, name + " lists fewer than two scans",
                         "list each scan in a line \"bmesh FILE tx ty tz qi qj qk qr\"");
    }
    return std::move(reader.scans);
}

}  // namespace qchopper
