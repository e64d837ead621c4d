#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"
#include "tufted/view/scene.h"

// Scenes of files and results for pages and pictures.

inline bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a result of this name is a field, with a value or vector for each point.
bool isShown(const std::string& name);

/// The kind of a command's result, by its name.
tufted::FieldKind kindOfResult(const std::string& name, Eigen::Index columns);

/// The names of the columns of a command's result; empty: they are numbered.
std::vector<std::string> columnNamesOf(const std::string& name, Eigen::Index columns);

/// A field of the points' places: one of the coordinates x, y, z, -x, -y and -z, or `normal`, the directions of the
/// normals. Without a name if there is none.
tufted::SceneField placeField(const std::string& name, const tufted::Scene& scene);

/// A field that shows values of tufted::Boundary.
tufted::SceneField boundaryField(Eigen::MatrixXd values);

/// The fields of a file; its colours become one field `color`.
std::vector<tufted::SceneField> fieldsOf(const tufted::Geometry& geometry);

/// The scene of results. Its fields are the arrays per point, then mass, boundary and component of the Laplacian, then
/// the fields of the file. Points that take no part have no value. An array `path` is drawn as a line.
tufted::Scene sceneOf(const std::string& title, const tufted::Geometry& geometry, const tufted::Laplacian& laplacian,
                      const std::vector<tufted::ResultArray>& arrays);

/// The values of a field of `points` points, a row for each; of a packed colour its red, green and blue.
Eigen::MatrixXd valuesOf(const tufted::Field& field, Eigen::Index points);
