#include "denoise/rim_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shapes/random.h"

namespace tufted::rim_profile_test {
namespace {

/// Points a spacing of 1 apart on average, up to x = bend y^2, all moved by normal noise.
RimStrip noisyStrip(double sigma, double bend, bool has_line, std::uint64_t seed) {
  shapes::Random random(seed);
  RimStrip strip{.half = 9, .depth = 7, .points = {}};
  const auto add = [&](double x, double y) {
    const Eigen::Vector2d at(x + bend * y * y + sigma * random.normal(), y + sigma * random.normal());
    if (std::abs(at.y()) < strip.half && at.x() < strip.depth) strip.points.push_back(at);
  };
  for (int i = 0; i < 26 * 14; ++i) add(random.uniform(0, 14), random.uniform(-13, 13));
  for (int i = 0; i < 26 && has_line; ++i) add(0, i - 12.5);
  return strip;
}

TEST(RimProfile, FindsTheRimThatNoiseHasBlurred) {
  for (const bool has_line : {false, true}) {
    const RimLine line = has_line ? RimLine::some : RimLine::none;
    double edge = 0, bend = 0, density = 0;
    constexpr int seeds = 40;
    for (int seed = 1; seed <= seeds; ++seed) {
      RimProfile start;
      start.density = 0.8;
      start.line = 0.3;
      const RimProfile found = fitRimProfile(noisyStrip(0.5, 0.01, has_line, seed), 0.5, line, start);
      edge += (found.curve.edge - found.curve.bend / 3) / seeds;  // at y = 0
      bend += found.curve.bend / 81 / seeds;
      density += found.density / seeds;
    }
    EXPECT_NEAR(edge, 0, 0.15) << has_line;
    EXPECT_NEAR(bend, 0.01, 0.003) << has_line;
    EXPECT_NEAR(density, 1, 0.1) << has_line;
  }
}

TEST(RimProfile, TellsARimInItsPlaceFromABlurredOne) {
  RimProfile start;
  start.density = 1;
  start.line = 0.3;
  double of_blurred = 0, of_sharp = 0;  // how much likelier a blur is
  for (int seed = 1; seed <= 40; ++seed) {
    const auto gain = [&](const RimStrip& strip) {
      return fitRimProfile(strip, 0.5, RimLine::some, start).likelihood -
             fitRimProfile(strip, 0.125, RimLine::some, start).likelihood;
    };
    of_blurred += gain(noisyStrip(0.5, 0, true, seed)) / 40;
    of_sharp += gain(noisyStrip(0, 0, true, seed)) / 40;
  }
  EXPECT_GT(of_blurred, -1);
  EXPECT_LT(of_sharp, -5);
}

}  // namespace
}  // namespace tufted::rim_profile_test
