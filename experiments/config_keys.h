// The table of all keys of a config file: what `drape explain` shows, what a config may say, and
// where each value goes in Settings. Reading, checking, writing and explaining all follow it.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config_value.h"
#include "experiments/settings.h"

namespace drape {

/// Allowed numbers, of each entry in lists. `high` is always allowed if finite.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;

  bool contains(double value) const;
  std::string text() const;  ///< as "> 0 and <= 1"; empty if everything finite is allowed
};

struct ConfigKey {
  std::string section;
  std::string name;
  ValueType type;
  std::string unit;  ///< empty for texts and counts
  Range range;
  std::vector<std::string> choices;
  std::string explanation;
  std::function<ConfigValue(const Settings&)> get;
  /// The value must have the key's type and be in its range or choices.
  std::function<void(Settings&, const ConfigValue&)> set;

  std::string full_name() const { return section + "." + name; }
};

/// All keys, grouped by section, in the order of a written config.
const std::vector<ConfigKey>& config_keys();

/// Names of the sections in that order.
const std::vector<std::string>& config_sections();

/// Names of the keys of one section.
std::vector<std::string> key_names(std::string_view section);

/// nullptr if there is no such key.
const ConfigKey* find_key(std::string_view section, std::string_view name);

/// The name of a kind as in `experiment.kind`.
std::string name(Kind kind);

}  // namespace drape
