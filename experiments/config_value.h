// How a member of Settings appears in a config: its type there and the conversions both ways.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace drape {

/// What a key's value is in the file. A choice is a text out of a fixed list; a path is a text that
/// names an existing file, relative to the folder of the config file.
enum class ValueType {
  boolean,
  integer,
  integer_or_auto,
  number,
  choice,
  text,
  path,
  integers,
  numbers,
  choices,
  paths
};

/// What a value of type integer_or_auto is where the program is to choose.
inline constexpr const char* kAuto = "auto";

/// A value on its way between file and Settings (choices and paths as text).
using ConfigValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::int64_t>,
                                 std::vector<double>, std::vector<std::string>>;

/// Names of the enumerators in the order of their values (which count from 0).
template <class Enum>
std::vector<std::string> names_of();

/// `text` must be one of the names.
template <class Enum>
Enum from_name(const std::string& text) {
  const std::vector<std::string> names = names_of<Enum>();
  return static_cast<Enum>(std::find(names.begin(), names.end(), text) - names.begin());
}

template <class Enum>
std::string to_name(Enum value) {
  return names_of<Enum>()[static_cast<size_t>(value)];
}

// How a member of Settings appears in a config: its type there and both conversions.
template <class Member, class = void>
struct Conversion;

template <>
struct Conversion<bool> {
  static constexpr ValueType kType = ValueType::boolean;
  static ConfigValue to_value(bool member) { return member; }
  static bool from_value(const ConfigValue& value) { return std::get<bool>(value); }
};

template <class Integer>
struct Conversion<Integer, std::enable_if_t<std::is_integral_v<Integer>>> {
  static constexpr ValueType kType = ValueType::integer;
  static ConfigValue to_value(Integer member) { return static_cast<std::int64_t>(member); }
  static Integer from_value(const ConfigValue& value) {
    return static_cast<Integer>(std::get<std::int64_t>(value));
  }
};

/// No value is "auto".
template <>
struct Conversion<std::optional<int>> {
  static constexpr ValueType kType = ValueType::integer_or_auto;
  static ConfigValue to_value(const std::optional<int>& member) {
    return member ? ConfigValue(std::int64_t{*member}) : ConfigValue(std::string(kAuto));
  }
  static std::optional<int> from_value(const ConfigValue& value) {
    const auto* count = std::get_if<std::int64_t>(&value);
    return count ? std::optional(static_cast<int>(*count)) : std::nullopt;
  }
};

template <>
struct Conversion<double> {
  static constexpr ValueType kType = ValueType::number;
  static ConfigValue to_value(double member) { return member; }
  static double from_value(const ConfigValue& value) { return std::get<double>(value); }
};

template <class Enum>
struct Conversion<Enum, std::enable_if_t<std::is_enum_v<Enum>>> {
  static constexpr ValueType kType = ValueType::choice;
  static ConfigValue to_value(Enum member) { return to_name(member); }
  static Enum from_value(const ConfigValue& value) {
    return from_name<Enum>(std::get<std::string>(value));
  }
};

template <>
struct Conversion<std::string> {
  static constexpr ValueType kType = ValueType::text;
  static ConfigValue to_value(const std::string& member) { return member; }
  static std::string from_value(const ConfigValue& value) { return std::get<std::string>(value); }
};

template <>
struct Conversion<std::filesystem::path> {
  static constexpr ValueType kType = ValueType::path;
  static ConfigValue to_value(const std::filesystem::path& member) { return member.string(); }
  static std::filesystem::path from_value(const ConfigValue& value) {
    return std::get<std::string>(value);
  }
};

template <>
struct Conversion<std::vector<std::filesystem::path>> {
  static constexpr ValueType kType = ValueType::paths;
  static ConfigValue to_value(const std::vector<std::filesystem::path>& member) {
    return std::vector<std::string>(member.begin(), member.end());
  }
  static std::vector<std::filesystem::path> from_value(const ConfigValue& value) {
    const auto& names = std::get<std::vector<std::string>>(value);
    return {names.begin(), names.end()};
  }
};

template <>
struct Conversion<std::vector<int>> {
  static constexpr ValueType kType = ValueType::integers;
  static ConfigValue to_value(const std::vector<int>& member) {
    return std::vector<std::int64_t>(member.begin(), member.end());
  }
  static std::vector<int> from_value(const ConfigValue& value) {
    std::vector<int> member;
    for (std::int64_t entry : std::get<std::vector<std::int64_t>>(value))
      member.push_back(static_cast<int>(entry));
    return member;
  }
};

template <>
struct Conversion<std::vector<double>> {
  static constexpr ValueType kType = ValueType::numbers;
  static ConfigValue to_value(const std::vector<double>& member) { return member; }
  static std::vector<double> from_value(const ConfigValue& value) {
    return std::get<std::vector<double>>(value);
  }
};

template <class Enum>
struct Conversion<std::vector<Enum>, std::enable_if_t<std::is_enum_v<Enum>>> {
  static constexpr ValueType kType = ValueType::choices;
  static ConfigValue to_value(const std::vector<Enum>& member) {
    std::vector<std::string> names;
    for (Enum entry : member) names.push_back(to_name(entry));
    return names;
  }
  static std::vector<Enum> from_value(const ConfigValue& value) {
    std::vector<Enum> member;
    for (const std::string& text : std::get<std::vector<std::string>>(value))
      member.push_back(from_name<Enum>(text));
    return member;
  }
};

template <class Member>
struct IsEnumList : std::false_type {};
template <class Enum>
struct IsEnumList<std::vector<Enum>> : std::is_enum<Enum> {};

}  // namespace drape
