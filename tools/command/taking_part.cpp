#include "taking_part.h"

#include <string>

#include "tufted/errors.h"

namespace {

/// Why a point takes no part, with its row in the results; an empty string if it does.
std::string whyLeftOut(int point, const Operator& source) {
  const tufted::Laplacian& laplacian = source.laplacian;
  const tufted::PointStatus status = laplacian.status[laplacian.representative[point]];
  if (status == tufted::PointStatus::active) return "";
  const std::string name = "point " + std::to_string(point);
  if (status == tufted::PointStatus::not_finite) return name + " is not finite";
  const bool is_excluded = !source.all_components.empty() && source.all_components[point] >= 0;
  return name + (is_excluded ? " lies on a component that " + source.chosen_by + " leaves out" : " is isolated");
}

}  // namespace

void noteLeftOut(const std::vector<int>& points, const Operator& source, Results& results, bool others) {
  constexpr std::size_t most = 3;  // most reasons in the warning; the report has all points
  std::vector<int> left_out;
  std::string why;
  for (const int point : points) {
    const std::string reason = whyLeftOut(point, source);
    if (reason.empty()) continue;
    if (left_out.size() < most) why += (why.empty() ? "" : ", ") + reason;
    left_out.push_back(point);
  }
  if (left_out.empty()) return;
  if (left_out.size() > most) why += " and so on, see report.json";
  if (left_out.size() == points.size() && !others)
    throw tufted::InvalidInput("no point that is named takes part, must be at least one: " + why);
  const std::string count = std::to_string(left_out.size()) + " of " + std::to_string(points.size());
  results.warnings.push_back(count + " points that are named take no part: " + source.chosen.inFile(why));
  results.summary.add("left out", "%s points that are named", count.c_str());
  results.report["left_out"] = left_out;
}

void requireTakingPart(const std::vector<int>& points, const Operator& source) {
  for (const int point : points)
    if (const std::string why = whyLeftOut(point, source); !why.empty())
      throw tufted::InvalidInput(why + ", must take part");
}
