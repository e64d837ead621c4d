#pragma once

#include "simd/kernels.h"
#include "simd/packet.h"

namespace tufted {
namespace {

/// Least squares fit over {1, i, j, i j, i^2 - m, j^2 - m}, which are orthogonal on the square; i and j are steps of
/// rows and columns, m is the mean of i^2.
template <int Reach>
TUFTED_INLINE void fitSquare(const PixelRows& rows, int part, SquareFits& fits) {
  const int side = 2 * Reach + 1, pixels = side * side;
  const double mean_square = Reach * (Reach + 1) / 3.0;  // mean of i^2
  const double square = pixels * mean_square;            // sum of i^2
  const double fourth = pixels * mean_square * (3.0 * Reach * (Reach + 1) - 1) / 5;
  const double bowl = fourth - pixels * mean_square * mean_square;  // sum of (i^2 - m)^2
  const double saddle = square * square / pixels;                   // sum of (i j)^2

  const Part zero = broadcastPart(0), middle = loadPart(rows.at + part);
  Part all = zero, i = zero, j = zero, ij = zero, ii = zero, jj = zero, squares = zero;
  for (int row = -Reach; row <= Reach; ++row) {
    Part sum = zero, first = zero, second = zero;
    for (int column = -Reach; column <= Reach; ++column) {
      const Part w = loadPart(rows.at + part + row * rows.row_step + column * rows.column_step) - middle;
      sum = sum + w;
      first = first + broadcastPart(column) * w;
      second = second + broadcastPart(column * column - mean_square) * w;
      squares = squares + w * w;
    }
    all = all + sum;
    i = i + broadcastPart(row) * sum;
    ii = ii + broadcastPart(row * row - mean_square) * sum;
    j = j + first;
    ij = ij + broadcastPart(row) * first;
    jj = jj + second;
  }
  const Part explained = all * all * broadcastPart(1.0 / pixels) + (i * i + j * j) * broadcastPart(1 / square) +
                         ij * ij * broadcastPart(1 / saddle) + (ii * ii + jj * jj) * broadcastPart(1 / bowl);
  store(middle + all * broadcastPart(1.0 / pixels) - (ii + jj) * broadcastPart(mean_square / bowl), fits.value + part);
  store(max(zero, squares - explained) * broadcastPart(1.0 / (pixels - 6)), fits.variance + part);
}

template <int Reach>
void fitSquares(const PixelRows& rows, SquareFits& fits) {
  for (int part = 0; part < packet_size; part += part_size) fitSquare<Reach>(rows, part, fits);
}

}  // namespace
}  // namespace tufted
