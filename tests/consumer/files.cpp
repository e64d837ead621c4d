#include <tufted/errors.h>
#include <tufted/io/read.h>
#include <tufted/io/write.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

// Writes a Laplacian into the directory it is given and reads the points back.
int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const std::filesystem::path dir = argv[1];
  tufted::Geometry grid;
  grid.points.resize(400, 3);
  for (int i = 0; i < 400; ++i) grid.points.row(i) << i % 20, i / 20, 0;
  grid.width = 400;
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(grid.points);
  tufted::writeLaplacian(dir, laplacian, grid, {.source = "grid"});

  for (const char* name : {"L.npz", "M.npy", "status.npy", "representative.npy", "boundary.npy", "report.json"})
    if (!std::filesystem::exists(dir / name)) {
      std::fprintf(stderr, "%s is missing\n", name);
      return 1;
    }
  const tufted::Geometry again = tufted::read(dir / "points.ply");
  if (again.points != grid.points || std::abs(laplacian.M.sum() - 361) > 0.5) {
    std::fprintf(stderr, "%d points read, sum(M) %.17g\n", static_cast<int>(again.points.rows()), laplacian.M.sum());
    return 1;
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
