#include "experiments/config.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <system_error>
#include <tuple>

#include "experiments/config_keys.h"
#include "experiments/config_text.h"
#include "experiments/spelling.h"

// toml++ 3.3 asserts on the file "[\", and goes on to a proper error where asserts are off. This is
// the one place that includes it, so asserts and the assumptions they become are off here alone.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#undef TOML_ASSERT
#define TOML_ASSERT(condition) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace drape {
namespace {

// A mistake at a place of the text.
struct Fault {
  toml::source_position at;
  std::string message;
};

std::string place(const std::string& name, const toml::source_position& at) {
  return name + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

// Settings, and for every key that was given where that was.
struct Loaded {
  Settings settings;
  std::map<std::string, std::string> origins;
};

std::string type_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a section";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number with a fraction or exponent";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

[[noreturn]] void refuse_type(const ConfigKey& key, const toml::node& node) {
  throw Fault{node.source().begin,
              key.full_name() + " is " + type_text(node) + "; must be " + allowed_text(key)};
}

[[noreturn]] void refuse_value(const ConfigKey& key, const toml::node& node,
                               const ConfigValue& value) {
  std::string message =
      key.full_name() + " = " + format_value(value) + ": must be " + allowed_text(key);
  if (!key.unit.empty()) message += " " + key.unit;
  if (const auto* text = std::get_if<std::string>(&value))
    if (const auto near = nearest(*text, key.choices)) message += "; did you mean '" + *near + "'?";
  throw Fault{node.source().begin, message};
}

std::int64_t integer(const ConfigKey& key, const toml::node& node) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value) refuse_type(key, node);
  if (!key.range.contains(static_cast<double>(*value))) refuse_value(key, node, *value);
  return *value;
}

double number(const ConfigKey& key, const toml::node& node) {
  if (!node.is_number()) refuse_type(key, node);
  const double value = *node.value<double>();
  if (!key.range.contains(value)) refuse_value(key, node, value);
  return value;
}

std::string choice(const ConfigKey& key, const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse_type(key, node);
  if (std::find(key.choices.begin(), key.choices.end(), *value) == key.choices.end())
    refuse_value(key, node, *value);
  return *value;
}

std::string path(const ConfigKey& key, const toml::node& node,
                 const std::filesystem::path& folder) {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse_type(key, node);
  if (value->find('\0') != std::string::npos) refuse_value(key, node, *value);
  if (value->empty()) return {};
  return std::filesystem::absolute(folder / *value).lexically_normal().string();
}

// Distinct entries; at least one, unless the key's default is the empty list.
template <class EntryOf,
          class Entry = std::invoke_result_t<EntryOf, const ConfigKey&, const toml::node&>>
std::vector<Entry> list(const ConfigKey& key, const toml::node& node, const EntryOf& entry_of) {
  const toml::array* array = node.as_array();
  if (!array) refuse_type(key, node);
  std::vector<Entry> entries;
  std::set<Entry> seen;
  for (const toml::node& element : *array) {
    entries.push_back(entry_of(key, element));
    if (!seen.insert(entries.back()).second)
      throw Fault{element.source().begin,
                  key.full_name() + " has " + format_value(entries.back()) + " twice"};
  }
  if (entries.empty() && !std::get<std::vector<Entry>>(key.get(Settings{})).empty())
    throw Fault{node.source().begin, key.full_name() + " is empty; must be " + allowed_text(key)};
  return entries;
}

ConfigValue value_of(const ConfigKey& key, const toml::node& node,
                     const std::filesystem::path& folder) {
  switch (key.type) {
    case ValueType::boolean:
      if (const auto value = node.value_exact<bool>()) return *value;
      refuse_type(key, node);
    case ValueType::integer:
      return integer(key, node);
    case ValueType::integer_or_auto:
      if (node.value_exact<std::string>() == kAuto) return std::string(kAuto);
      return integer(key, node);
    case ValueType::number:
      return number(key, node);
    case ValueType::choice:
      return choice(key, node);
    case ValueType::path:
      return path(key, node, folder);
    case ValueType::integers:
      return list(key, node, integer);
    case ValueType::numbers:
      return list(key, node, number);
    case ValueType::choices:
      return list(key, node, choice);
    case ValueType::paths:
      return list(key, node, [&folder](const ConfigKey& k, const toml::node& n) {
        return path(k, n, folder);
      });
  }
  return {};
}

// toml++ limits the depth of nested values, but not of the dotted keys it recurses into.
void refuse_endless_keys(std::string_view text, const std::string& name) {
  constexpr int kMostDots = 500;
  toml::source_position at{1, 1};
  int dots = 0;
  for (char c : text) {
    dots = c == '\n' ? 0 : dots + (c == '.' ? 1 : 0);
    if (dots > kMostDots) throw ConfigError(place(name, at) + ": more than 500 dots in a line");
    if (c == '\n') ++at.line;
  }
}

// Throws ConfigError with the mistake that ended the parse.
toml::table parse_toml(std::string_view text, const std::string& name) {
  refuse_endless_keys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(place(name, error.source().begin) + ": " + std::string(error.description()));
  }
}

