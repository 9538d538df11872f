// A photograph as a picture of a fit: what kind = "photograph" and the study of many share.
#pragma once

#include <optional>
#include <vector>

#include "estimation/photograph.h"
#include "estimation/photograph_manifest.h"
#include "estimation/tag.h"
#include "estimation/warp_search.h"
#include "experiments/settings.h"

namespace drape {

/// The settings with the specimen of photograph.files[file] in their scene.
Settings with_specimen(Settings settings, size_t file);

/// The settings for kind = "photograph" of one fabric of a manifest.
Settings with_photographs(Settings settings, const PhotographedFabric& fabric);

/// The tag of the photographed fabric, if it is given. Throws like tag_from_words.
std::optional<Tag> tag_of(const PhotographSettings& settings);

/// Camera, noise, nuisances and their priors as [photograph] says, the specimen as the scene says;
/// `model` gives mesh, reading and gravity.
Picture picture_of(const Settings& settings, const Potential& model, const Photograph& photograph);

/// The fit of pictures of one fabric, warp directions as [photograph] says. `first`: the first
/// fabric. The prior is the options'.
WarpSearch fit_pictures(const Settings& settings, std::vector<Picture> pictures,
                        const Fabric& first, const EstimateOptions& options);

/// Direction of the warp of an angle of the weft [rad], in degrees.
double warp_degrees(double weft_angle);
/// The other way round.
double weft_angle(double warp_degrees);

}  // namespace drape
