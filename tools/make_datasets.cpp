// Writes the sample clouds and meshes of datasets/ and their truth. Everything comes from tests/shapes, so that a
// sample and a fixture of the same name are the same shape.

#include <bit>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "shapes/shapes.h"

namespace {

namespace shapes = tufted::shapes;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using shapes::Cloud;
using shapes::Mesh;
using shapes::Quality;
using shapes::Rim;
using shapes::Sampling;

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");

struct Size {
  int points;       // per cloud
  int mesh_factor;  // parts per edge, relative to the small meshes
  int scan_factor;  // pixels and beams per row, relative to the small scans
  bool as_double;   // 32-bit coordinates keep the checked-in samples small
};
constexpr Size small_size{1000, 1, 1, false};
constexpr Size large_size{100000, 8, 6, true};

struct CloudSample {
  Cloud cloud;
  Json parameters;
};
struct MeshSample {
  Mesh mesh;
  std::string format;
  Json parameters;
};

std::vector<CloudSample> sphereSamples(int n) {
  const Json radius{{"radius", 1}};
  std::vector<CloudSample> samples;
  for (const Sampling sampling :
       {Sampling::uniform, Sampling::jittered, Sampling::lattice, Sampling::nonuniform, Sampling::scanLines(4),
        Sampling::scanLines(10), Sampling::scanLines(20), Sampling::scanLines(40)}) {
    samples.push_back({shapes::sphere(n, sampling), radius});
  }
  for (const double noise : {0.001, 0.005, 0.01}) {
    samples.push_back({shapes::withNoise(shapes::sphere(n), noise), radius});
  }
  return samples;
}

std::vector<CloudSample> cloudSamples(const Size& size) {
  const int n = size.points;
  const Json unit{{"side", 1}}, tube{{"major_radius", 1}, {"minor_radius", 0.4}};
  const Json half{{"radius", 1}, {"height", 2}, {"angle_degrees", 180}};
  const Json prism{{"side", 1}, {"height", 1.5}}, bowl{{"z", "(x^2 - y^2)/2"}, {"x_and_y", {-1, 1}}};
  const double spacing = 1.0 / 64;
  std::vector<CloudSample> samples = sphereSamples(n);
  const std::vector<CloudSample> others{
      {shapes::ellipsoid(n), {{"semi_axes", {1.5, 1.25, 1}}, {"coordinates", "multiples of 2^-20"}}},
      {shapes::square(n), unit},
      {shapes::square(n, Sampling::jittered), unit},
      {shapes::square(n, Sampling::uniform, Rim::included), unit},
      {shapes::square(n, Sampling::scanLines(10)), unit},
      {shapes::squareLattice(60, spacing), {{"points_per_side", 60}, {"spacing", spacing}}},
      {shapes::shuffled(shapes::squareLattice(32, spacing)), {{"points_per_side", 32}, {"spacing", spacing}}},
      {shapes::disk(n, Sampling::uniform, Rim::included), {{"radius", 1}}},
      {shapes::torus(n), tube},
      {shapes::torus(n, Sampling::jittered), tube},
      {shapes::torus(n, Sampling::scanLines(10)), tube},
      {shapes::withNoise(shapes::torus(n), 0.01), tube},
      {shapes::cylinderPatch(n), half},
      {shapes::cylinderPatch(n, Sampling::jittered), half},
      {shapes::saddle(n), bowl},
      {shapes::saddle(n, Sampling::jittered, Rim::included), bowl},
      {shapes::twoSheets(n, 0.1), {{"side", 1}, {"distance", 0.1}}},
      {shapes::crossingPlanes(n), unit},
      {shapes::cubeSurface(n), unit},
      {shapes::withNoise(shapes::cubeSurface(n), 0.01), unit},
      {shapes::prismSurface(n), prism},
  };
  samples.insert(samples.end(), others.begin(), others.end());

  for (const int rings : {16, 64}) {
    const double step = (rings == 16 ? 1.2 : 2.4) / size.scan_factor, noise = 0.01;
    samples.push_back({shapes::lidar({.rings = rings, .azimuth_step = step, .noise = noise}),
                       {{"rings", rings}, {"azimuth_step_degrees", step}, {"room", {20, 15, 4}}}});
  }
  const shapes::DepthCameraOptions camera{.width = 640 * size.scan_factor / 6, .height = 480 * size.scan_factor / 6};
  samples.push_back({shapes::depthCamera(camera), {{"depth_step", camera.depth_step}, {"room", {20, 15, 4}}}});
  return samples;
}

std::vector<MeshSample> meshSamples(int factor) {
  const int n = 8 * factor;
  const Json parts{{"parts_per_edge", n}};
  return {
      {shapes::cubeMesh(n, Quality::good), "obj", parts},
      {shapes::cubeMesh(n, Quality::bad), "obj", parts},
      {shapes::cubeQuads(n), "obj", parts},
      {shapes::prismMesh(n, Quality::good), "off", parts},
      {shapes::prismMesh(n, Quality::bad), "off", parts},
      {shapes::prismQuads(n), "off", parts},
      {shapes::icosphere(factor == 1 ? 2 : 5), "ply", {{"radius", 1}, {"subdivisions", factor == 1 ? 2 : 5}}},
      {shapes::gridSquare(n), "ply", parts},
      {shapes::book(3, n), "off", {{"pages", 3}, {"parts_per_edge", n}}},
      {shapes::book(5, n), "ply", {{"pages", 5}, {"parts_per_edge", n}}},
      {shapes::fins(n), "obj", parts},
      {shapes::bowTie(), "off", Json::object()},
      {shapes::bowTieCones(n), "ply", {{"sides", n}}},
      {shapes::moebius(n), "obj", {{"width", 0.8}, {"parts_across", n}}},
      {shapes::kleinBottle(2 * n), "off", {{"parts_across", 2 * n}}},
      {shapes::slivers(n), "ply", {{"parts_per_edge", n}, {"cap_height", 1e-10}}},
      {shapes::zeroLengthEdges(n), "ply", parts},
      {shapes::repeatedVertices(n), "off", parts},
      {shapes::unreferencedVertices(n), "obj", parts},
      {shapes::duplicateTriangles(n), "off", parts},
      {shapes::severalComponents(), "obj", Json::object()},
  };
}

// The shortest text that reads back as the same number.
std::string text(double x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr};
}

