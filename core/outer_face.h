// The outer boundary of a set of segments in the plane: one walk along the unbounded face of their
// arrangement (de Berg et al., Computational Geometry, ch. 2), which finds only the crossings that
// it meets.
#pragma once

#include <vector>

#include "core/types.h"

namespace drape {

/// A segment between two points, given by their indices. Segments that share an index are joined
/// there.
struct Segment {
  int a, b;
};

/// A corner of the outer boundary: a point, or (point = -1) the crossing of two segments.
struct FaceCorner {
  int point = -1;
  int segment = -1, crossing_segment = -1;
};

/// Corners, counter-clockwise, of the part of the outer boundary that holds the point farthest from
/// the origin. Assumes general position: no point lies on a segment that does not end there.
/// Throws std::runtime_error if the boundary has a loose end or does not close.
std::vector<FaceCorner> outer_face(const std::vector<Vec2>& points,
                                   const std::vector<Segment>& segments);

}  // namespace drape
