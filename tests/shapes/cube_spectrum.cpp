#include <algorithm>
#include <iterator>
#include <numbers>

#include "shapes/spectra.h"

namespace tufted::shapes {
namespace {

struct Level {
  double value;
  int multiplicity;
};

// The multiples of pi^2 are exact, of functions that continue across edges by reflection. The others are extrapolated
// from cotan Laplacians of 32 to 108 squares per edge, with terms in h^2 and, due to the corners, cones of angle 3/2
// pi, in h^(8/3).
constexpr double pi2 = std::numbers::pi * std::numbers::pi;
constexpr Level levels[] = {
    {0, 1},        {4.166087, 3}, {11.499176, 3}, {14.136125, 2}, {2 * pi2, 1},  {25.712097, 3}, {26.483317, 3},
    {37.69656, 3}, {4 * pi2, 1},  {44.893586, 3}, {45.557920, 2}, {55.90423, 3}, {60.78901, 2},  {65.68967, 3},
    {69.39999, 3}, {8 * pi2, 1},  {79.74418, 3},  {85.98459, 3},  {93.37752, 2}, {95.86843, 3},  {10 * pi2, 2}};

}  // namespace

VectorXd cubeSpectrum(int count) {
  std::vector<double> values;
  for (const Level& level : levels) values.insert(values.end(), level.multiplicity, level.value);
  return Eigen::Map<VectorXd>(values.data(), std::min<Eigen::Index>(count, std::ssize(values)));
}

}  // namespace tufted::shapes