// Ten digits: more would depend on the mathematical library, and on the compiler where a truth is numeric.
double rounded(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", x);
  double result = 0;
  std::from_chars(buffer, buffer + std::strlen(buffer), result);
  return result;
}

Json numberOrNull(double x) {
  return x == x ? Json(rounded(x)) : Json(nullptr);
}

Json spectrum(const tufted::VectorXd& values) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(values.size(), 50); ++i) result.push_back(rounded(values[i]));
  return result;
}

void write(const fs::path& path, const std::string& content) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string cloudPly(const Cloud& cloud, bool as_double) {
  const std::string type = as_double ? "double" : "float";
  const bool scan = cloud.width > 0;
  std::string ply = "ply\nformat binary_little_endian 1.0\n";
  if (scan) {
    ply += "obj_info num_cols " + std::to_string(cloud.width) + "\nobj_info num_rows " + std::to_string(cloud.height);
    ply += "\n";
  }
  ply += "element vertex " + std::to_string(cloud.points.rows()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    if (!scan || name[0] != 'n') ply.append("property ").append(type).append(" ").append(name).append("\n");
  }
  if (!cloud.labels.empty()) ply += "property uchar label\n";
  ply += "end_header\n";

  const auto append = [&](double x) {
    const float single = static_cast<float>(x);
    ply.append(as_double ? reinterpret_cast<const char*>(&x) : reinterpret_cast<const char*>(&single),
               as_double ? sizeof x : sizeof single);
  };
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append(cloud.points(i, axis));
    for (int axis = 0; axis < 3 && !scan; ++axis) append(cloud.normals(i, axis));
    if (!cloud.labels.empty()) ply.push_back(static_cast<char>(cloud.labels[i]));
  }
  return ply;
}

tufted::Polygons facesOf(const Mesh& mesh) {
  if (!mesh.polygons.empty()) return mesh.polygons;
  tufted::Polygons faces;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    faces.push_back({mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)});
  }
  return faces;
}

