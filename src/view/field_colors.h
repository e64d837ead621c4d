#pragma once

#include <array>
#include <vector>

#include "tufted/view/picture.h"
#include "view/color_maps.h"

namespace tufted::view {

/// How the values of a field become colours.
struct FieldColors {
  const SceneField* field = nullptr;  ///< null: none, all is grey
  int column = 0;                     ///< of the field
  const ColorMap* map = nullptr;      ///< null for colours
  double low = 0, high = 1;           ///< the values at the ends of the map
  bool is_logarithmic = false;        ///< whether values are shown as their logarithms to base 10
  bool lacks_values = false;          ///< whether some are not finite
  double step = 0;                    ///< from isoline to isoline; 0: there are none
  /// N for each channel: what is drawn, one number or, for coordinates, two, as shares of the map: 0 at `low` and 1 at
  /// `high`. Floats, which blend, have the digits for these whatever the values. NaN where there is no value.
  std::vector<std::vector<float>> channels;

  /// The share of a value.
  float shareOf(double value) const;
  /// The share from isoline to isoline; 0: there are none.
  double shareOfStep() const;
  /// The number of the isoline below a share, counted from a whole one near `low`.
  double levelOf(float share) const;
  /// The colour of the shares of all channels.
  Rgb colorOf(const std::array<float, 2>& shares) const;
  /// The colour of a point whose values are not blended: labels, colours.
  Rgb colorOfPoint(int point) const;
  bool isBlended() const { return field != nullptr && !channels.empty(); }
};

/// @throws InvalidInput for a field or column that there is not, a map or a range that does not fit
FieldColors colorsOf(const Scene& scene, const PictureOptions& options);

}  // namespace tufted::view
