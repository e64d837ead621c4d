// tufted_bench: time and memory of builds, per stage. All flags are Google Benchmark's own, for instance
//   tufted_bench --benchmark_filter='cloud/sphere/1000000/clean/threads:1' --benchmark_out=costs.json
// Peak memory includes what earlier cases leave behind, so run one case only to measure it.
#include "bench/costs.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  tufted::bench::registerClouds();
  tufted::bench::registerMeshes();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
