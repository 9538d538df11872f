// The finished items of a run that are a few numbers each: one durable JSON file an item, so that a
// killed run resumes with what it had finished.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/output_folder.h"

namespace drape {

/// Safe to use from several threads, one thread an item.
class JsonStore {
 public:
  /// Takes up what the folder holds in its subfolder `name`.
  JsonStore(const OutputFolder& folder, const std::string& name);

  bool has(const std::string& item) const;
  /// On return the item is on disk; NaN and infinity become null.
  void save(const std::string& item, const nlohmann::ordered_json& content) const;
  /// Throws std::invalid_argument if the file is missing or damaged.
  nlohmann::ordered_json load(const std::string& item) const;

 private:
  std::filesystem::path file(const std::string& item) const { return path_ / (item + ".json"); }

  std::filesystem::path path_;
};

/// A number of such a file, NaN for null.
double number(const nlohmann::ordered_json& value);

}  // namespace drape
