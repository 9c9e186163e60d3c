// Faults of a link, frame by frame: what becomes of the bytes of one frame between a PC and a cell.
//
// A FaultProxy only decides; a virtual link (tests/schedules/virtual_link.h) or real sockets (TcpFaultProxy below) do
// it. The same seed and the same frames give the same faults. Times in seconds.

#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "devices/wire/packml.h"

namespace qchopper::rig {

enum class LinkFault : std::uint8_t {
    none,
    delay,       // the frame comes `number` ms later
    split,       // byte by byte, `number` ms apart
    merge,       // together with the next frame of this connection and way, or when it closes
    drop_after,  // the first `number` bytes come, nothing of this connection and way after them
    reset,       // nothing comes, the connection is reset
    half_open,   // from now on nothing comes either way, and nobody is told
    hold,        // the frame and all after it on this way come `number` ms later, also if the sender has closed
    duplicate,   // twice
    replay,      // a frame recorded before is sent too, on a connection of its own
    flip_bit,    // bit `number` of the frame is wrong
    swap_words,  // the registers of each pair are swapped
    count
};
const char* name(LinkFault fault);

enum class Way : std::uint8_t { to_cell, to_pc };

using Condition = std::function<bool(const Bytes& frame)>;
// A frame that writes COMMAND with this command.
Condition is_command(CellCommand command);

struct Piece {
    double after_s = 0;  // since the frame came
    Bytes bytes;
    bool resets = false;     // the connection ends with it
    bool elsewhere = false;  // on a connection of its own
};

class FaultProxy {
 public:
    // Of 1000 frames each way `per_thousand` have a fault, drawn from the seed.
    explicit FaultProxy(std::uint64_t seed = 1, int per_thousand = 0) : random_(seed), per_thousand_(per_thousand) {}

    // The next frame on that way of which `when` holds (empty: any) has this fault, whatever its connection is.
    void arm(LinkFault fault, Way way, std::int64_t number = 0, Condition when = {});
    void set_odds(int per_thousand) { per_thousand_ = per_thousand; }

    // `frame` is whole: MBAP header and PDU.
    std::vector<Piece> pass(int connection, Way way, const Bytes& frame);
    // The connection closes: what was kept for it.
    std::vector<Piece> close(int connection);

    const std::vector<std::string>& log() const { return log_; }

 private:
    struct Armed {
        LinkFault fault = LinkFault::none;
        Way way = Way::to_cell;
        std::int64_t number = 0;
        Condition when;
    };
    struct Lane {
        bool is_dead = false;
        double late_s = 0;
        Bytes kept;
    };
    Armed draw(Way way, const Bytes& frame);
    std::vector<Piece> spoil(const Armed& armed, Lane& lane, int connection, Way way, Bytes frame);

    std::uint64_t random_;
    int per_thousand_;
    std::deque<Armed> armed_;
    std::map<int, std::array<Lane, 2>> lanes_;
    std::deque<Bytes> recorded_;  // the last frames to the cell
    std::vector<std::string> log_;
};

// The same over real sockets: listens on a free port of loopback, and connects each client to the port of a cell.
class TcpFaultProxy {
 public:
    explicit TcpFaultProxy(std::uint16_t cell_port);
    ~TcpFaultProxy();
    TcpFaultProxy(const TcpFaultProxy&) = delete;
    TcpFaultProxy& operator=(const TcpFaultProxy&) = delete;

    std::uint16_t port() const;
    // May be called from any thread.
    void arm(LinkFault fault, Way way, std::int64_t number = 0, Condition when = {});
    void set_plugged(bool is_plugged);  // false: every connection is reset, and new ones at once

 private:
    struct Loop;
    std::unique_ptr<Loop> loop_;
};

}  // namespace qchopper::rig
