#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "numbers.h"
#include "operator.h"
#include "tufted/distance.h"

/// Parses X,Y,Z. @throws InvalidInput naming the option unless these are three finite numbers
Eigen::Vector3d parsePosition(const std::string& text, const std::string& option);

/// A point that the user names: by index, or as the nearest to a position.
struct Place {
  int index = -1;                                      ///< row in the results; -1: named by position
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< finite
  std::string name;                                    ///< name of the option or line that gives it, for messages
};

/// The point that numbers name.
/// @param numbers an index, or x, y, z
/// @param source whose points are named; an index counts the points of FILE, also if only some were chosen
/// @param name option or line that gives them, for messages
/// @throws InvalidInput unless they are the index of a point that was chosen or a finite position
Place placeOf(const std::vector<double>& numbers, const Operator& source, const std::string& name);

/// The index of a point in a line of a file.
/// @throws IoError for a line of several numbers, InvalidInput as placeOf()
int indexOf(const Row& row, const Operator& source);

/// Finds the points that the user names. Notes in `results` which points are nearest to positions and how far away, and
/// warns of those that are farther away than their farthest neighbour.
/// @throws InvalidInput for a position if the source has no points
std::vector<int> locate(const std::vector<Place>& places, const Operator& source, Results& results);

/// Values of the options that name points.
struct NamedPoints {
  std::vector<std::string> indices;  ///< lists separated by commas
  std::vector<std::string> positions;
  std::filesystem::path file;

  /// Parses all of them, those by index first. @throws as placeOf() and readRows()
  std::vector<Place> places(const Operator& source) const;
};

/// @throws InvalidInput naming an option or line that gives a triangle, unless the source is a mesh
void requireMesh(const std::string& name, const Operator& source);

/// A point inside a triangle of a mesh.
/// @param numbers FACE, A, B, C
/// @param name option or line that gives them, for messages
/// @throws InvalidInput for other numbers
tufted::SurfacePoint pointInFace(const std::vector<double>& numbers, const std::string& name, const Operator& source);

/// The points that --face names.
/// @throws InvalidInput for a cloud, or for what is not FACE,A,B,C with a triangle and barycentric coordinates
std::vector<tufted::SurfacePoint> pointsInFaces(const std::vector<std::string>& faces, const Operator& source);

/// Adds --face FACE,A,B,C, which may be repeated.
void addFaceOption(CLI::App& command, std::vector<std::string>& faces, const std::string& what);

/// Adds --source I,J,... and --near X,Y,Z, which may be repeated, and --sources TEXT.
void addPointOptions(CLI::App& command, NamedPoints& points, const std::string& what);

/// Notes in the results which of the named points take no part, and why: a warning, a line of the summary, and
/// `left_out` in the report.
/// @param others whether the user also named something else that may take part
/// @throws InvalidInput if none of the points takes part and there are no others
void noteLeftOut(const std::vector<int>& points, const Operator& source, Results& results, bool others = false);

/// @throws InvalidInput for a point that takes no part, naming it and why
void requireTakingPart(const std::vector<int>& points, const Operator& source);