std::string meshText(const Mesh& mesh, const std::string& format) {
  const tufted::Polygons faces = facesOf(mesh);
  const bool obj = format == "obj";
  const std::string points = std::to_string(mesh.points.rows()), count = std::to_string(faces.size());
  std::string result;
  if (format == "off") result = "OFF\n" + points + " " + count + " 0\n";
  if (format == "ply") {
    result = "ply\nformat ascii 1.0\nelement vertex " + points +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " + count +
             "\nproperty list uchar int vertex_indices\nend_header\n";
  }
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    if (obj) result += "v ";
    result += text(mesh.points(i, 0)) + " " + text(mesh.points(i, 1)) + " " + text(mesh.points(i, 2)) + "\n";
  }
  for (const std::vector<int>& face : faces) {
    result += obj ? "f" : std::to_string(face.size());
    for (const int corner : face) result.append(" ").append(std::to_string(corner + (obj ? 1 : 0)));
    result += "\n";
  }
  return result;
}

Json truthOf(const CloudSample& sample, bool as_double) {
  const Cloud& cloud = sample.cloud;
  const auto finite = cloud.points.array().isFinite().rowwise().all().count();
  Json truth{{"kind", "cloud"},
             {"shape", cloud.shape},
             {"parameters", sample.parameters},
             {"sampling", cloud.sampling},
             {"noise", cloud.noise},
             {"seed", cloud.seed},
             {"points", cloud.points.rows()},
             {"finite_points", finite},
             {"coordinates", as_double ? "float64" : "float32"},
             {"area", numberOrNull(cloud.area)},
             {"boundary", cloud.boundary}};
  truth["components"] = cloud.width > 0 ? Json(nullptr) : Json(cloud.components);
  if (cloud.width > 0) truth["width"] = cloud.width, truth["height"] = cloud.height;
  if (cloud.eigenvalues.size() > 0) truth["eigenvalues"] = spectrum(cloud.eigenvalues);
  return truth;
}

Json truthOf(const MeshSample& sample) {
  const Mesh& mesh = sample.mesh;
  Json truth{{"kind", "mesh"},
             {"shape", mesh.shape},
             {"parameters", sample.parameters},
             {"points", mesh.points.rows()},
             {"faces", facesOf(mesh).size()},
             {"area", numberOrNull(mesh.area)},
             {"area_is_exact", mesh.flat},
             {"components", mesh.components},
             {"boundary_edges", mesh.boundary_edges},
             {"nonmanifold_edges", mesh.nonmanifold_edges},
             {"nonmanifold_vertices", mesh.nonmanifold_vertices},
             {"orientable", mesh.orientable},
             {"euler", mesh.euler}};
  if (mesh.eigenvalues.size() > 0) truth["eigenvalues"] = spectrum(mesh.eigenvalues);
  return truth;
}

void makeDatasets(const fs::path& folder, const Size& size) {
  fs::create_directories(folder);
  std::string truth = "{\n";
  const auto record = [&](const std::string& file, const Json& entry) {
    truth.append(truth.size() > 2 ? ",\n" : "").append(Json(file).dump()).append(": ").append(entry.dump());
  };
  for (const CloudSample& sample : cloudSamples(size)) {
    const std::string file = sample.cloud.name + ".ply";
    write(folder / file, cloudPly(sample.cloud, size.as_double));
    record(file, truthOf(sample, size.as_double));
  }
  for (const MeshSample& sample : meshSamples(size.mesh_factor)) {
    const std::string file = sample.mesh.name + "." + sample.format;
    write(folder / file, meshText(sample.mesh, sample.format));
    record(file, truthOf(sample));
  }
  write(folder / "truth.json", truth + "\n}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool sized = arguments.size() == 3 && arguments[1] == "--size";
  const bool large = sized && arguments[2] == "large";
  if (arguments.size() != 1 && !large && !(sized && arguments[2] == "small")) {
    std::fputs("usage: make_datasets OUT_DIR [--size small|large]\n", stderr);
    return 2;
  }
  try {
    makeDatasets(arguments[0], large ? large_size : small_size);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_datasets: %s\n", error.what());
    return 1;
  }
  return 0;
}
