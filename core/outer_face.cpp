#include "core/outer_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drape {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// > 0 where c lies to the left of the line from a to b.
double side(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Whether u comes before w when turning counter-clockwise from `back`.
bool turns_before(const Vec2& back, const Vec2& u, const Vec2& w) {
  const bool u_first_half = cross(back, u) > 0, w_first_half = cross(back, w) > 0;
  return u_first_half != w_first_half ? u_first_half : cross(u, w) > 0;
}

/// A place on the way: on `segment`, at the fraction t from its a to its b, heading for b or a.
struct Place {
  int segment;
  bool towards_b;
  double t;
};

/// What the walk asks of the segments: which of them end at a point, and which one crosses next.
class Arrangement {
 public:
  Arrangement(const std::vector<Vec2>& points, const std::vector<Segment>& segments)
      : points_(points), segments_(segments) {
    index_ends();
    index_cells();
  }

  const Vec2& point(int i) const { return points_[static_cast<size_t>(i)]; }
  const Segment& segment(int i) const { return segments_[static_cast<size_t>(i)]; }
  int segment_count() const { return static_cast<int>(segments_.size()); }
  const Vec2& low() const { return low_; }
  const Vec2& high() const { return high_; }

  int farthest_point() const {
    int farthest = segments_.front().a;
    for (const Segment& e : segments_)
      for (int i : {e.a, e.b})
        if (point(i).squaredNorm() > point(farthest).squaredNorm()) farthest = i;
    return farthest;
  }

  /// The segment that leaves point i first when turning counter-clockwise from `back`, the
  /// direction one came from: between the two lies the unbounded face. `arrived` is left out.
  Place leave(int i, const Vec2& back, int arrived) const {
    Place next{-1, true, 0};
    Vec2 best = Vec2::Zero();
    const size_t slot = static_cast<size_t>(i);
    for (int k = first_end_[slot]; k < first_end_[slot + 1]; ++k) {
      const int candidate = ends_[static_cast<size_t>(k)];
      if (candidate == arrived) continue;
      const bool towards_b = segment(candidate).a == i;
      const Vec2 direction =
          point(towards_b ? segment(candidate).b : segment(candidate).a) - point(i);
      if (next.segment >= 0 && !turns_before(back, direction, best)) continue;
      best = direction;
      next = {candidate, towards_b, towards_b ? -kInfinity : kInfinity};
    }
    if (next.segment < 0) throw std::runtime_error("outer_face: the boundary has a loose end");
    return next;
  }

  /// The next crossing ahead of `place`, as the place on the crossing segment after the turn to the
  /// right, on which side the unbounded face lies; segment = -1 if none comes before the end.
  Place next_crossing(const Place& place, int passed) const {
    const Segment& e = segment(place.segment);
    const Vec2 &a = point(e.a), &b = point(e.b);
    Place next{-1, true, 0};
    double nearest = place.towards_b ? kInfinity : -kInfinity;
    for_cells(e, [&](size_t cell) {
      for (int k = first_in_cell_[cell]; k < first_in_cell_[cell + 1]; ++k) {
        const int other = in_cells_[static_cast<size_t>(k)];
        const Segment& f = segment(other);
        if (other == passed || f.a == e.a || f.a == e.b || f.b == e.a || f.b == e.b) continue;
        const Vec2 &c = point(f.a), &d = point(f.b);
        const double c_side = side(a, b, c), d_side = side(a, b, d);
        if ((c_side > 0) == (d_side > 0)) continue;
        const double a_side = side(c, d, a), b_side = side(c, d, b);
        if ((a_side > 0) == (b_side > 0)) continue;
        const double t = a_side / (a_side - b_side);
        if (place.towards_b ? (t > place.t && t < nearest) : (t < place.t && t > nearest)) {
          nearest = t;
          next = {other, (c_side > 0) == place.towards_b, c_side / (c_side - d_side)};
        }
      }
    });
    return next;
  }

 private:
  /// Calls visit(cell) for the cells of the square grid that the bounding box of e meets.
  template <typename Visit>
  void for_cells(const Segment& e, const Visit& visit) const {
    const Vec2 first = (point(e.a).cwiseMin(point(e.b)) - low_) / cell_size_;
    const Vec2 last = (point(e.a).cwiseMax(point(e.b)) - low_) / cell_size_;
    const auto cell = [this](double at) { return std::min(static_cast<int>(at), cells_ - 1); };
    for (int row = cell(first.y()); row <= cell(last.y()); ++row)
      for (int column = cell(first.x()); column <= cell(last.x()); ++column)
        visit(static_cast<size_t>(row * cells_ + column));
  }

  /// Lists the segments that end at every point.
  void index_ends() {
    first_end_.assign(points_.size() + 1, 0);
    for (const Segment& e : segments_)
      for (int i : {e.a, e.b}) ++first_end_[static_cast<size_t>(i) + 1];
    for (size_t i = 1; i < first_end_.size(); ++i) first_end_[i] += first_end_[i - 1];
    ends_.resize(2 * segments_.size());
    std::vector<int> next(first_end_.begin(), first_end_.end() - 1);
    for (int k = 0; k < segment_count(); ++k)
      for (int i : {segment(k).a, segment(k).b})
        ends_[static_cast<size_t>(next[static_cast<size_t>(i)]++)] = k;
  }

  /// Lists the segments whose bounding box meets every cell of a square grid.
  void index_cells() {
    low_ = high_ = point(segments_.front().a);
    for (const Segment& e : segments_)
      for (int i : {e.a, e.b}) {
        low_ = low_.cwiseMin(point(i));
        high_ = high_.cwiseMax(point(i));
      }
    cells_ = std::clamp(static_cast<int>(2 * std::sqrt(segment_count())), 1, 256);
    cell_size_ = (high_ - low_).maxCoeff() / cells_;
    if (!(cell_size_ > 0)) throw std::runtime_error("outer_face: all points coincide");
    first_in_cell_.assign(static_cast<size_t>(cells_ * cells_) + 1, 0);
    for (const Segment& e : segments_)
      for_cells(e, [this](size_t cell) { ++first_in_cell_[cell + 1]; });
    for (size_t i = 1; i < first_in_cell_.size(); ++i) first_in_cell_[i] += first_in_cell_[i - 1];
    in_cells_.resize(static_cast<size_t>(first_in_cell_.back()));
    std::vector<int> next(first_in_cell_.begin(), first_in_cell_.end() - 1);
    for (int k = 0; k < segment_count(); ++k)
      for_cells(segment(k), [&](size_t cell) { in_cells_[static_cast<size_t>(next[cell]++)] = k; });
  }

  const std::vector<Vec2>& points_;
  const std::vector<Segment>& segments_;
  std::vector<int> first_end_, ends_;          // point -> its segments
  std::vector<int> first_in_cell_, in_cells_;  // cell -> its segments
  Vec2 low_ = Vec2::Zero(), high_ = Vec2::Zero();
  double cell_size_ = 0;
  int cells_ = 0;
};

}  // namespace

