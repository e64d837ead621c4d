#pragma once

namespace tufted {

/// A sparse matrix that is moved by swapping memory. In Eigen 3.4 a move copies, and assigning an empty matrix does not
/// free the old memory. The source of a move keeps what the target held.
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
