#pragma once

#include <Eigen/Core>

#include "tufted/io/read.h"

/// The values of a field of `points` points, a row for each; of a packed colour its red, green and blue.
Eigen::MatrixXd valuesOf(const tufted::Field& field, Eigen::Index points);
