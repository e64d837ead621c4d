#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// Meaning of the values of a field, which decides how they are drawn.
enum class FieldKind : std::uint8_t {
  scalar,       ///< any values: a sequential colour map from the least to the greatest
  positive,     ///< positive values that differ by factors, as areas of a scan: the same, on a logarithmic scale
  diverging,    ///< values around 0, which has the middle colour: eigenvectors, mean curvature
  distance,     ///< lengths >= 0: a sequential colour map from 0, with isolines
  label,        ///< integers that name things: a colour for each, negative ones grey
  vector,       ///< three columns, vectors in space: arrows, coloured by their length
  coordinates,  ///< two columns, coordinates on the surface, as of a logarithmic map: a grid of lines
  color,        ///< three columns, red, green and blue from 0 to 255
};

/// Whether all columns of a field of this kind are drawn as one picture; otherwise each column is a picture.
inline bool showsAllColumns(FieldKind kind) {
  return kind == FieldKind::vector || kind == FieldKind::coordinates || kind == FieldKind::color;
}

/// Values at the points of a scene, to be shown.
struct SceneField {
  std::string name;                    ///< any text
  FieldKind kind = FieldKind::scalar;  ///< meaning of the values
  /// N x c, c >= 1; each column is a picture, except for the kinds of two or three columns. NaN and infinite values are
  /// grey.
  Eigen::MatrixXd values;
  std::string unit = {};                       ///< unit of the values, for the legend; may be empty
  std::vector<std::string> label_names = {};   ///< names of labels 0, 1, ... in the legend; others show their number
  std::string no_value = {};                   ///< what grey means, for the legend; empty: "no value"
  std::vector<std::string> column_names = {};  ///< names of the columns, for the legend; empty: `name` and a number
};

/// Points, triangles and fields to be shown on a page or in a picture.
struct Scene {
  std::string title;                    ///< any text
  Points positions;                     ///< N x 3, in the caller's order; rows that are not finite are not drawn
  Triangles triangles = {};             ///< F x 3 indices of points; 0 x 3: points only
  Points normals = {};                  ///< N x 3, any length and either sign, for shading; 0 x 3 if unknown
  std::vector<SceneField> fields = {};  ///< what can be shown, the first one first
  std::string unit = {};                ///< unit of the positions, "m"; may be empty
  Points path = {};  ///< K x 3 corners of one line on the surface, from its beginning to its end; 0 x 3: none
};

/// Checks that the parts of a scene fit together.
/// @param function name of the caller, for the message
/// @throws InvalidInput for a number of rows other than N, a number of columns that the kind does not allow, or a
/// corner of a triangle that is no point
void checkScene(const Scene& scene, const char* function);

}  // namespace tufted
