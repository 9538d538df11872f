// Types and fibres as people write them: capitals, plurals, order of words and common synonyms do
// not matter.
#pragma once

#include <string_view>

#include "estimation/fabric_types.h"
#include "estimation/fibre_kinds.h"

namespace drape {

/// "jerseys", "Crepe", "double knit" -> a type of Table 1. Throws std::invalid_argument that names
/// the nearest type, or lists all where none is near.
const FabricType& type_from_text(std::string_view text);

/// "Lycra", "polyamide", "polyester (recycled)" -> a fibre of Table 2. Throws likewise.
const FibreKind& fibre_from_text(std::string_view text);

/// "Cotton 59, Modal 40" with the fibres' names of Table 2: like composition_from_text, and commas
/// separate as well.
std::vector<Fibre> composition_from_words(std::string_view text);

/// Type and fibres by their names of Tables 1 and 2, and the subcategory of the type; what is empty
/// stays so. Throws likewise.
Tag in_known_words(Tag tag);

}  // namespace drape
