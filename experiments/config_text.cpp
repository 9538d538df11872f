#include "experiments/config_text.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <stdexcept>

#include "experiments/spelling.h"

namespace drape {
namespace {

std::string format(bool value) { return value ? "true" : "false"; }

std::string format(std::int64_t value) { return std::to_string(value); }

std::string format(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end);
}

// A TOML basic string.
std::string format(const std::string& value) {
  std::string text = "\"";
  for (char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (code < 0x20 || code == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04X", static_cast<unsigned>(code));
      text += escape;
    } else {
      text += c;
    }
  }
  return text + "\"";
}

template <class Entry>
std::string format(const std::vector<Entry>& list) {
  std::string text = "[";
  for (const Entry& entry : list) text += (text.size() > 1 ? ", " : "") + format(entry);
  return text + "]";
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string with_unit(const std::string& text, const ConfigKey& key) {
  return key.unit.empty() ? text : text + " " + key.unit;
}

std::string default_text(const ConfigKey& key) { return format_value(key.get(Settings{})); }

std::string explain_key(const ConfigKey& key) {
  return key.full_name() + "\n  " + key.explanation +
         "\n  value:   " + with_unit(allowed_text(key), key) +
         "\n  default: " + with_unit(default_text(key), key) + "\n";
}

std::string explain_section(const std::string& section) {
  std::string text = "[" + section + "]\n";
  for (const ConfigKey& key : config_keys()) {
    if (key.section != section) continue;
    text += "  " + key.name + " = " + default_text(key);
    if (!key.unit.empty()) text += "  # " + key.unit;
    text += "\n      " + key.explanation + "\n";
  }
  return text;
}

// Keys of any section with a bare name.
std::vector<std::string> full_names(std::string_view bare_name) {
  std::vector<std::string> names;
  for (const ConfigKey& key : config_keys())
    if (key.name == bare_name) names.push_back(key.full_name());
  return names;
}

std::string did_you_mean(const std::string& word) { return "; did you mean '" + word + "'?"; }

}  // namespace

std::string format_value(const ConfigValue& value) {
  return std::visit([](const auto& v) { return format(v); }, value);
}

std::string write_settings(const Settings& settings) {
  std::string text;
  const std::string* section = nullptr;
  for (const ConfigKey& key : config_keys()) {
    if (!section || *section != key.section) text += (section ? "\n[" : "[") + key.section + "]\n";
    section = &key.section;
    text += key.name + " = " + format_value(key.get(settings)) + "\n";
  }
  return text;
}

std::string explain(std::string_view query) {
  std::string text;
  if (query.empty()) {
    for (const std::string& section : config_sections())
      text += (text.empty() ? "" : "\n") + explain_section(section);
    return text;
  }
  const std::vector<std::string>& sections = config_sections();
  if (std::find(sections.begin(), sections.end(), query) != sections.end())
    return explain_section(std::string(query));

  const size_t dot = query.find('.');
  if (dot != std::string_view::npos) {
    const std::string_view section = query.substr(0, dot), name = query.substr(dot + 1);
    if (std::find(sections.begin(), sections.end(), section) == sections.end())
      throw std::invalid_argument(unknown_section_message(section));
    if (const ConfigKey* key = find_key(section, name)) return explain_key(*key);
    throw std::invalid_argument(unknown_key_message(section, name));
  }

  for (const ConfigKey& key : config_keys())
    if (key.name == query) text += (text.empty() ? "" : "\n") + explain_key(key);
  if (!text.empty()) return text;
  throw std::invalid_argument(unknown_key_message("", query));
}

std::string unknown_section_message(std::string_view section) {
  const std::string message = "unknown section '" + std::string(section) + "'";
  if (const auto near = nearest(section, config_sections())) return message + did_you_mean(*near);
  return message + "; the sections are " + join(config_sections());
}

std::string unknown_key_message(std::string_view section, std::string_view key) {
  if (section.empty()) {
    const std::string message = "unknown key or section '" + std::string(key) + "'";
    std::vector<std::string> known = config_sections();
    for (const ConfigKey& candidate : config_keys()) known.push_back(candidate.name);
    const auto near = nearest(key, known);
    if (!near) return message + "; the sections are " + join(config_sections());
    const std::vector<std::string> full = full_names(*near);
    return message + did_you_mean(full.empty() ? *near : full.front());
  }
  const std::string message = "unknown key '" + std::string(section) + "." + std::string(key) + "'";
  const std::vector<std::string> elsewhere = full_names(key);
  if (elsewhere.size() == 1) return message + did_you_mean(elsewhere.front());
  if (const auto near = nearest(key, key_names(section))) return message + did_you_mean(*near);
  return message + "; the keys of [" + std::string(section) + "] are " + join(key_names(section));
}

std::string allowed_text(const ConfigKey& key) {
  const std::string range = key.range.text().empty() ? "" : " " + key.range.text();
  std::vector<std::string> quoted;
  for (const std::string& choice : key.choices) quoted.push_back(format(choice));
  switch (key.type) {
    case ValueType::boolean:
      return "true or false";
    case ValueType::integer:
      return "a whole number" + range;
    case ValueType::integer_or_auto:
      return "a whole number" + range + ", or " + format(std::string(kAuto));
    case ValueType::number:
      return "a finite number" + range;
    case ValueType::choice:
      return (quoted.size() > 1 ? "one of " : "") + join(quoted);
    case ValueType::text:
      return "a text";
    case ValueType::path:
      return "the path of a file, relative to the config's folder";
    case ValueType::integers:
      return "a list of whole numbers" + range;
    case ValueType::numbers:
      return "a list of finite numbers" + range;
    case ValueType::choices:
      return "a list of " + join(quoted);
    case ValueType::paths:
      return "a list of paths of files, relative to the config's folder";
  }
  return {};
}

std::string differences(const Settings& theirs, const Settings& ours) {
  std::string text;
  for (const ConfigKey& key : config_keys()) {
    const ConfigValue there = key.get(theirs), here = key.get(ours);
    if (there == here || key.full_name() == "experiment.threads") continue;
    text += (text.empty() ? "" : "\n") + key.full_name() + " = " + format_value(there) + ", here " +
            format_value(here);
  }
  return text;
}

}  // namespace drape
