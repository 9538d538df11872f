// What settings must fulfil together, beyond the range of each.
#pragma once

#include <functional>
#include <string>

#include "experiments/settings.h"

namespace drape {

/// Does not return: throws with the message, about the key's place in a config.
using Refuse = std::function<void(const std::string& key, const std::string& message)>;

/// Refuses what does not fit together; files and the scene aside.
void check_fit(const Settings& settings, const Refuse& refuse);

}  // namespace drape
