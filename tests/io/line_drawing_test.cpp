// lines.svg, the plan of lines that writeResults() draws.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "../support/refusal.h"
#include "temporary_dir.h"
#include "tufted/io/results.h"

namespace line_drawing_test {
namespace {

tufted::Polyline lineOf(const std::vector<Eigen::RowVector3d>& points, double value, bool is_closed = false) {
  tufted::Polyline line = {.points = {}, .is_closed = is_closed, .length = 1, .value = value};
  line.points.resize(std::ssize(points), 3);
  for (std::size_t k = 0; k < points.size(); ++k) line.points.row(static_cast<Eigen::Index>(k)) = points[k];
  return line;
}

std::string drawn(const std::vector<tufted::Polyline>& lines) {
  const TemporaryDir dir;
  tufted::writeResults(dir / "out", {}, {}, {}, {.copies = {}, .lines = lines});
  return readAll(dir / "out/lines.svg");
}

int countOf(const std::string& text, const std::string& word) {
  int count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(LineDrawing, IsToScaleWithTheLargerYAbove) {
  const std::string svg = drawn({lineOf({{0, 0, 5}, {4, 0, 5}, {4, 2, 7}}, 1), lineOf({{1, 1, 0}, {2, 1, 0}}, 2.5)});
  EXPECT_TRUE(svg.find("d=\"M20 420L820 420L820 20\"") != std::string::npos) << svg;  // 800 pixels for 4 units
  EXPECT_TRUE(svg.find("d=\"M220 220L420 220\"") != std::string::npos) << svg;
  EXPECT_TRUE(svg.find("h200\"") != std::string::npos && svg.find(">1 in the unit") != std::string::npos) << svg;
  EXPECT_LT(svg.find(">2.5<"), svg.find(">1<")) << svg;  // the legend, with the larger value at the top
  EXPECT_EQ(countOf(svg, "Z\""), 0);
}

TEST(LineDrawing, DoesNotChangeWhereTheOriginIsAndWithTheUnit) {
  const auto square = [](double at, double side) {
    return std::vector<tufted::Polyline>{
        lineOf({{at, at, 0}, {at + side, at, 0}, {at + side, at + side, 0}, {at, at + side, 0}}, 3, true)};
  };
  const std::string svg = drawn(square(0, 1));
  EXPECT_EQ(countOf(svg, "L20 20Z\""), 1) << svg;
  EXPECT_EQ(drawn(square(1e9, 1)), svg);
  for (const double side : {1e-300, 1e300}) {
    const std::string other = drawn(square(0, side));
    EXPECT_EQ(other.substr(0, other.find("</g>")), svg.substr(0, svg.find("</g>")));
  }
  EXPECT_EQ(countOf(drawn(square(-1.7e308, 1.7e308)), "nan"), 0);
}

TEST(LineDrawing, NamesAtMostTwentyOfManyValues) {
  std::vector<tufted::Polyline> lines;
  for (int k = 0; k < 100; ++k) lines.push_back(lineOf({{0, k / 10., 0}, {9, k / 10., 0}}, k));
  const std::string svg = drawn(lines);
  EXPECT_EQ(countOf(svg, "h20\""), 20);
  EXPECT_TRUE(svg.find(">99<") != std::string::npos && svg.find(">0<") != std::string::npos) << svg;
}

TEST(LineDrawing, SaysWhereThereIsNothingToDraw) {
  EXPECT_EQ(countOf(drawn({}), ">No lines<"), 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(countOf(drawn({lineOf({{0, nan, 0}, {1, 0, 0}}, 0)}), ">No lines<"), 1);
  const std::string dot = drawn({lineOf({{7, 7, 0}, {7, 7, 1}}, 0)});
  EXPECT_EQ(countOf(dot, ">All lines are at one place<"), 1) << dot;
  EXPECT_EQ(countOf(dot, "d=\"M20 20L20 20\""), 1) << dot;
  EXPECT_EQ(countOf(dot, "h20\""), 0);  // the value 0 of lines that are no isolines has no legend
}

}  // namespace
}  // namespace line_drawing_test
