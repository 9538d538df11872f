// Texts about settings: the resolved config, the answers of `drape explain`, words for errors.
#pragma once

#include <string>
#include <string_view>

#include "experiments/config_keys.h"

namespace drape {

/// All settings as a config file: parse_settings() gives the same settings back, to the last bit.
std::string write_settings(const Settings& settings);

/// One value as TOML; numbers as short as they come back exactly.
std::string format_value(const ConfigValue& value);

/// What there is to know about "" (all sections), a section, "section.key" or a key's bare name.
/// Throws std::invalid_argument with a suggestion if there is no such thing.
std::string explain(std::string_view query);

/// "unknown key 'solver.tolerence'; did you mean 'tolerance'?", or what the section offers.
std::string unknown_key_message(std::string_view section, std::string_view key);

/// The same for a section.
std::string unknown_section_message(std::string_view section);

/// What a value of this key may be, as "a number > 0 and <= 1" or "one of "ramp", "lobes"".
std::string allowed_text(const ConfigKey& key);

/// The keys (but experiment.threads, which changes no result) with different values, as
/// "mesh.vertices = 2000, here 1000" (theirs, then ours), one a line; "" if there are none.
std::string differences(const Settings& theirs, const Settings& ours);

}  // namespace drape
