#include "experiments/tag_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/spelling.h"

namespace drape {
namespace {

struct Synonym {
  std::string_view words, name;
};

constexpr std::array kFibreSynonyms = std::to_array<Synonym>({
    {"Lycra", kElastane},
    {"Polyurethane elastomer", kElastane},
    {"Polyamide", "Nylon"},
    {"PA", "Nylon"},
    {"PES", "Polyester"},
    {"PET", "Polyester"},
    {"Polyethylene", "PE"},
    {"Viscose", "Viscose rayon"},
    {"Rayon", "Viscose rayon"},
    {"Flax", "Linen"},
    {"Bamboo", "Bamboo viscose"},
    {"Lurex", "Metallic"},
    {"Lame", "Metallic"},
    {"Cationic polyester", "Cation"},
    {"Aluminum", "Aluminium"},
    {"Tencel lyocell", "TENCEL"},
});
constexpr std::array kTypeSynonyms = std::to_array<Synonym>({
    {"Faux leather", "Vegan leather"},
    {"Artificial leather", "Vegan leather"},
    {"Faux fur", "Vegan fur"},
    {"Faux suede", "Vegan suede"},
    {"Double gauze", "Gauze / Double gauze"},
    {"Crepe de chine", "Crepe / CDC"},
    {"Scuba knit", "Neoprene / Scuba"},
    {"Single jersey", "Jersey"},
    {"Ponte roma", "Ponte"},
});

/// The words in lower case without plural, in alphabetical order.
std::string key_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  std::erase(words, "tm");
  for (std::string& word : words) {  // but "canvas", and "pes" is too short to be a plural
    const bool plural =
        word.size() > 3 && word.ends_with("s") && !word.ends_with("ss") && !word.ends_with("as");
    if (plural) word.pop_back();
  }
  std::sort(words.begin(), words.end());
  std::string key;
  for (const std::string& word : words) key += (key.empty() ? "" : " ") + word;
  return key;
}

/// From keys to entries: the full name, each of its parts between '/', and the synonyms.
template <class Entry>
class Names {
 public:
  Names(std::span<const Entry> entries, std::span<const Synonym> synonyms) : entries_(entries) {
    for (const Entry& entry : entries) {
      by_key_[key_of(entry.name)] = &entry;
      std::string_view rest = entry.name;
      for (size_t slash = 0; slash != std::string_view::npos;) {
        slash = rest.find('/');
        by_key_.emplace(key_of(rest.substr(0, slash)), &entry);  // a full name goes first
        if (slash != std::string_view::npos) rest.remove_prefix(slash + 1);
      }
    }
    for (const Synonym& synonym : synonyms)
      for (const Entry& entry : entries)
        if (entry.name == synonym.name) by_key_.emplace(key_of(synonym.words), &entry);
  }

  const Entry& find(std::string_view text, const char* what) const {
    const std::string key = key_of(text);
    if (const auto found = by_key_.find(key); found != by_key_.end()) return *found->second;
    std::string message = std::string("unknown ") + what + " '" + std::string(text) + "'; ";
    std::vector<std::string> keys;
    for (const auto& [known, entry] : by_key_) keys.push_back(known);
    if (const auto near = nearest(key, keys)) {
      message += "did you mean '" + std::string(by_key_.at(*near)->name) + "'?";
    } else {
      message += "known are";
      for (const Entry& entry : entries_)
        message += (&entry == entries_.data() ? " " : ", ") + std::string(entry.name);
    }
    throw std::invalid_argument(message);
  }

 private:
  std::span<const Entry> entries_;
  std::map<std::string, const Entry*> by_key_;
};

}  // namespace

const FabricType& type_from_text(std::string_view text) {
  static const Names<FabricType> names(fabric_types(), kTypeSynonyms);
  return names.find(text, "type");
}

const FibreKind& fibre_from_text(std::string_view text) {
  static const Names<FibreKind> names(fibre_kinds(), kFibreSynonyms);
  return names.find(text, "fibre");
}

std::vector<Fibre> composition_from_words(std::string_view text) {
  std::string separated(text);
  std::replace(separated.begin(), separated.end(), ',', ';');
  std::erase(separated, '%');
  std::vector<Fibre> fibres = composition_from_text(separated);
  for (size_t i = 0; i < fibres.size(); ++i) {
    const std::string written = fibres[i].name;
    fibres[i].name = fibre_from_text(written).name;
    for (size_t j = 0; j < i; ++j)
      if (fibres[j].name == fibres[i].name)
        throw std::invalid_argument("composition '" + std::string(text) + "': '" + written +
                                    "' is " + fibres[i].name +
                                    ", which occurs twice; add its percents");
  }
  return fibres;
}

Tag in_known_words(Tag tag) {
  if (!tag.type.empty()) {
    const FabricType& type = type_from_text(tag.type);
    tag.type = type.name;
    tag.subcategory = type.subcategory;
  }
  if (!tag.composition.empty())
    tag.composition = composition_from_words(composition_text(tag.composition));
  return tag;
}

}  // namespace drape
