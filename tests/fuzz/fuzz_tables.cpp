// Tables of tags, of parameters and of photographs in CSV: any text is read or refused as
// std::invalid_argument, and what is read is in range.
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "estimation/fabric_import.h"
#include "estimation/photograph_manifest.h"
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
  reads_or_refuses([] {
    for (const PhotographedFabric& fabric : read_photograph_manifest(file.path())) {
      require(std::isfinite(fabric.areal_density) && fabric.areal_density > 0);
      require(std::isfinite(fabric.mm_per_pixel) && fabric.mm_per_pixel > 0);
      require(fabric.id.find('/') == std::string::npos && !fabric.files.empty());
      require(fabric.specimen_radius_mm.empty() ||
              fabric.specimen_radius_mm.size() == fabric.files.size());
    }
  });
  return 0;
}
