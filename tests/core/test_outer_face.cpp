#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "core/outer_face.h"

namespace drape {
namespace {

/// Appends a closed chain of segments.
void add_loop(const std::vector<Vec2>& loop, std::vector<Vec2>& points,
              std::vector<Segment>& segments) {
  const int first = static_cast<int>(points.size()), n = static_cast<int>(loop.size());
  points.insert(points.end(), loop.begin(), loop.end());
  for (int k = 0; k < n; ++k) segments.push_back({first + k, first + (k + 1) % n});
}

TEST(OuterFace, OfALoopIsTheLoopInEitherDirection) {
  for (bool clockwise : {false, true}) {
    std::vector<Vec2> points, loop{{2, 0}, {0, 1}, {-1, 0.1}, {0.5, -1}};
    if (clockwise) loop = {loop[0], loop[3], loop[2], loop[1]};
    std::vector<Segment> segments;
    add_loop(loop, points, segments);
    const std::vector<FaceCorner> corners = outer_face(points, segments);
    ASSERT_EQ(corners.size(), 4u);
    EXPECT_EQ(corners[0].point, 0);
    EXPECT_EQ(corners[1].point, clockwise ? 3 : 1);
    EXPECT_EQ(corners[2].point, 2);
    EXPECT_EQ(corners[3].point, clockwise ? 1 : 3);
  }
}

TEST(OuterFace, OfTwoTrianglesIsAStar) {
  std::vector<Vec2> points;
  std::vector<Segment> segments;
  add_loop({{3, 0}, {-1.5, 2.5}, {-1.5, -2.5}}, points, segments);
  add_loop({{-2.9, 0.1}, {1.5, -2.4}, {1.4, 2.5}}, points, segments);
  add_loop({{0.1, 0}, {0, 0.1}, {-0.1, 0}}, points, segments);  // inside: not seen
  const std::vector<FaceCorner> corners = outer_face(points, segments);
  ASSERT_EQ(corners.size(), 12u);
  const int tips[] = {0, 5, 1, 3, 2, 4};
  for (size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(corners[k].point, k % 2 == 0 ? tips[k / 2] : -1);
    if (k % 2 == 0) continue;
    EXPECT_EQ(corners[k].segment < 3, k % 4 == 1);
    EXPECT_EQ(corners[k].crossing_segment < 3, k % 4 == 3);
  }
}

TEST(OuterFace, KeepsToTheOutsideWhereLoopsShareAPoint) {
  // Two triangles joined at the origin, as a bow tie: the walk passes the joint twice.
  const std::vector<Vec2> points{{0, 0}, {2, -1}, {2, 1.1}, {-2, 1}, {-2, -1}};
  const std::vector<Segment> segments{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}};
  const std::vector<FaceCorner> corners = outer_face(points, segments);
  ASSERT_EQ(corners.size(), 6u);
  const int expected[] = {2, 0, 3, 4, 0, 1};
  for (size_t k = 0; k < 6; ++k) EXPECT_EQ(corners[k].point, expected[k]);
}

TEST(OuterFace, RefusesWhatHasNoOuterBoundary) {
  std::vector<Vec2> points;
  std::vector<Segment> segments;
  EXPECT_THROW(outer_face(points, segments), std::runtime_error);  // nothing
  points = {{2, 0}, {0, 1}, {-1, 0}};
  segments = {{0, 1}, {1, 2}};
  EXPECT_THROW(outer_face(points, segments), std::runtime_error);  // a loose end
  points.clear();
  segments.clear();
  add_loop({{3, 0}, {2, 1}, {2, -1}}, points, segments);
  add_loop({{-2, 0}, {-1, -1}, {-1, 1}}, points, segments);
  EXPECT_THROW(outer_face(points, segments), std::runtime_error);  // two parts
}

}  // namespace
}  // namespace drape
