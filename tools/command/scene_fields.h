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

// What pages and pictures show of files and results.

inline bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a result of this name is a field: of one value or vector for each point.
bool isShown(const std::string& name);

/// What the values of a result of a command mean, by its name.
tufted::FieldKind kindOfResult(const std::string& name, Eigen::Index columns);

/// What the columns of a result of a command are called; empty: they have numbers.
std::vector<std::string> columnNamesOf(const std::string& name, Eigen::Index columns);

/// The field of kinds of boundary, which are those of tufted::Boundary as numbers.
tufted::SceneField boundaryField(Eigen::MatrixXd values);

/// The fields of a file, with its colours as one field `color`.
std::vector<tufted::SceneField> fieldsOf(const tufted::Geometry& geometry);

/// The scene of results: arrays per point first, then mass, boundary and components of the Laplacian, then the fields
/// of the file. Points that take no part have no value. An array `path` is drawn as a line.
tufted::Scene sceneOf(const std::string& title, const tufted::Geometry& geometry, const tufted::Laplacian& laplacian,
                      const std::vector<tufted::ResultArray>& arrays);
