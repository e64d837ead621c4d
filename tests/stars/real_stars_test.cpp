// Stars of real depth images, full of exact collinearities, against CGAL.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/compare_stars.h"
#include "tufted/io/read.h"

namespace tufted::real_stars_test {
namespace {

TEST(RealScans, HaveCgalsStarsAtEverySixteenthPoint) {
  const std::filesystem::path folder = std::filesystem::path(TUFTED_DATA_DIR) / "clouds";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is absent";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const support::StarComparison comparison = support::compareStars(read(entry.path(), ReadAs::cloud).points, 16);
    RecordProperty(entry.path().stem().string(),
                   std::to_string(comparison.stars) + " stars, " + std::to_string(comparison.with_ties) + " with ties");
    EXPECT_EQ(comparison.different, 0) << entry.path() << ": " << comparison.first_difference;
    EXPECT_GT(comparison.stars, 0) << entry.path();
  }
}

}  // namespace
}  // namespace tufted::real_stars_test
