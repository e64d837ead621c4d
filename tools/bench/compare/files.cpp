// Guarantees on all meshes of a folder (Section 5.2 of the paper).
#include "base/stage_clock.h"
#include "bench/compare/tables.h"
#include "tufted/check.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted::bench {

Table printDataset(const Settings& settings) {
  struct Way {
    std::string name;
    double mollify;
    int ok = 0;
    double seconds = 0;
  };
  std::vector<Way> ways = {{"without mollification", 0}, {"mollified", default_mollify}};
  int files = 0, nonmanifold = 0;
  double triangles = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(settings.meshes)) {
    if (!entry.is_regular_file()) continue;
    Geometry geometry;
    try {
      geometry = read(entry.path(), ReadAs::mesh);
    } catch (const IoError&) {
      continue;  // no mesh
    }
    if (geometry.triangles.rows() == 0) continue;
    ++files;
    triangles += static_cast<double>(geometry.triangles.rows());
    const oracles::Topology topology = oracles::topology(geometry.triangles);
    nonmanifold += topology.nonmanifold_edges + topology.nonmanifold_vertices > 0 ? 1 : 0;
    for (Way& way : ways) {
      const Stopwatch watch;
      const Laplacian laplacian =
          meshLaplacian(geometry.points, geometry.triangles, {.mollify = way.mollify, .threads = 1});
      way.seconds += watch.seconds();
      const LaplacianCheck check = validate(laplacian);
      if (check.ok())
        ++way.ok;
      else
        std::fprintf(stderr, "%s, %s: %s\n", entry.path().filename().c_str(), way.name.c_str(),
                     check.faults[0].c_str());
    }
  }
  Table table({"", "meshes", "not manifold", "triangles", "all guarantees hold on", "share", "build, s"});
  for (const Way& way : ways) {
    table.row({way.name, files, nonmanifold, Cell("%.0f", triangles), way.ok,
               percent(static_cast<double>(way.ok) / std::max(files, 1), "%.2f %%"), Cell("%.1f", way.seconds)});
  }
  return table;
}

}  // namespace tufted::bench
