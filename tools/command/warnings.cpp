#include "warnings.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "tufted/describe.h"

std::string nothingActive(const tufted::Laplacian& laplacian) {
  tufted::Report counts;
  counts.points = std::ssize(laplacian.status);
  for (const tufted::PointStatus status : laplacian.status) {
    if (status == tufted::PointStatus::active) return "";
    counts.not_finite += status == tufted::PointStatus::not_finite ? 1 : 0;
    counts.coincident += status == tufted::PointStatus::coincident ? 1 : 0;
    counts.isolated += status == tufted::PointStatus::isolated ? 1 : 0;
  }
  return tufted::warnings(counts).front();
}

std::vector<std::string> warningsOf(const std::string& file, const tufted::Geometry& geometry,
                                    const std::vector<std::string>& computed) {
  std::vector<std::string> lines = geometry.notes;
  const std::string line = geometry.is_mesh || geometry.height > 1 ? "" : tufted::hoveringWarning(geometry.points);
  if (!line.empty()) lines.push_back(file + ": " + line);
  for (const std::string& each : computed) lines.push_back(file + ": " + each);
  return lines;
}

void warn(ProgressBar& bar, const std::string& line) {
  bar.clear();
  std::string text = "tufted: " + line;
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fprintf(stderr, "%s\n", text.c_str());
}
