#include "reports.h"

namespace {

nlohmann::ordered_json toJson(const tufted::SolverReport& solver) {
  return {{"method", solver.method},
          {"unknowns", solver.unknowns},
          {"nonzeros", solver.nonzeros},
          {"bytes", solver.bytes},
          {"seconds", solver.seconds}};
}

}  // namespace

void addReport(const tufted::SolveReport& report, Results& results) {
  results.report["report"] = {{"method", report.method},
                              {"iterations", report.iterations},
                              {"residual", report.residual},
                              {"seconds", report.seconds}};
  results.summary.add("solve", "residual %.1e, %s, %.3g s", report.residual, report.method.c_str(), report.seconds);
}

void addReport(const tufted::SpectrumReport& report, Results& results) {
  results.report["report"] = {{"method", report.method},         {"null_space", report.null_space},
                              {"iterations", report.iterations}, {"counted", report.counted},
                              {"residual", report.residual},     {"backward_error", report.backward_error},
                              {"weak_pair", report.weak_pair},   {"orthogonality", report.orthogonality},
                              {"seconds", report.seconds},       {"solver", toJson(report.solver)}};
  results.summary.add("exactly zero", "%d", report.null_space);
  if (report.iterations > 0)
    results.summary.add("iterations", "%d, residual %.1e, %s", report.iterations, report.residual,
                        report.solver.method.c_str());
  else if (!report.method.empty())
    results.summary.add("method", "%s, residual %.1e", report.method.c_str(), report.residual);
  if (report.weak_pair >= 0)
    results.summary.add("nearly disconnected",
                        "pair %d, above and below 0: its residual is rounding, backward error %.1e", report.weak_pair,
                        report.backward_error);
  results.summary.add("took", "%.3g s", report.seconds);
}

void addReport(const tufted::DistanceReport& report, const tufted::SolverReport& solver, Results& results) {
  results.report["report"] = {{"rounds", report.rounds},
                              {"iterations", report.iterations},
                              {"residual", report.residual},
                              {"seconds", report.seconds},
                              {"solver", toJson(solver)}};
  results.summary.add("prepared", "%s, %.3g s", solver.method.c_str(), solver.seconds);
  results.summary.add("query", "%d rounds of heat, residual %.1e, %.3g s", report.rounds, report.residual,
                      report.seconds);
}
