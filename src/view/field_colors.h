#pragma once

#include <array>
#include <vector>

#include "tufted/view/picture.h"
#include "view/color_maps.h"

namespace tufted::view {

/// How the values of a field become colours.
struct FieldColors {
  const SceneField* field = nullptr;  ///< the field shown; null: none, everything is grey
  int column = 0;                     ///< column of the field
  const ColorMap* map = nullptr;      ///< null for FieldKind::color and direction
  double low = 0, high = 1;           ///< values at the ends of the map
  bool is_logarithmic = false;        ///< whether values are shown as their logarithms to base 10
  bool lacks_values = false;          ///< whether some points have no value
  bool has_none = false;              ///< whether some labels are negative
  double step = 0;                    ///< difference of neighbouring isolines; 0: no isolines
  std::vector<int> sources = {};      ///< points from which distances are measured, to be marked
  /// One channel, or two for coordinates, of N values each, as shares: 0 at `low`, 1 at `high`, NaN without a value.
  /// Floats are blended, and shares need few digits whatever the values.
  std::vector<std::vector<float>> channels;

  /// The share of a value.
  float shareOf(double value) const;
  /// `step` as a share; 0: no isolines.
  double shareOfStep() const;
  /// The number of the isoline at or below a share, counted from one near `low`.
  double levelOf(float share) const;
  /// The colour for the shares of all channels.
  Rgb colorOf(const std::array<float, 2>& shares) const;
  /// The colour of a point whose values cannot be blended: labels, colours and directions.
  Rgb colorOfPoint(int point) const;
  bool isBlended() const { return field != nullptr && !channels.empty(); }
};

/// Chooses colours by the options.
/// @throws InvalidInput for a field, column or map that does not exist, or a range that does not ascend
FieldColors colorsOf(const Scene& scene, const PictureOptions& options);

}  // namespace tufted::view
