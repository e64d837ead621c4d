#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <optional>
#include <vector>

#include "bench/tables.h"

namespace tufted::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

/// Processor time in seconds, of all threads; CGAL uses one.
template <class Work>
double processorTime(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void printHeat(const Mesh& mesh, Vertex top, Vertex low) {
  Mesh copy = mesh;
  const auto distance = copy.add_property_map<Vertex, double>("v:distance", 0).first;
  std::optional<CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh>> heat;
  const auto query = [&](Vertex from) {
    heat->clear_sources();
    heat->add_source(from);
    heat->estimate_geodesic_distances(distance);
  };
  const double first = processorTime([&] {
    heat.emplace(copy);
    query(top);
  });
  std::printf("| distances by heat, `Heat_method_3` | %.2f | %.3f |\n", first, processorTime([&] { query(low); }));
}

void printExact(const Mesh& mesh, Vertex top, Vertex low) {
  using ShortestPath = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
  ShortestPath search(mesh);
  std::vector<Kernel::Point_3> path;
  const double first = processorTime([&] {
    search.add_source_point(top);
    search.build_sequence_tree();
  });
  const double next =
      processorTime([&] { search.shortest_path_points_to_source_points(low, std::back_inserter(path)); });
  std::printf("| exact paths, `Surface_mesh_shortest_path` | %.2f | %.3f |\n", first, next);
}

void printFlow(const Mesh& mesh) {
  Mesh moved = mesh;
  const double seconds = processorTime(
      [&] { CGAL::Polygon_mesh_processing::smooth_shape(moved, 0.01, CGAL::parameters::number_of_iterations(10)); });
  std::printf("| mean curvature flow, ten steps, `smooth_shape` | %.2f | |\n", seconds);
}

}  // namespace

void printPeers() {
  const std::filesystem::path file = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real/shapes/nefertiti.obj";
  Mesh mesh;
  if (!std::filesystem::exists(file) || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(file.string(), mesh))
    return;
  std::printf("| CGAL on nefertiti.obj, processor s | first call | further call |\n|---|---|---|\n");
  const auto [low, top] = std::minmax_element(mesh.vertices_begin(), mesh.vertices_end(), [&](Vertex a, Vertex b) {
    return mesh.point(a).y() < mesh.point(b).y();
  });
  printHeat(mesh, *top, *low);
  printExact(mesh, *top, *low);
  printFlow(mesh);
}

}  // namespace tufted::bench
