#include <string>

#include "base/cover_source.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

void checkSizes(const std::string& function, const Laplacian& laplacian) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto expect = [&](const char* member, Eigen::Index size, bool may_be_empty) {
    if (size == n || (may_be_empty && size == 0)) return;
    throw InvalidInput(function + ": " + member + " " + std::to_string(size) + ", must be " + std::to_string(n) +
                       ", the number of points in status");
  };
  expect("rows of L =", laplacian.L.rows(), false);
  expect("columns of L =", laplacian.L.cols(), false);
  expect("size of M =", laplacian.M.size(), false);
  expect("size of representative =", std::ssize(laplacian.representative), false);
  expect("size of boundary =", std::ssize(laplacian.boundary), false);
  expect("size of component =", std::ssize(laplacian.component), true);
  expect("size of cover_areas =", laplacian.cover_areas.size(), true);
  expect("rows of frames.normals =", laplacian.frames.normals.rows(), true);
  expect("rows of frames.tangents =", laplacian.frames.tangents.rows(), true);
  expect("rows of positions =", laplacian.positions.rows(), true);
  expect("size of noise =", laplacian.noise.size(), true);
  if (const auto* stored = laplacian.hasCover() ? laplacian.cover_source->stored() : nullptr; stored != nullptr)
    expect("vertices of the cover =", stored->vertices, false);
  const auto& representative = laplacian.representative;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int found = representative[i];
    if (found >= 0 && found < n && representative[found] == found) continue;
    throw InvalidInput(function + ": representative of point " + std::to_string(i) + " = " + std::to_string(found) +
                       ", must lie in [0, " + std::to_string(n) + ") and be its own representative");
  }
}

}  // namespace tufted
