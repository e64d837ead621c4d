#include "spectrum_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

nlohmann::ordered_json reportOf(const tufted::SpectrumReport& report) {
  return {{"null_space", report.null_space},
          {"iterations", report.iterations},
          {"counted", report.counted},
          {"residual", report.residual},
          {"orthogonality", report.orthogonality},
          {"seconds", report.seconds},
          {"solver",
           {{"method", report.solver.method},
            {"unknowns", report.solver.unknowns},
            {"nonzeros", report.solver.nonzeros},
            {"bytes", report.solver.bytes},
            {"seconds", report.solver.seconds}}}};
}

void printSpectrumReport(const tufted::SpectrumReport& report) {
  std::printf("%-15s %d\n", "exactly zero", report.null_space);
  if (report.iterations > 0)
    std::printf("%-15s %d, residual %.1e, %s\n", "iterations", report.iterations, report.residual,
                report.solver.method.c_str());
  std::printf("%-15s %.3g s\n", "took", report.seconds);
}
