#include "core/delaunay.h"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace drape {

Triangles delaunay(const Points2& points) {
  struct Qhull {
    qhT state{};
    std::FILE* log = std::tmpfile();
    Qhull() {
      if (log == nullptr) throw std::runtime_error("delaunay: no temporary file for Qhull's log");
      qh_zero(&state, log);
    }
    ~Qhull() {
      qh_freeqhull(&state, !qh_ALL);
      int current = 0, total = 0;
      qh_memfreeshort(&state, &current, &total);
      std::fclose(log);
    }
  };
  Qhull qhull;
  qhT* const qh = &qhull.state;

  std::vector<double> coordinates(points.data(), points.data() + points.size());
  std::string command = "qhull d Qbb Qt Q12";  // Delaunay, scaled lifting, triangulated facets
  if (qh_new_qhull(qh, 2, static_cast<int>(points.rows()), coordinates.data(), False,
                   command.data(), qhull.log, qhull.log) != 0)
    throw std::runtime_error("delaunay: Qhull failed on " + std::to_string(points.rows()) +
                             " points");

  std::vector<int> corners;
  facetT* facet;
  FORALLfacets {
    if (facet->upperdelaunay) continue;
    int corner[3], k = 0;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) {
      if (k < 3) corner[k] = qh_pointid(qh, vertex->point);
      ++k;
    }
    if (k != 3) throw std::runtime_error("delaunay: Qhull returned a facet that is no triangle");
    const Vec2 a = points.row(corner[0]), b = points.row(corner[1]), c = points.row(corner[2]);
    const double twice_area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (twice_area < 0) std::swap(corner[1], corner[2]);
    corners.insert(corners.end(), corner, corner + 3);
  }
  return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3),
                                     3);
}

}  // namespace drape
