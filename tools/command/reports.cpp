#include "reports.h"

#include <cstdint>
#include <optional>
#include <string>

namespace {

nlohmann::ordered_json toJson(const tufted::SolverReport& solver) {
  return {{"method", solver.method},
          {"unknowns", solver.unknowns},
          {"nonzeros", solver.nonzeros},
          {"bytes", solver.bytes},
          {"seconds", solver.seconds}};
}

nlohmann::ordered_json toJson(const std::optional<tufted::WeakJoint>& joint) {
  if (!joint) return nullptr;
  nlohmann::ordered_json parts = {{{"point", joint->first}, {"size", joint->first_points}}};
  if (joint->second >= 0) parts.push_back({{"point", joint->second}, {"size", joint->second_points}});
  return {{"parts", parts}, {"weight", joint->weight}};
}

void addJoint(const std::optional<tufted::WeakJoint>& joint, Results& results) {
  if (!joint) return;
  const auto part = [](int first, std::int64_t points) {
    return first < 0 ? std::string("what is fixed")
                     : std::to_string(points) + " points (the first is " + std::to_string(first) + ")";
  };
  results.summary.add("beware", "nearly disconnected: a weight of %.3g joins %s to %s", joint->weight,
                      part(joint->first, joint->first_points).c_str(),
                      part(joint->second, joint->second_points).c_str());
}

/// Adds what reports of heat methods share.
template <class Report>
void addHeat(const Report& report, const tufted::SolverReport& solver, Results& results) {
  results.report["report"] = {{"rounds", report.rounds},     {"iterations", report.iterations},
                              {"residual", report.residual}, {"backward_error", report.backward_error},
                              {"seconds", report.seconds},   {"solver", toJson(solver)}};
  results.summary.addDetail("prepared", "%s, %.3g s", solver.method.c_str(), solver.seconds);
  results.summary.addDetail("query", "%d rounds of heat, residual %.1e, backward error %.1e, %.3g s", report.rounds,
                            report.residual, report.backward_error, report.seconds);
}

}  // namespace

void addReport(const tufted::SolveReport& report, Results& results) {
  results.report["report"] = {{"method", report.method},
                              {"iterations", report.iterations},
                              {"residual", report.residual},
                              {"backward_error", report.backward_error},
                              {"nearly_disconnected", toJson(report.weak_joint)},
                              {"seconds", report.seconds}};
  results.summary.addDetail("solve", "residual %.1e, backward error %.1e, %s, %.3g s", report.residual,
                            report.backward_error, report.method.c_str(), report.seconds);
  addJoint(report.weak_joint, results);
}

void addReport(const tufted::SpectrumReport& report, Results& results) {
  results.report["report"] = {{"method", report.method},         {"null_space", report.null_space},
                              {"iterations", report.iterations}, {"counted", report.counted},
                              {"residual", report.residual},     {"backward_error", report.backward_error},
                              {"weak_pair", report.weak_pair},   {"orthogonality", report.orthogonality},
                              {"seconds", report.seconds},       {"solver", toJson(report.solver)}};
  if (report.iterations > 0)
    results.summary.addDetail("iterations", "%d, residual %.1e, %s", report.iterations, report.residual,
                              report.solver.method.c_str());
  else if (!report.method.empty())
    results.summary.addDetail("method", "%s, residual %.1e", report.method.c_str(), report.residual);
  if (report.weak_pair >= 0)
    results.summary.add("nearly disconnected",
                        "pair %d, above and below 0: its residual is rounding, backward error %.1e", report.weak_pair,
                        report.backward_error);
}

void addReport(const tufted::DistanceReport& report, const tufted::SolverReport& solver, Results& results) {
  if (solver.method == "marching") {
    results.report["report"] = {{"split", report.split},
                                {"visits", report.visits},
                                {"lowered", report.lowered},
                                {"seconds", report.seconds},
                                {"solver", toJson(solver)}};
    results.summary.addDetail("prepared", "faces to march over, %.3g s", solver.seconds);
    results.summary.addDetail("query", "%lld points and middles of edges, %.3g s",
                              static_cast<long long>(report.visits), report.seconds);
    return;
  }
  addHeat(report, solver, results);
  results.report["report"]["nearly_disconnected"] = toJson(report.weak_joint);
  addJoint(report.weak_joint, results);
}

void addReport(const tufted::VectorHeatReport& report, const tufted::SolverReport& solver, Results& results) {
  addHeat(report, solver, results);
}
