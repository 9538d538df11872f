// Random tags whose types and fibres come in exactly the numbers of Tables 1 and 2 of Ju et al.
// 2024 (supplement), or in proportion for fewer or more fabrics.
//
// Every type gets its number of fabrics. Then each fibre, the rarest first, becomes the main fibre
// of its number of fabrics, drawn by affinity among those that have none yet; the last one
// (polyester) takes what is left. What remains of the mentions goes, again by affinity, to fabrics
// without that fibre. Numbers are exact by construction, whatever the affinities.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimation/tag.h"

namespace drape {

/// `total` in proportion to the weights, whole numbers by largest remainder (Hamilton's method);
/// none above its limit (empty: no limits). Throws std::invalid_argument if the limits do not hold
/// the total.
std::vector<int> apportion(int total, std::span<const double> weights,
                           std::span<const int> limits = {});

/// `count` tags in random order; the id of a tag is its index. Percentages are whole and sum to
/// 100, the main fibre first. The same seed and count give the same tags.
std::vector<Tag> random_tags(int count, std::uint64_t seed);

}  // namespace drape