void read_section(Loaded& loaded, std::vector<Fault>& faults, const std::string& section,
                  const toml::table& table, const std::string& name,
                  const std::filesystem::path& folder) {
  for (const auto& [key_name, node] : table) {
    const ConfigKey* key = find_key(section, key_name.str());
    if (!key) {
      faults.push_back({key_name.source().begin, unknown_key_message(section, key_name.str())});
      continue;
    }
    try {
      key->set(loaded.settings, value_of(*key, node, folder));
      loaded.origins[key->full_name()] = place(name, node.source().begin);
    } catch (const Fault& fault) {
      faults.push_back(fault);
    }
  }
}

Loaded load(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
  Loaded loaded;
  std::vector<Fault> faults;
  const toml::table root = parse_toml(text, name);
  for (const auto& [section, node] : root) {
    const std::string section_name(section.str());
    const bool known = !key_names(section_name).empty();
    if (const toml::table* table = node.as_table(); table && known)
      read_section(loaded, faults, section_name, *table, name, folder);
    else if (known)
      faults.push_back({section.source().begin, "'" + section_name + "' is a section: write [" +
                                                    section_name + "] and its keys below"});
    else if (table)
      faults.push_back({section.source().begin, unknown_section_message(section_name)});
    else
      faults.push_back({section.source().begin, unknown_key_message("", section_name)});
  }
  if (faults.empty()) return loaded;

  std::sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
    return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
  });
  std::string message;
  for (const Fault& fault : faults)
    message += (message.empty() ? "" : "\n") + place(name, fault.at) + ": " + fault.message;
  throw ConfigError(message);
}

void assign(Loaded& loaded, const Assignment& assignment) {
  const auto refuse = [&](const std::string& message) {
    throw ConfigError(assignment.origin + ": " + message);
  };
  const size_t dot = assignment.key.find('.');
  const std::string section = assignment.key.substr(0, dot);
  if (dot == std::string::npos) refuse("'" + section + "' lacks its section, as in mesh.vertices");
  if (key_names(section).empty()) refuse(unknown_section_message(section));
  const std::string key_name = assignment.key.substr(dot + 1);
  const ConfigKey* key = find_key(section, key_name);
  if (!key) refuse(unknown_key_message(section, key_name));

  const std::string& value = assignment.value;
  const bool is_text = key->type == ValueType::choice || key->type == ValueType::path ||
                       (key->type == ValueType::integer_or_auto && value == kAuto);
  const bool quoted = !value.empty() && (value.front() == '"' || value.front() == '\'');
  std::string text = is_text && !quoted ? format_value(value) : value;
  if (key->type == ValueType::number && value.starts_with('.')) text.insert(0, "0");
  try {
    const toml::table table = toml::parse("value = " + text, std::string_view{});
    const toml::node* node = table.get("value");
    if (table.size() != 1 || !node) refuse("must be one value");
    key->set(loaded.settings, value_of(*key, *node, std::filesystem::current_path()));
    loaded.origins[key->full_name()] = assignment.origin;
  } catch (const toml::parse_error& error) {
    refuse(std::string(error.description()) + "; must be " + allowed_text(*key));
  } catch (const Fault& fault) {
    refuse(fault.message);
  }
}

// No config comes near it; images and records given by mistake do.
constexpr std::uintmax_t kLargestFile = 64 * 1024;

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw ConfigError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status))
    throw ConfigError(file.string() + ": is a folder; must be a config file");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file) > kLargestFile)
    throw ConfigError(file.string() + ": is larger than 64 KiB; must be a config file in TOML");
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw ConfigError(file.string() + ": cannot be read");
  return text;
}

