#include "info_text.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "structure.h"
#include "tufted/io/read.h"

namespace {

using Json = nlohmann::ordered_json;

constexpr double coarse_step = 0.1;  ///< float steps above this many spacings move points visibly

void printTriple(const char* name, const Json& values) {
  std::printf("%-15s %.10g %.10g %.10g\n", name, values[0].get<double>(), values[1].get<double>(),
              values[2].get<double>());
}

void printFields(const Json& info) {
  std::string names = info["normals"] ? "normals" : "";
  for (const Json& field : info["fields"]) {
    const int count = field["count"].get<int>();
    names += (names.empty() ? "" : ", ") + field["name"].get<std::string>() + " " + field["type"].get<std::string>() +
             (count > 1 ? " x " + std::to_string(count) : "");
  }
  if (!names.empty()) std::printf("%-15s %s\n", "fields", names.c_str());
}

long long integer(const Json& info, const char* member) {
  return static_cast<long long>(info[member].get<std::int64_t>());
}

double real(const Json& info, const char* member) {
  return info[member].get<double>();
}

}  // namespace

std::vector<std::string> findOddities(const nlohmann::ordered_json& info, bool joins_equal) {
  std::vector<std::string> odd;
  const std::string of_sample = info["sampled"] == info["points"]
                                    ? ""
                                    : " of " + std::to_string(info["sampled"].get<std::int64_t>()) + " looked at";
  const auto add = [&](const char* member, const char* text, const std::string& tail = "") {
    if (info.contains(member) && info[member].get<std::int64_t>() > 0)
      odd.push_back(std::string(text) + ": " + std::to_string(info[member].get<std::int64_t>()) + tail);
  };
  if (info["points"] == 0) odd.emplace_back("the file holds no points");
  add("not_finite", "points that are not finite and take no part");
  add("coincident",
      info["kind"] == "cloud" ? "points that equal an earlier one and take no part"
      : joins_equal           ? "vertices that equal an earlier one, which stands for them"
                              : "vertices that equal another one and stay separate (--weld joins them)",
      of_sample);
  add("outliers",
      "points whose nearest neighbour is five times as far as is usual around them; most take part all the same",
      of_sample);
  add("isolated", "vertices without a triangle");
  add("repeated_vertex_triangles", "triangles that name a vertex twice and are dropped");
  add("not_finite_triangles", "triangles with a vertex that is not finite, which are dropped");
  add("degenerate_faces", "faces without area");
  add("nonmanifold_edges", "edges of more than two triangles");
  if (info.contains("on_lines") && info["on_lines"].get<double>() > 0.05 * info["sampled"].get<double>())
    add("on_lines", "points whose neighbours lie on one line, as on the rings of a spinning scanner", of_sample);
  const double spacing = info["spacing"].get<double>(), step = info["float_step"].get<double>();
  if (std::isinf(step))
    odd.push_back("coordinates beyond the range of floats");
  else if (spacing > 0 && step > coarse_step * spacing)
    odd.push_back("so far from the origin that floats would move points by up to " +
                  std::to_string(step / 2 / spacing) + " of the spacing");
  return odd;
}

void printInfoHead(const Json& info) {
  std::printf("%-15s %s (%s)\n", "file", info["file"].get<std::string>().c_str(),
              info["kind"].get<std::string>().c_str());
  std::printf("%-15s %s\n", "format", info["format"].get<std::string>().c_str());
  std::printf("%-15s %lld", "points", integer(info, "points"));
  if (info["organized"]) std::printf(", organized %lld x %lld", integer(info, "width"), integer(info, "height"));
  if (info["kind"] == "mesh") std::printf("; %lld faces", integer(info, "triangles"));
  std::printf("\n");
  printFields(info);
  if (info.contains("reference_system"))
    std::printf("%-15s %s\n", "crs", info["reference_system"].get<std::string>().c_str());
  if (info["viewpoint"] != Json(tufted::Geometry().viewpoint))
    std::printf("%-15s %s\n", "viewpoint", info["viewpoint"].dump().c_str());
  std::fflush(stdout);
}

void printInfo(const Json& info) {
  const bool is_mesh = info["kind"] == "mesh";
  if (is_mesh)
    std::printf("%-15s %lld, %lld polygons triangulated\n", "triangles", integer(info, "triangles"),
                integer(info, "polygons"));
  if (integer(info, "merged_vertices") > 0)
    std::printf("%-15s %lld equal corners\n", "merged", integer(info, "merged_vertices"));
  if (info.contains("selection"))
    std::printf("%-15s %lld of %lld points, which the rest describes\n", "chosen", integer(info["selection"], "kept"),
                integer(info["selection"], "points"));
  if (info.contains("classes"))
    for (const Json& each : info["classes"])
      std::printf("%-15s %lld %s, %lld points\n", "class", integer(each, "number"),
                  each["name"].get<std::string>().c_str(), integer(each, "points"));
  printTriple("lowest", info["lowest"]);
  printTriple("highest", info["highest"]);
  if (integer(info, "sampled") < integer(info, "points"))
    std::printf("%-15s %lld points; --full looks at all\n", "sample", integer(info, "sampled"));
  std::printf("%-15s %.4g (%.4g to %.4g)\n", "spacing", real(info, "spacing"), real(info, "spacing_low"),
              real(info, "spacing_high"));
  std::printf("%-15s %.4g\n", "float step", real(info, "float_step"));
  if (is_mesh) {
    std::printf("%-15s %.4g\n", "mean edge", real(info, "mean_edge"));
    std::printf("%-15s %lld boundary, %lld nonmanifold\n", "edges", integer(info, "boundary_edges"),
                integer(info, "nonmanifold_edges"));
  }
  if (info.value("neighbors_clamped", false))
    std::printf("%-15s %lld, all other points\n", "neighbors", integer(info, "neighbors"));
  for (const auto& [member, name] : {std::pair("components", "components"), std::pair("graph_parts", "graph parts")})
    if (info.contains(member)) std::printf("%-15s %lld\n", name, integer(info, member));
  if (info.value("structure", "") == nameOf(Structure::image))
    std::printf("%-15s %s\n", "structure", "depth image, built by its pixels");
  for (const Json& sentence : info["odd"]) std::printf("%-15s %s\n", "odd", sentence.get<std::string>().c_str());
  std::printf("%-15s %.2g s, %.0f MB\n", "to expect", real(info, "expected_seconds"),
              real(info, "expected_bytes") / 1e6);
}
