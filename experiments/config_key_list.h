// How a row of the table of keys is written: a key from its texts and the member it stands for.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiments/config_keys.h"
#include "experiments/config_names.h"

namespace drape {

inline constexpr double kLargestCount = 1e9;  // fits an int

// `access` returns a reference to the member, of const and of mutable Settings.
template <class Access>
ConfigKey key(std::string section, std::string key_name, std::string unit, Range range,
              std::string explanation, Access access) {
  using Member = std::remove_cvref_t<std::invoke_result_t<Access, Settings&>>;
  using Convert = Conversion<Member>;
  if constexpr (std::is_same_v<Member, int> || std::is_same_v<Member, std::vector<int>>)
    range.high = std::min(range.high, kLargestCount);
  std::vector<std::string> choices;
  if constexpr (std::is_enum_v<Member>) choices = names_of<Member>();
  if constexpr (IsEnumList<Member>::value) choices = names_of<typename Member::value_type>();
  return {std::move(section),
          std::move(key_name),
          Convert::kType,
          std::move(unit),
          range,
          std::move(choices),
          std::move(explanation),
          [access](const Settings& s) { return Convert::to_value(access(s)); },
          [access](Settings& s, const ConfigValue& v) { access(s) = Convert::from_value(v); }};
}

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{};
inline constexpr Range kPositive{0, kInfinity, false};
inline constexpr Range kNotNegative{0, kInfinity, true};
constexpr Range at_least(double low) { return {low, kInfinity, true}; }
inline constexpr Range kVertices{200, 1e6, true};

/// Appends keys to a list.
class ConfigKeyList {
 public:
  template <class Access>
  void operator()(const char* section, const char* key_name, const char* unit, Range range,
                  const char* explanation, Access access) {
    keys.push_back(key(section, key_name, unit, range, explanation, access));
  }

  std::vector<ConfigKey> keys;
};

/// The sections of experiment, fabric, scene, mesh, solver and start.
void add_common_keys(ConfigKeyList& add);
/// The sections of the kinds of experiments.
void add_keys_of_kinds(ConfigKeyList& add);

// An access to a member of const or mutable Settings.
#define DRAPE_MEMBER(member) \
  [](auto& s) -> auto& { return s.member; }

}  // namespace drape
