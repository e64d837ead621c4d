// tufted_bench: what a build costs, per stage. All flags are Google Benchmark's own, for instance
//   tufted_bench --benchmark_filter='cloud/sphere/1000000/clean/threads:1' --benchmark_out=costs.json
// What earlier cases leave behind counts as peak memory: run one case alone to read it.
#include "bench/costs.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  tufted::bench::registerClouds();
  tufted::bench::registerMeshes();
#ifdef TUFTED_BENCH_IO
  tufted::bench::registerPictures();
#endif
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
