// One picture of a drape of the fabric: the specimen, the outline that was seen of it, and how the
// picture may lie on the drape.
//
// A corner Q of the drape's outline (in the axes of the fabric: +x weft, +y warp) is seen at
//   P = exp(-s) R(phi) (Q - c)
// in the picture, Q as the camera sees it (core/camera.h): c is the picture's origin in the drape's
// frame, phi the direction of the weft in the picture, exp(s) true length over length by the
// nominal scale. What is not known of (c, phi, s) is estimated along with the fabric, each with a
// Gaussian prior.
#pragma once

#include <optional>

#include "core/camera.h"
#include "core/coverage.h"
#include "core/equilibrium.h"
#include "core/guide.h"
#include "core/potential.h"
#include "core/profile.h"
#include "core/scene.h"

namespace drape {

/// The outline of one drape as seen, in the frame of its picture.
struct OutlineObservation {
  VecX profile;              ///< kProfileSize radii about the picture's origin [m]
  double noise = 5e-4;       ///< standard deviation of a radius [m]
  int noise_harmonics = 30;  ///< the errors of the radii fill the harmonics 0 to this one
  PixelGrid grid;            ///< of `coverage`
  CoverageImage coverage;    ///< needed by the coverage loss only
  Points2 outline;           ///< closed polygon, needed by the signed-distance loss only [m]

  Camera camera;

  bool centre_known = true;  ///< the origin is the axis of the support; else within 5 mm (1 sd)
  double weft_angle = 0;     ///< phi, counter-clockwise from the picture's +x [rad]
  double weft_angle_sd = 0;  ///< of the true one about it; 0: known [rad]
  double scale_log_sd = 0;   ///< of s about 0; 0: known

  /// Independent values among the radii: two a harmonic, one for the mean.
  int independent_values() const { return 2 * noise_harmonics + 1; }
  /// How many of (c_x, c_y, phi, s) are unknown; they are the picture's nuisances, in this order.
  int nuisances() const;
};

struct Picture {
  Potential model;  ///< mesh, reading, gravity and support of this specimen; not its fabric
  Scene scene;
  OutlineObservation seen;
  /// An equilibrium of the first fabric without guide, to start an unguided fit from.
  std::optional<Equilibrium> start_state = std::nullopt;
};

/// Throws std::invalid_argument that says what is wrong with an observation.
void validate(const OutlineObservation& seen);

/// Where a picture lies on the drape.
struct Placement {
  Vec2 centre = Vec2::Zero();  ///< c [m]
  double weft_angle = 0;       ///< phi [rad]
  double log_scale = 0;        ///< s

  /// Corners as seen (one a row) from corners of the drape.
  Points2 seen(const Points2& drape) const;
  /// The other way round.
  Points2 unseen(const Points2& picture) const;
  /// dL/dcorners of the drape from dL/dcorners as seen.
  Points2 pull_back(const Points2& dL_dseen) const;
  /// Velocity of the corners as seen when those of the drape move.
  Points2 push_forward(const Points2& velocity) const;
};

/// Nuisances v have scales that make a unit a large change: c in millimetres, phi in radians
/// about `weft_angle`, s itself.
Placement placement(const OutlineObservation& seen, const VecX& nuisances);
/// Standard deviations of the nuisances' priors, whose means are 0.
VecX nuisance_sd(const OutlineObservation& seen);
/// The nuisances stay within plus and minus these: 10 mm, 45 degrees, 4 standard deviations of s.
VecX nuisance_bounds(const OutlineObservation& seen);
/// Velocity of the corners as seen (`points`) when nuisance k grows by a unit.
Points2 nuisance_velocity(const OutlineObservation& seen, const Placement& placement,
                          const Points2& points, int k);

/// The guide that pulls the drape towards the outline where the picture lies. Under a pinhole the
/// rim is taken to hang as deep as straight generators of the specimen would.
Guide guide_towards(const OutlineObservation& seen, const Scene& scene, const Placement& placement,
                    int harmonic_count, double kappa);

}  // namespace drape
