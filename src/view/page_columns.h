#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace tufted::view {

/// Numbers as the page stores them, `least + step * level`, but for those that lie far from the others.
struct LevelColumn {
  double least = 0;                     ///< the value of level 0
  double step = 0;                      ///< between two levels
  std::vector<std::uint16_t> levels;    ///< of each row; `no_level` for NaN and infinite values
  std::vector<std::uint32_t> far_rows;  ///< rows whose value is off the levels, ascending; theirs is the nearest level
  std::vector<double> far_values;       ///< the values of these rows
  double minimum = 0, maximum = 0;      ///< of all finite values; 0 where there is none
  double low = 0, high = 0;             ///< the 1st and the 99th percentile of the finite values
  Eigen::Index finite = 0;              ///< how many values are finite
};

/// The level of values that are not finite; the greatest level is one less.
constexpr std::uint16_t no_level = 65535;

LevelColumn levelsOf(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Integers that name things, as the page stores them: `names[index]`.
struct LabelColumn {
  std::vector<double> names;           ///< the different finite values, ascending
  std::vector<std::uint32_t> indices;  ///< of each row into `names`; the number of names for values that are not finite
};

LabelColumn labelsOf(const Eigen::Ref<const Eigen::VectorXd>& values);

/// A direction in two bytes: the octahedral map (Meyer et al. 2010, "On floating-point normal vectors") with steps of
/// 1/127, each byte 128 more than the step; 0, 0 where the vector has no direction.
void octahedralBytes(const Eigen::Vector3d& direction, std::uint8_t bytes[2]);

}  // namespace tufted::view
