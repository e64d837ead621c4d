#include <tufted/errors.h>
#include <tufted/io/read.h>
#include <tufted/io/write.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace {

/// A cloud as from a scanner: two surfaces, and a point that it missed.
tufted::Geometry scan() {
  tufted::Geometry cloud;
  cloud.points.resize(501, 3);
  for (int i = 0; i < 400; ++i) cloud.points.row(i) << i % 20, i / 20, 0;
  for (int i = 0; i < 100; ++i) cloud.points.row(400 + i) << i % 10, i / 10, 1000;
  cloud.points.row(500).setConstant(std::nan(""));
  cloud.width = 501;
  return cloud;
}

}  // namespace

// Writes a Laplacian into the directory it is given and reads the points back.
int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const std::filesystem::path dir = argv[1];
  const tufted::Geometry cloud = scan();
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(cloud.points);
  tufted::writeLaplacian(dir, laplacian, cloud, {.source = "scan"});

  for (const char* name : {"L.npz", "M.npy", "status.npy", "representative.npy", "boundary.npy",
                           "measured_positions.npy", "components.npy", "report.json"})
    if (!std::filesystem::exists(dir / name)) {
      std::fprintf(stderr, "%s is missing\n", name);
      return 1;
    }
  const tufted::Geometry again = tufted::read(dir / "points.ply");
  const bool same = again.points.rows() == 501 && again.points.topRows(500) == cloud.points.topRows(500);
  if (!same || std::abs(laplacian.M.sum() - (361 + 81)) > 0.5) {
    std::fprintf(stderr, "%d points read, sum(M) %.17g\n", static_cast<int>(again.points.rows()), laplacian.M.sum());
    return 1;
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
