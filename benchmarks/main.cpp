// The benchmark program: Google Benchmark's own options, with version, commit and compiler beside
// every result.
#include <benchmark/benchmark.h>

#include <string>

#include "core/version.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("version", std::string(drape::version()));
  benchmark::AddCustomContext("git_commit", std::string(drape::git_commit()));
  benchmark::AddCustomContext("compiler", std::string(drape::compiler()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
