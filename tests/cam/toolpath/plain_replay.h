// A toolpath milled once more, as plainly as it can be written: the block is a grid of points, and the tool stands at
// many places of each move.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper::test_pieces {

struct ReplayFaults {
    std::size_t link_in_stock = 0;  // places at which a link or a retract met foam
    std::size_t above_flute = 0;    // foam that was cut above the flute
    std::size_t holder = 0;         // foam that holder or spindle met
    std::size_t below_spoil = 0;    // tips deeper than 2 mm above the table
    std::size_t not_at_retract = 0;
    std::size_t plunge = 0;  // places on steep ways down with foam under the middle of a tool that does not cut there
    std::string first;       // what was found first
    std::size_t all() const { return link_in_stock + above_flute + holder + below_spoil + not_at_retract + plunge; }
};

class PlainReplay {
 public:
    PlainReplay(const Setup& setup, const Cell& cell, double step);
    void mill(const Operation& operation);
    const ReplayFaults& faults() const { return faults_; }
    const std::vector<Vec3>& points() const { return points_; }
    bool is_stock(std::size_t point) const { return is_stock_[point] != 0; }

 private:
    void stand(const Operation& operation, Vec3 tip, MoveKind kind, bool with_holder);
    void meet(const CuttingTool& tool, std::size_t point, double above, double beside, MoveKind kind);
    bool is_steep_ = false;  // the move goes down more steeply than 25 degrees
    void note(std::size_t& count, const std::string& what);

    const Setup& setup_;
    const Cell& cell_;
    double step_;
    Vec3 origin_;
    std::size_t count_[3] = {0, 0, 0};
    std::vector<Vec3> points_;
    std::vector<std::uint8_t> is_stock_;
    std::size_t places_ = 0;
    ReplayFaults faults_;
};

}  // namespace qchopper::test_pieces
