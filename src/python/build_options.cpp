#include "python/build_options.h"

#include <string>

#include "python/arrays.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

FaceOrder orderOf(const char* argument, const py::dict& given) {
  return chosen<FaceOrder>(argument, given["order"].cast<std::string>(),
                           {{"angle", FaceOrder::angle}, {"area", FaceOrder::area}, {"random", FaceOrder::random}});
}

/// Sets the options that clouds and meshes share.
template <class Options>
void takeCommon(const py::dict& given, Options& options) {
  options.paper.seed = given["seed"].cast<std::uint64_t>();
  options.mollify = given["mollify"].cast<double>();
  options.threads = given["threads"].cast<int>();
}

}  // namespace

CloudOptions cloudOptionsOf(const py::dict& given) {
  const auto name = [&](const char* option) { return given[option].cast<std::string>(); };
  CloudOptions options =
      cloudOptions(chosen<Preset>("PointCloud: preset", name("preset"),
                                  {{"clean", Preset::clean}, {"scan", Preset::scan}, {"lidar", Preset::lidar}}));
  options.neighbors = given["neighbors"].cast<int>();
  options.paper.gluing = chosen<Gluing>("PointCloud: gluing", name("gluing"),
                                        {{"star", Gluing::star}, {"vertex-pair", Gluing::vertex_pair}});
  options.paper.order = orderOf("PointCloud: order", given);
  options.paper.delaunay =
      chosen<Delaunay>("PointCloud: delaunay", name("delaunay"), {{"star", Delaunay::star}, {"cgal", Delaunay::cgal}});
  takeCommon(given, options);
  return options;
}

MeshOptions meshOptionsOf(const py::dict& given) {
  MeshOptions options;
  options.paper.order = orderOf("Mesh: order", given);
  takeCommon(given, options);
  options.weld = given["weld"].cast<bool>();
  return options;
}

std::optional<Eigen::Vector3d> viewpointOf(const py::dict& given) {
  return given["viewpoint"].cast<std::optional<Eigen::Vector3d>>();
}

}  // namespace tufted::python
