#pragma once

#include "base/buffer.h"
#include "tufted/types.h"

namespace tufted {

/// An n x 3 array like Points, stored in a Buffer, which keeps its capacity when n changes.
class PointBuffer {
 public:
  PointBuffer() = default;
  explicit PointBuffer(Eigen::Index rows) { resize(rows); }

  /// Leaves new rows uninitialised.
  void resize(Eigen::Index rows) { rows_.resize(static_cast<std::size_t>(rows)); }
  void setZero(Eigen::Index rows) {
    resize(rows);
    all().setZero();
  }

  Eigen::Index rows() const { return std::ssize(rows_); }
  std::size_t bytes() const { return rows_.capacity() * sizeof(Row); }
  const double* data() const { return reinterpret_cast<const double*>(rows_.data()); }
  double* data() { return reinterpret_cast<double*>(rows_.data()); }

  Eigen::Map<Points> all() { return {data(), rows(), 3}; }
  Eigen::Map<const Points> all() const { return {data(), rows(), 3}; }
  Eigen::Map<Eigen::RowVector3d> row(Eigen::Index i) { return Eigen::Map<Eigen::RowVector3d>(data() + 3 * i); }
  Eigen::Map<const Eigen::RowVector3d> row(Eigen::Index i) const {
    return Eigen::Map<const Eigen::RowVector3d>(data() + 3 * i);
  }

 private:
  struct Row {
    Row() {}  // NOLINT: leaves the coordinates uninitialised
    double coordinate[3];
  };
  Buffer<Row> rows_;
};

/// A borrowed n x 3 view of a Points or a PointBuffer.
class PointsView : public Eigen::Map<const Points> {
 public:
  PointsView(const Points& points) : Map(points.data(), points.rows(), 3) {}       // NOLINT: a view of both
  PointsView(const PointBuffer& points) : Map(points.data(), points.rows(), 3) {}  // NOLINT
};

}  // namespace tufted
