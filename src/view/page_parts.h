#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tufted::view {

/// Collects blocks of numbers for a page, each in an HTML element of a type that browsers do not run: deflated, in
/// base64.
class PageBlocks {
 public:
  /// Adds integers, stored as differences from the one before, which are small for neighbouring points.
  /// @return the number of the block, counted from 0, by which its element is named
  int add(const std::vector<std::uint8_t>& values);
  int add(const std::vector<std::uint16_t>& values);
  int add(const std::vector<std::uint32_t>& values);
  /// Adds numbers, stored bit for bit.
  int add(const std::vector<double>& values);

  /// The elements of all blocks.
  const std::string& html() const { return html_; }

 private:
  int addBytes(const std::vector<std::uint8_t>& bytes);

  std::string html_;
  int count_ = 0;
};

/// Encodes bytes in base64 (RFC 4648).
std::string base64(std::string_view bytes);

/// A column of numbers as a page stores it: `least + step * level`, except values far from the others, which are stored
/// in full.
struct LevelColumn {
  double least = 0;                     ///< the value of level 0
  double step = 0;                      ///< difference of the values of two neighbouring levels
  std::vector<std::uint16_t> levels;    ///< level of each row; `no_level` for NaN and infinite values
  std::vector<std::uint32_t> far_rows;  ///< rows stored in full, ascending; their level is the nearest one
  std::vector<double> far_values;       ///< values of these rows
  double minimum = 0, maximum = 0;      ///< of all finite values; 0 if there is none
  double low = 0, high = 0;             ///< the 1st and the 99th percentile of the finite values
  Eigen::Index finite = 0;              ///< number of finite values
};

/// The level of values that are not finite; the greatest level is one less.
constexpr std::uint16_t no_level = 65535;

LevelColumn levelsOf(const Eigen::Ref<const Eigen::VectorXd>& values);

/// A column of labels as a page stores it: `names[index]`.
struct LabelColumn {
  std::vector<double> names;           ///< the different finite values, ascending
  std::vector<std::uint32_t> indices;  ///< index of each row into `names`; the size of `names` if not finite
};

LabelColumn labelsOf(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Encodes a direction in two bytes by the octahedral map (Meyer et al. 2010, "On floating-point normal vectors"): each
/// byte is 128 plus a multiple of 1/127; 0, 0 if the vector has no direction.
void octahedralBytes(const Eigen::Vector3d& direction, std::uint8_t bytes[2]);

}  // namespace tufted::view
