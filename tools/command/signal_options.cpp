#include "signal_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <system_error>

#include "options.h"
#include "scene_fields.h"
#include "tufted/errors.h"

namespace {

using Eigen::MatrixXd;
using tufted::Field;

/// The names that --field accepts: the fields, then what readers move out of them, such as x, y, z.
std::vector<std::string> namesOf(const tufted::Geometry& geometry) {
  std::vector<std::string> names;
  for (const Field& field : geometry.fields) names.push_back(field.name);
  names.insert(names.end(), {"x", "y", "z"});
  if (geometry.normals.rows() > 0) names.insert(names.end(), {"nx", "ny", "nz"});
  return names;
}

/// A field, or the fields NAME_0, NAME_1, ... as which PLY stores a field of several values.
std::vector<MatrixXd> columnsOf(const std::string& name, const tufted::Geometry& geometry) {
  const Eigen::Index n = geometry.points.rows();
  const std::vector<std::string> names = namesOf(geometry);
  const std::size_t fields = geometry.fields.size();
  if (const auto at = static_cast<std::size_t>(tufted::findField(names, name)); at < names.size()) {
    if (at < fields) return {valuesOf(geometry.fields[at], n)};
    const auto axis = static_cast<Eigen::Index>(at - fields);
    return {axis < 3 ? geometry.points.col(axis) : geometry.normals.col(axis - 3)};
  }
  const auto find = [&](const std::string& sought) -> const Field* {
    const std::ptrdiff_t at = std::find(names.begin(), names.end(), sought) - names.begin();
    return at < std::ssize(geometry.fields) ? &geometry.fields[static_cast<std::size_t>(at)] : nullptr;
  };
  std::vector<MatrixXd> columns;
  while (const Field* const field = find(name + "_" + std::to_string(columns.size())))
    columns.push_back(valuesOf(*field, n));
  return columns;
}

}  // namespace

void addSignalOptions(CLI::App& command, SignalOptions& options, const std::string& what) {
  const auto any = [](const std::string&) { return std::string(); };  // the file is not read yet
  const auto set = [&options](const std::vector<std::string>& names) { options.fields = names; };
  addList(command, "--field", what + ": fields of the file, separated by commas", any, set)->type_name("NAME,...");
  addText(command, "--values NPY", options.values, what + ": .npy file of N values, or N x c for c columns");
}

MatrixXd readSignals(const SignalOptions& options, const Operator& source) {
  if (options.fields.empty() == options.values.empty())
    throw tufted::InvalidInput("exactly one of --field and --values must be given");
  const Eigen::Index n = source.points();
  if (!options.values.empty()) {
    MatrixXd values = tufted::readArray(options.values);
    if (values.rows() != n || values.cols() == 0)
      throw tufted::IoError(options.values.string() + ": has " + std::to_string(values.rows()) + " rows of " +
                            std::to_string(values.cols()) + " values, must have " + std::to_string(n) +
                            ", one per point");
    return values;
  }
  MatrixXd signals(n, 0);
  for (const std::string& name : options.fields) {
    const std::vector<MatrixXd> columns = columnsOf(name, source.geometry);
    if (columns.empty())
      throw tufted::InvalidInput("--field " + name + ": " + source.name + " has no such field" +
                                 didYouMean(name, namesOf(source.geometry)));
    for (const MatrixXd& column : columns) {
      signals.conservativeResize(Eigen::NoChange, signals.cols() + column.cols());
      signals.rightCols(column.cols()) = column;
    }
  }
  return signals;
}

void requireFinite(const MatrixXd& signals, const Operator& source) {
  for (Eigen::Index i = 0; i < signals.rows(); ++i)
    if (source.laplacian.status[i] == tufted::PointStatus::active && !signals.row(i).allFinite())
      throw tufted::IoError(source.name + ": " + source.chosen.inFile("the values of point " + std::to_string(i)) +
                            " are not finite, must be at points that take part");
}
