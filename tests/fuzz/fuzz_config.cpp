// Config files and what the command line changes in them: any text is read or refused as
// ConfigError, and what is read comes back from its written form.
//
// The bytes up to the first NUL are the file; the texts between further NULs are those of --set,
// and the first one is asked of `drape explain`.
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/config.h"
#include "experiments/config_text.h"
#include "tests/fuzz/memory_file.h"

using namespace drape;

namespace {

void require(bool holds) {
  if (!holds) __builtin_trap();
}

template <class Refusal, class Action>
void reads_or_refuses(Action action) {
  try {
    action();
  } catch (const Refusal&) {
  }
}

std::vector<std::string> split_at_nul(const std::string& bytes) {
  std::vector<std::string> texts(1);
  for (const char c : bytes)
    if (c == '\0')
      texts.emplace_back();
    else
      texts.back() += c;
  return texts;
}

void require_comes_back(const Settings& settings) {
  const std::string written = write_settings(settings);
  const Settings again = parse_settings(written, "written", "/");
  require(differences(settings, again).empty() && write_settings(again) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const fuzz::MemoryFile file("config.toml");
  const std::vector<std::string> texts = split_at_nul({data, data + size});
  const std::string& config = texts.front();
  file.write(config.data(), config.size());
  reads_or_refuses<ConfigError>([&] { require_comes_back(parse_settings(config, "text", "/")); });
  reads_or_refuses<ConfigError>([&] {
    std::vector<Assignment> assignments;
    for (size_t i = 1; i < texts.size(); ++i) assignments.push_back(assignment_from_set(texts[i]));
    require_comes_back(read_settings(file.path(), assignments));
  });
  if (texts.size() > 1 && !texts[1].empty())
    reads_or_refuses<std::invalid_argument>(
        [&] { explain(texts[1].substr(0, texts[1].find('='))); });
  return 0;
}
