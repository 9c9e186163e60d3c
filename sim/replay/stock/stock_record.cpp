// A token is a number of 7 bits per byte; its lowest two bits say what it is: a difference from the last height, a run
// of that height, or a run of cells that were not cut. Reading demands the one form that writing makes, by writing
// again. O(cells).

#include "sim/replay/stock/stock_record.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "sim/replay/stock/dexel_map.h"

namespace qchopper {
namespace {

constexpr char magic[] = "QCSTOCK1";
constexpr std::size_t magic_size = 8;
constexpr std::uint64_t max_directions = 64;
constexpr std::uint64_t max_tools = 4096;
constexpr std::uint64_t max_tile = 1 << 20;
constexpr std::size_t max_tiles = 1 << 17;        // of all directions: 2 GB
constexpr std::int64_t max_height = 100'000'000;  // 1 km

enum Token : std::uint64_t { difference = 0, same = 1, not_cut = 2 };

class Writer {
 public:
    void number(std::uint64_t value) {
        for (; value >= 128; value >>= 7) bytes.push_back(static_cast<std::uint8_t>(value | 128));
        bytes.push_back(static_cast<std::uint8_t>(value));
    }
    void real(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
    }
    void vector(Vec3 v) {
        real(v.x);
        real(v.y);
        real(v.z);
    }
    Bytes bytes;
};

class Reader {
 public:
    Reader(const Bytes& bytes, const std::string& source) : bytes_(bytes), source_(source) {}
    [[noreturn]] void refuse(const char* why) const {
        throw InputError(InputFault::mesh, source_ + " is not the stock that a program left: " + why,
                         "write the job again with qchopper prepare, or copy it again");
    }
    std::uint8_t byte() {
        if (at_ >= bytes_.size()) refuse("it is cut short");
        return bytes_[at_++];
    }
    std::uint64_t number(std::uint64_t most) {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 63; shift += 7) {
            const std::uint64_t next = byte();
            value |= (next & 127) << shift;
            if (next >= 128) continue;
            if (value > most) refuse("a number is out of range");
            return value;
        }
        refuse("a number is too long");
    }
    double real() {
        std::uint64_t bits = 0;
        for (int shift = 0; shift < 64; shift += 8) bits |= static_cast<std::uint64_t>(byte()) << shift;
        const auto value = std::bit_cast<double>(bits);
        if (!std::isfinite(value)) refuse("a length is no number");
        return value;
    }
    Vec3 vector() {
        const double x = real();
        const double y = real();
        return {x, y, real()};
    }
    bool is_at_end() const { return at_ == bytes_.size(); }

 private:
    const Bytes& bytes_;
    const std::string& source_;
    std::size_t at_ = 0;
};

std::uint64_t without_sign(std::int64_t value) {
    return value < 0 ? 2 * static_cast<std::uint64_t>(-value) - 1 : 2 * static_cast<std::uint64_t>(value);
}

std::int64_t with_sign(std::uint64_t value) {
    const auto half = static_cast<std::int64_t>((value + 1) / 2);
    return value % 2 == 1 ? -half : half;
}

void write_cells(Writer& out, const std::vector<std::int32_t>& height) {
    std::int64_t last = 0;
    for (std::size_t i = 0; i < height.size();) {
        std::size_t end = i;
        while (end < height.size() && height[end] == height[i]) ++end;
        const bool is_cut = height[i] != StockTile::not_cut;
        if (is_cut && height[i] != last) {
            out.number(without_sign(height[i] - last) << 2 | Token::difference);
            last = height[i++];
            continue;
        }
        out.number(static_cast<std::uint64_t>(end - i) << 2 | (is_cut ? Token::same : Token::not_cut));
        i = end;
    }
}

std::vector<std::int32_t> read_cells(Reader& in) {
    std::vector<std::int32_t> height;
    std::int64_t last = 0;
    while (height.size() < DexelTile::cells) {
        const std::uint64_t token = in.number(std::uint64_t{1} << 40);
        const std::uint64_t value = token >> 2;
        if ((token & 3) == Token::difference) {
            last += with_sign(value);
            if (last < -max_height || last > max_height) in.refuse("a height is out of range");
            height.push_back(static_cast<std::int32_t>(last));
            continue;
        }
        if ((token & 3) == 3 || value == 0 || value > DexelTile::cells - height.size()) in.refuse("a run is too long");
        height.insert(height.end(), static_cast<std::size_t>(value),
                      (token & 3) == Token::same ? static_cast<std::int32_t>(last) : StockTile::not_cut);
    }
    return height;
}

StockMap read_map(Reader& in, std::size_t tiles_before) {
    StockMap map{in.vector(), {}};
    const std::uint64_t count = in.number(max_tiles - tiles_before);
    for (std::uint64_t i = 0; i < count; ++i) {
        StockTile tile;
        tile.tx = static_cast<std::int32_t>(in.number(max_tile));
        tile.ty = static_cast<std::int32_t>(in.number(max_tile));
        if (i > 0) {
            const StockTile& before = map.tiles.back();
            if (tile.ty < before.ty || (tile.ty == before.ty && tile.tx <= before.tx))
                in.refuse("tiles are disordered");
        }
        tile.height = read_cells(in);
        map.tiles.push_back(std::move(tile));
    }
    return map;
}

}  // namespace

Bytes to_bytes(const StockRecord& stock) {
    Writer out;
    out.bytes.assign(magic, magic + magic_size);
    out.vector(stock.block.min);
    out.vector(stock.block.max);
    out.real(stock.cell);
    out.number(stock.tools.size());
    for (const StockTool& used : stock.tools) {
        out.number(used.tool);
        out.number(used.orientation);
    }
    out.number(stock.maps.size());
    for (const StockMap& map : stock.maps) {
        out.vector(map.tool_axis);
        out.number(map.tiles.size());
        for (const StockTile& tile : map.tiles) {
            out.number(static_cast<std::uint64_t>(tile.tx));
            out.number(static_cast<std::uint64_t>(tile.ty));
            write_cells(out, tile.height);
        }
    }
    return std::move(out.bytes);
}

StockRecord read_stock(const Bytes& bytes, const std::string& source) {
    Reader in(bytes, source);
    for (std::size_t i = 0; i < magic_size; ++i) {
        if (in.byte() != static_cast<std::uint8_t>(magic[i])) in.refuse("it does not begin with QCSTOCK1");
    }
    StockRecord stock;
    stock.block.min = in.vector();
    stock.block.max = in.vector();
    stock.cell = in.real();
    const std::uint64_t tools = in.number(max_tools);
    for (std::uint64_t i = 0; i < tools; ++i) {
        const auto tool = static_cast<std::uint16_t>(in.number(65535));
        stock.tools.push_back({tool, static_cast<std::uint32_t>(in.number(max_directions - 1))});
        if (i > 0 && !(stock.tools[i - 1] < stock.tools[i])) in.refuse("tools are disordered");
    }
    const std::uint64_t maps = in.number(max_directions);
    std::size_t tiles = 0;
    for (std::uint64_t i = 0; i < maps; ++i) {
        stock.maps.push_back(read_map(in, tiles));
        tiles += stock.maps.back().tiles.size();
    }
    if (!in.is_at_end()) in.refuse("something follows its end");
    if (to_bytes(stock) != bytes) in.refuse("it is written in another way");
    return stock;
}

}  // namespace qchopper