std::vector<FaceCorner> outer_face(const std::vector<Vec2>& points,
                                   const std::vector<Segment>& segments) {
  if (segments.empty()) throw std::runtime_error("outer_face: there is no segment");
  const Arrangement arrangement(points, segments);
  const int start = arrangement.farthest_point();
  std::vector<FaceCorner> corners{{.point = start}};
  Vec2 low = arrangement.point(start), high = low;
  Place place = arrangement.leave(start, arrangement.point(start), -1);
  int passed = -1;
  // One face of an arrangement of m segments has O(m alpha(m)) corners, with alpha < 5 for any m.
  const size_t most_corners = 10 * segments.size();
  while (true) {
    if (corners.size() > most_corners)
      throw std::runtime_error("outer_face: the boundary does not close");
    const Place crossing = arrangement.next_crossing(place, passed);
    if (crossing.segment >= 0) {
      corners.push_back({.segment = place.segment, .crossing_segment = crossing.segment});
      passed = place.segment;
      place = crossing;
      continue;
    }
    const Segment& e = arrangement.segment(place.segment);
    const int from = place.towards_b ? e.a : e.b, to = place.towards_b ? e.b : e.a;
    if (to == start) break;
    corners.push_back({.point = to});
    const Vec2& at = arrangement.point(to);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
    place = arrangement.leave(to, arrangement.point(from) - at, place.segment);
    passed = -1;
  }
  // The extreme points of a connected set lie on its outer boundary.
  if (low != arrangement.low() || high != arrangement.high())
    throw std::runtime_error("outer_face: the boundary misses an extreme point");
  return corners;
}

}  // namespace drape
