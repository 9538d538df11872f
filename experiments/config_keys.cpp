#include "experiments/config_keys.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/config_key_list.h"

namespace drape {

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_allowed ? value >= low : value > low) && value <= high;
}

std::string Range::text() const {
  std::ostringstream text;
  if (std::isfinite(low)) text << (low_allowed ? ">= " : "> ") << low;
  if (std::isfinite(high)) text << (std::isfinite(low) ? " and " : "") << "<= " << high;
  return text.str();
}

const std::vector<ConfigKey>& config_keys() {
  static const std::vector<ConfigKey> keys = [] {
    ConfigKeyList list;
    add_common_keys(list);
    add_keys_of_kinds(list);
    return std::move(list.keys);
  }();
  return keys;
}

const std::vector<std::string>& config_sections() {
  static const std::vector<std::string> sections = [] {
    std::vector<std::string> list;
    for (const ConfigKey& k : config_keys())
      if (list.empty() || list.back() != k.section) list.push_back(k.section);
    return list;
  }();
  return sections;
}

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const ConfigKey& k : config_keys())
    if (k.section == section) names.push_back(k.name);
  return names;
}

const ConfigKey* find_key(std::string_view section, std::string_view key_name) {
  for (const ConfigKey& k : config_keys())
    if (k.section == section && k.name == key_name) return &k;
  return nullptr;
}

std::string name(Kind kind) { return to_name(kind); }

}  // namespace drape