// What no key can say alone.
void check_together(const Loaded& loaded, const std::string& name) {
  const Settings& settings = loaded.settings;
  const auto refuse = [&](const std::string& key, const std::string& message) {
    const auto origin = loaded.origins.find(key);
    throw ConfigError((origin == loaded.origins.end() ? name : origin->second) + ": " + message);
  };
  const Kind kind = settings.experiment.kind;
  if (!loaded.origins.contains("experiment.kind"))
    refuse("experiment.kind",
           "experiment.kind is missing; must be " + allowed_text(*find_key("experiment", "kind")));
  try {
    validate(settings.scene);
  } catch (const std::invalid_argument& error) {
    const bool support = loaded.origins.contains("scene.support_radius");
    refuse(support ? "scene.support_radius" : "scene.specimen_radius", error.what());
  }
  for (const ConfigKey& key : config_keys()) {
    if (key.full_name() == "quickstart.photograph" || key.full_name() == "photographs.folder")
      continue;  // the run says so where they are missing
    std::vector<std::string> files;
    if (key.type == ValueType::path) files = {std::get<std::string>(key.get(settings))};
    if (key.type == ValueType::paths) files = std::get<std::vector<std::string>>(key.get(settings));
    std::error_code error;
    for (const std::string& file : files)
      if (!file.empty() && !std::filesystem::is_regular_file(file, error))
        refuse(key.full_name(), key.full_name() + ": there is no file " + file);
  }
  if (kind == Kind::photograph) {
    if (settings.photograph.files.empty())
      refuse("experiment.kind", "a photograph needs photograph.files");
    if (!(settings.photograph.mm_per_pixel > 0))
      refuse("photograph.mm_per_pixel", "a photograph needs photograph.mm_per_pixel > 0");
    if (!(settings.photograph.areal_density > 0))
      refuse("photograph.areal_density", "a photograph needs photograph.areal_density > 0 kg/m^2");
  }
  if (kind == Kind::photographs) {
    if (settings.photographs.folder.empty())
      refuse("experiment.kind", "photographs need photographs.folder");
    if (!(settings.photograph.mm_per_pixel > 0))
      refuse("photograph.mm_per_pixel", "photographs need photograph.mm_per_pixel > 0");
    if (settings.photographs.models.empty())
      refuse("photographs.models", "photographs.models must name a model");
    if (settings.photographs.weighed.size() != settings.photographs.densities.size())
      refuse("photographs.densities",
             "photographs.densities must hold one density for each of "
             "photographs.weighed");
  }
  if (settings.dataset.shard > settings.dataset.shards)
    refuse("dataset.shard", "dataset.shard must be 1 to dataset.shards");
  if (!settings.dataset.table.empty() && !settings.dataset.parameters.empty())
    refuse("dataset.parameters", "dataset.table and dataset.parameters exclude each other");
  if (!settings.dataset.radii.empty() && kind != Kind::dataset)
    refuse("dataset.radii",
           "dataset.radii is only for kind \"dataset\"; set scene.specimen_radius");
  for (const double radius : settings.dataset.radii)
    if (!(radius > settings.scene.support_radius))
      refuse("dataset.radii", "dataset.radii must be larger than scene.support_radius");
  for (const StartProtocol protocol : settings.dataset.protocols)
    if (protocol == StartProtocol::guided)
      refuse("dataset.protocols",
             "dataset.protocols cannot hold \"guided\", which follows one outline");
  if (settings.photograph.prior == PriorKind::tag)
    refuse("photograph.prior", "photograph.prior cannot be \"tag\": a photograph has none");
  if (kind == Kind::quickstart && settings.quickstart.table.empty())
    refuse("experiment.kind", "the quickstart needs quickstart.table");
  if (settings.start.protocol == StartProtocol::guided &&
      settings.start.outline.empty() == settings.start.dataset.empty())
    refuse("start.protocol",
           "a guided start needs either start.outline or start.dataset, and not both");
  if (settings.start.protocol == StartProtocol::ensemble) try {
      ensemble_starts(settings.start.ensemble);
    } catch (const std::invalid_argument& error) {
      refuse("start.protocol", error.what());
    }
  if (!settings.mesh.vertices && kind != Kind::drape)
    refuse("mesh.vertices",
           "mesh.vertices = \"auto\" is only for kind \"drape\"; this kind of experiment needs a "
           "count, as "
           "all that it compares is on one mesh");
  if (!settings.mesh.vertices && settings.start.protocol == StartProtocol::ensemble)
    refuse("mesh.vertices",
           "mesh.vertices = \"auto\" follows one drape; an ensemble needs a count");
  if (kind == Kind::branches && !(settings.branches.softest < settings.branches.stiffest))
    refuse("branches.softest", "branches.softest must be less than branches.stiffest");
  for (const auto& [key, range] :
       {std::pair{"estimate.drape_coefficient", settings.estimate.drape_coefficient},
        {"estimate.anisotropy", settings.estimate.anisotropy}})
    if (range.size() != 2 || !(range[0] < range[1]))
      refuse(key, std::string(key) + " must be two values, from less than to");
  const bool only_forward = kind == Kind::drape || kind == Kind::dataset ||
                            kind == Kind::robustness || kind == Kind::validation ||
                            kind == Kind::accuracy || kind == Kind::work_precision ||
                            kind == Kind::stability;
  if (settings.reading.law == BendingLaw::secant && !only_forward)
    refuse("fabric.bending_law",
           "the secant law has no derivative; this kind of experiment needs \"tangent\"");
}

}  // namespace

Assignment assignment_from_set(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw ConfigError("--set " + text + ": lacks a '='; write section.key=value");
  const auto trimmed = [](const std::string& padded) {
    const size_t first = padded.find_first_not_of(" \t");
    if (first == std::string::npos) return std::string();
    return padded.substr(first, padded.find_last_not_of(" \t") - first + 1);
  };
  return {trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1)), "--set " + text};
}

Settings read_settings(const std::optional<std::filesystem::path>& file,
                       const std::vector<Assignment>& assignments) {
  Loaded loaded;
  if (file) {
    const std::string text = read_text(*file);
    if (text.empty()) throw ConfigError(file->string() + ": is empty; must be a config in TOML");
    loaded = load(text, file->string(), file->parent_path());
  }
  for (const Assignment& assignment : assignments) assign(loaded, assignment);
  check_together(loaded, file ? file->string() : "command line");
  return loaded.settings;
}

Settings parse_settings(std::string_view text, const std::string& name,
                        const std::filesystem::path& folder) {
  return load(text, name, folder).settings;
}

}  // namespace drape
