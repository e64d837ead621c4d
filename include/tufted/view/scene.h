#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
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
  label,        ///< integers that name things: a colour for each, negative ones light grey
  vector,       ///< three columns, vectors in space: arrows, coloured by their length
  coordinates,  ///< two columns, coordinates on the surface, as of a logarithmic map: a grid of lines
  color,        ///< three columns, red, green and blue from 0 to 255
  direction,    ///< three columns, unit vectors: a colour for each direction, red, green and blue along x, y and z
};

/// Whether all columns of a field of this kind are drawn as one picture; otherwise each column is a picture.
inline bool showsAllColumns(FieldKind kind) {
  return kind == FieldKind::vector || kind == FieldKind::coordinates || kind == FieldKind::color ||
         kind == FieldKind::direction;
}

/// Values at the points of a scene, to be shown.
struct SceneField {
  std::string name;                    ///< any text
  FieldKind kind = FieldKind::scalar;  ///< meaning of the values
  /// N x c, c >= 1; each column is a picture, except for the kinds of two or three columns. NaN and infinite values are
  /// grey.
  Eigen::MatrixXd values;
  std::string unit = {};                      ///< unit of the values, for the legend; may be empty
  std::vector<std::string> label_names = {};  ///< names of labels 0, 1, ... in the legend; others show their number
  /// What grey means, for the legend; empty: "no value". Of labels it is what negative ones mean, which are lighter.
  std::string no_value = {};
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

/// The camera of a picture or a page, by default in perspective: the height of a picture covers an angle of 0.62
/// radians. What is not given is chosen: flat scenes are seen from above at an angle, or from the front if they stand
/// upright, all others from their broad side; the distance is such that the scene fits, ignoring the few points far
/// from all others.
struct Camera {
  /// Direction from the scene to the eye, of any length; 0: chosen.
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  /// Direction that is up in the picture, of any length; 0: chosen.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  /// Angle of the eye around `up` in degrees, instead of `eye`; 0 is the axis that follows up: x if z is up, z if y is
  /// up.
  std::optional<double> azimuth = {};
  /// Angle of the eye above the plane perpendicular to `up` in degrees, from -90 to 90, instead of `eye`.
  std::optional<double> elevation = {};
  double zoom = 1;  ///< positive factor; 2: the eye is at half the distance
  /// Position of the eye, instead of `eye` and `zoom`.
  std::optional<Eigen::Vector3d> viewpoint = {};
  /// Position in the middle of the picture; empty: the middle of the scene.
  std::optional<Eigen::Vector3d> look_at = {};
  /// Whether to draw in parallel projection, as a plan does, at a scale at which the scene fits; `viewpoint` then gives
  /// the direction only. Pages approach it by a lens of one degree.
  bool is_parallel = false;
};

/// The names of the colour maps that pages and pictures accept: viridis, cividis and magma are sequential, coolwarm and
/// purple_green diverging, and labels has a colour for each of many integers.
std::vector<std::string> colorMapNames();

/// The name of the default colour map of a kind; empty for FieldKind::color and direction, which need none.
std::string defaultColorMap(FieldKind kind);

}  // namespace tufted
