#pragma once

namespace tufted {

/// A sparse matrix that is moved by exchanging its memory. Eigen 3.4 copies one instead, and keeps the memory of one
/// that an empty one is assigned to.
template <class Matrix>
class Movable : public Matrix {
 public:
  Movable() = default;
  Movable(Movable&& other) { this->swap(other); }
  Movable& operator=(Movable&& other) { return *this = static_cast<Matrix&&>(other); }
  Movable& operator=(Matrix&& other) {
    this->swap(other);
    return *this;
  }
  Movable& operator=(const Matrix& other) {
    Matrix::operator=(other);
    return *this;
  }
};

}  // namespace tufted
