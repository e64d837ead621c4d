// Writes Laplacians in all formats into the directory given, for load_in_scipy.py.
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "sample_laplacian.h"
#include "tufted/io/write.h"

namespace {

using tufted::Format;

/// Random points in a thin slab, far away. The last one is missing and the one before it is there twice.
tufted::Geometry cloud() {
  constexpr int points = 300;
  std::mt19937_64 generator(1);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  tufted::Geometry geometry;
  geometry.points.resize(points, 3);
  for (int i = 0; i < points; ++i) {
    const double x = uniform(), y = uniform(), z = 0.01 * uniform();
    geometry.points.row(i) << 500000 + x, 5400000 + y, z;
  }
  geometry.points.row(points - 2) = geometry.points.row(0);
  geometry.points.row(points - 1).setConstant(std::numeric_limits<double>::quiet_NaN());
  return geometry;
}

template <class T>
void dump(const std::filesystem::path& path, const T* values, std::size_t count) {
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path dir = argv[1];
  const std::vector<Format> all = {Format::npz,   Format::mtx, Format::mat, Format::spmat,
                                   Format::petsc, Format::ply, Format::pcd};
  tufted::writeLaplacian(dir / "triangle", sampleLaplacian(), sampleGeometry(), {.formats = all});
  const tufted::Geometry geometry = cloud();
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(geometry.points);
  tufted::writeLaplacian(dir / "cloud", laplacian, geometry, {.formats = all});
  tufted::writeLaplacian(dir / "changed", laplacian, geometry,
                         {.formats = all, .sign = tufted::Sign::igl, .dummy = true});
  // The arrays as they lie in memory, to compare with.
  dump(dir / "indptr", laplacian.L.outerIndexPtr(), laplacian.L.cols() + 1);
  dump(dir / "indices", laplacian.L.innerIndexPtr(), laplacian.L.nonZeros());
  dump(dir / "data", laplacian.L.valuePtr(), laplacian.L.nonZeros());
  dump(dir / "M", laplacian.M.data(), laplacian.M.size());
}
