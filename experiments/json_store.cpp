#include "experiments/json_store.h"

#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/durable_file.h"
#include "experiments/summary.h"

namespace drape {

JsonStore::JsonStore(const OutputFolder& folder, const std::string& name) : path_(folder / name) {
  std::filesystem::create_directories(path_);
}

bool JsonStore::has(const std::string& item) const { return std::filesystem::exists(file(item)); }

void JsonStore::save(const std::string& item, const nlohmann::ordered_json& content) const {
  write_text_durably(file(item), summary_text(content));
}

nlohmann::ordered_json JsonStore::load(const std::string& item) const {
  std::ifstream stream(file(item));
  auto content = nlohmann::ordered_json::parse(stream, nullptr, false);
  if (!content.is_object())
    throw std::invalid_argument(file(item).string() +
                                ": is missing or damaged; remove it to redo that item");
  return content;
}

double number(const nlohmann::ordered_json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

}  // namespace drape
