#include "reports.h"

void addReport(const tufted::SolveReport& report, Results& results) {
  results.report["report"] = {
      {"iterations", report.iterations}, {"residual", report.residual}, {"seconds", report.seconds}};
  results.summary.add("solve", "residual %.1e, %.3g s", report.residual, report.seconds);
}

void addReport(const tufted::SpectrumReport& report, Results& results) {
  results.report["report"] = {{"null_space", report.null_space},
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
  results.summary.add("exactly zero", "%d", report.null_space);
  if (report.iterations > 0)
    results.summary.add("iterations", "%d, residual %.1e, %s", report.iterations, report.residual,
                        report.solver.method.c_str());
  results.summary.add("took", "%.3g s", report.seconds);
}
