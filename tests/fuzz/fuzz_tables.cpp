// Tables of tags and of parameters in CSV: any text is read or refused as std::invalid_argument,
// and what is read is in range.
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "estimation/fabric_import.h"
#include "tests/fuzz/memory_file.h"

using namespace drape;

namespace {

template <class Action>
void reads_or_refuses(Action action) {
  try {
    action();
  } catch (const std::invalid_argument&) {
  }
}

void require(bool holds) {
  if (!holds) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const fuzz::MemoryFile file("table.csv");
  file.write(data, size);
  reads_or_refuses([] {
    for (const Tag& tag : read_tag_table(file.path())) {
      require(std::isfinite(tag.areal_density) && tag.areal_density > 0);
      validate(first_parameters(tag));
      require(composition_from_text(composition_text(tag.composition)).size() ==
              tag.composition.size());
    }
  });
  reads_or_refuses([] {
    for (const TaggedFabric& fabric : read_fabric_table(file.path())) validate(fabric.fabric);
  });
  return 0;
}
