// tufted_bench: what a build costs, per stage. All flags are Google Benchmark's own, for instance
//   tufted_bench --benchmark_filter='cloud/star/star/1000000/threads:1' --benchmark_out=costs.json
// Peak memory is a figure of the process: run one case alone to read it.
#include "bench/costs.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  tufted::bench::registerClouds();
  tufted::bench::registerMeshes();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
