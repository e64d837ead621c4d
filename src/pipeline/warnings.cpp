#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tufted/denoise.h"
#include "tufted/report.h"
#include "tufted/scan_structure.h"

namespace tufted {
namespace {

/// If more than this share of the active points has a thick neighbourhood, a warning says so: 27 real clouds have at
/// most 0.19, the vertices of coarse meshes with thin parts up to 0.28, cables 9 spacings around 0.56.
constexpr double many_thick = 0.25;
/// If lengthened edges add more than this share of the area, a warning says so; less is invisible in a plot.
constexpr double much_area = 1e-3;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

/// Warns of a depth image with too many missing pixels.
void addSparseImage(double share, std::vector<std::string>& all) {
  if (share <= most_sparse) return;
  all.push_back("fewer than half of the pixels hold points around " + percent(share) +
                " of the surface in the image: as a plain cloud, without its pixels, it does better above " +
                percent(most_sparse));
}

}  // namespace

std::vector<std::string> warnings(const Report& report) {
  std::vector<std::string> all;
  const auto add = [&all](bool holds, const std::string& sentence) {
    if (holds) all.push_back(sentence);
  };
  const auto count = [](std::int64_t number) { return std::to_string(number); };
  if (report.active == 0)
    return {report.points == 0 ? "no point is active, there are none"
                               : "no point is active: " + count(report.not_finite) + " not finite, " +
                                     count(report.coincident) + " coincident, " + count(report.isolated) + " isolated"};
  const double right = report.cover_area - report.area_added;
  add(std::abs(report.area_added) > much_area * right,
      "the surface has " +
          (right > 0 ? percent(std::abs(report.area_added) / right) + (report.area_added > 0 ? " more" : " less")
                     : std::string("more")) +
          " area than its triangles, which are too thin for the lengths of their edges to say their shape (" +
          count(report.lengthened_edges) + " edges lengthened)");
  add(report.flip_failures > 0, "flips did not finish: " + count(report.flip_failures) + " edges are not Delaunay");
  add(report.clamped_large > 0,
      count(report.clamped_large) + " weights of edges were negative by more than rounding and are set to 0");
  add(report.isolated > report.active, count(report.isolated) + " of " + count(report.points) +
                                           " points take no part: no triangle has them as a corner");
  add(report.neighbors_clamped,
      "the neighbourhood of each point is the whole cloud, so that areas mean little: fewer neighbours than " +
          count(report.neighbors) + " may do better");
  add(static_cast<double>(report.thick_neighborhoods) > many_thick * static_cast<double>(report.active),
      "the neighbourhoods of " + count(report.thick_neighborhoods) + " of " + count(report.points) +
          " points are as thick as wide, as in volumes and on cables that " + count(report.neighbors) +
          " neighbours reach around: areas may be far off, and fewer neighbours may do better");
  addSparseImage(report.sparse_share, all);
  return all;
}

std::vector<std::string> warnings(const DenoiseReport& report) {
  std::vector<std::string> all;
  addSparseImage(report.sparse_share, all);
  return all;
}

}  // namespace tufted
