// What one direction finishes of a piece: the surface that it reaches better than the directions before.
//
// mm. Points on the triangles are compared with the surface that remains where a tool has been everywhere it can go
// (remaining_surface of cl_surface.h): how far along the normal of the point is what is free.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/field_tiles.h"
#include "segment/raster/height_field.h"

namespace qchopper {

// Per cell of a map the lowest height of surface that is to be finished; `not_finished` where there is none.
using FinishingRegion = std::vector<float>;
constexpr float not_finished = std::numeric_limits<float>::infinity();

// What the directions and tools so far have left over the surface of a piece.
class RestMaterial {
 public:
    // Caps that are no surface to mill (Setup::is_unmilled) are left out, and so are triangles that are ignored. Points
    // are at most `spacing` apart on a triangle. The mesh must outlive it. Preconditions: the mesh is consistent,
    // spacing > 0.
    RestMaterial(const TriangleMesh& mesh, const Setup& setup, double spacing = 1);

    // The tiles of a map of a direction that hold points at which take() of that map looks. The result does not depend
    // on the number of threads. O(points).
    FieldTiles places(const HeightField& frame, double near, double worth = 0) const;

    // How far from its point take() examines foam.
    static double examined(double near);

    // The region that is to be finished with a tool from the direction of a map that holds what remains at best then:
    // the points over which it leaves less foam than has been left so far, and what lies at most `overlap` beside them.
    // Foam up to `near` is as good as none, and differences count by factors of two from there. With `worth`, only
    // points that have more foam than that so far; `is_whole`: only points over which no more than `near` stays.
    // Surface that faces down by up to 12 degrees counts where at most 2 * near is left over it: the strip under an
    // edge that the tool goes along. Afterwards the points have what is left now. The result does not depend on the
    // number of threads. O(points + cells).
    FinishingRegion take(const HeightField& remaining, double near, double overlap, double worth = 0,
                         bool is_whole = false);

    // The number of calls of take().
    std::size_t takes() const { return takes_; }

    // Corrects what the take of that number, the first is 1, has supposed to remain: points that it had, over which
    // more is left, are left to other takes, as far as these find less foam than it or what was before it. Whether
    // there are any. O(points + cells).
    bool give_back(std::size_t take, const HeightField& remaining, double near);

    // Of the surface that is to be milled.
    double area_mm2() const;

    // Share of the area over which at most `near` times 2^k is left, of the last `near`.
    double share_within(std::size_t k) const;

 private:
    // Calls visit(index, point, normal in the map) for each point that take() looks at, on several threads.
    template <class Visit>
    void for_each_left(const HeightField& frame, double near, double worth, const Visit& visit) const;
    template <class Visit>
    void for_each_point(std::size_t triangle, const Visit& visit) const;

    const TriangleMesh* mesh_;
    double spacing_;
    std::vector<std::size_t> first_point_;  // per triangle, and the end
    std::vector<std::uint8_t> left_;        // per point: k, or `all`
    std::vector<std::uint8_t> before_;      // the same before the last take that had the point
    std::vector<std::uint16_t> taken_by_;   // the number of that take; 0: none
    std::size_t takes_ = 0;
};

// Adds the floor within a distance of the projection of the piece: of a map along the base's up, in which the floor is
// what is lowest. Not beyond flush faces of the block: there it is air, and a block that stands out a little would be
// milled along its sawn face.
void add_floor_band(FinishingRegion& region, const HeightField& target, double width, const Setup& setup);

}  // namespace qchopper
