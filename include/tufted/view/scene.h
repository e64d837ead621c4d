#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// What the values of a field mean, and so how they are drawn.
enum class FieldKind : std::uint8_t {
  scalar,       ///< from the least to the greatest value: a sequential colour map
  positive,     ///< positive values that differ by factors, as areas of a scan: the same, on a logarithmic scale
  diverging,    ///< values around 0, which has the middle colour: eigenvectors, mean curvature
  distance,     ///< a length from 0 on: a sequential colour map with isolines
  label,        ///< integers that name things: a colour for each, negative ones grey
  vector,       ///< three columns, vectors in space: arrows, coloured by their length
  coordinates,  ///< two columns, coordinates on the surface, as of a logarithmic map: a grid of lines
  color,        ///< three columns, red, green and blue from 0 to 255
};

/// Whether all columns of a field of this kind are one picture; otherwise each is one.
inline bool showsAllColumns(FieldKind kind) {
  return kind == FieldKind::vector || kind == FieldKind::coordinates || kind == FieldKind::color;
}

/// Values at the points that can be looked at.
struct SceneField {
  std::string name;                    ///< any text
  FieldKind kind = FieldKind::scalar;  ///< what the values mean
  /// N x c; each column is a picture of its own but for the kinds of two or three columns. NaN and infinite values are
  /// grey.
  Eigen::MatrixXd values;
  std::string unit = {};                       ///< of the values, for the legend; may be empty
  std::vector<std::string> label_names = {};   ///< of labels 0, 1, ... in the legend; labels beyond have their number
  std::string no_value = {};                   ///< what grey means, for the legend; empty: "no value"
  std::vector<std::string> column_names = {};  ///< of the columns, for the legend; empty: the name and a number
};

/// Points with what is known at them, for a page or a picture.
struct Scene {
  std::string title;         ///< any text
  Points positions;          ///< N x 3, in the caller's order; rows that are not finite are not drawn
  Triangles triangles = {};  ///< F x 3; 0 x 3: points alone
  Points normals = {};       ///< N x 3, of any length and either sign, for light; 0 x 3 where nobody knows them
  std::vector<SceneField> fields = {};  ///< what can be shown, the first one first
  std::string unit = {};                ///< of the positions, "m"; may be empty
  Points path = {};  ///< K x 3: the corners of one line on the surface, from its beginning to its end; 0 x 3: none
};

/// Checks that the parts of a scene fit together.
/// @param function what the caller called, for the message
/// @throws InvalidInput for rows that are not N, a number of columns that the kind does not allow, a corner of a
///         triangle that is no point
void checkScene(const Scene& scene, const char* function);

}  // namespace tufted
