#include "info_text.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "structure.h"
#include "suggestion.h"
#include "tufted/io/read.h"

namespace {

using Json = nlohmann::ordered_json;

constexpr double coarse_step = 0.1;  ///< float steps above this many spacings move points visibly

long long integer(const Json& info, const char* member) {
  return static_cast<long long>(info[member].get<std::int64_t>());
}

double real(const Json& info, const char* member) {
  return info[member].get<double>();
}

void addTriple(const char* name, const Json& values, Summary& lines) {
  lines.add(name, "%.10g %.10g %.10g", values[0].get<double>(), values[1].get<double>(), values[2].get<double>());
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

Summary infoHead(const Json& info) {
  const auto text = [](const Json& member) { return member.get<std::string>(); };
  Summary lines;
  lines.add("file", "%s (%s)", text(info["file"]).c_str(), text(info["kind"]).c_str());
  lines.add("format", "%s", text(info["format"]).c_str());
  std::string points = std::to_string(integer(info, "points"));
  if (info["organized"])
    points += ", organized " + std::to_string(integer(info, "width")) + " x " + std::to_string(integer(info, "height"));
  if (info["kind"] == "mesh") points += "; " + std::to_string(integer(info, "triangles")) + " faces";
  lines.add("points", "%s", points.c_str());
  std::vector<std::string> fields;
  if (info["normals"]) fields.emplace_back("normals");
  for (const Json& field : info["fields"]) {
    const int count = field["count"].get<int>();
    fields.push_back(text(field["name"]) + " " + text(field["type"]) +
                     (count > 1 ? " x " + std::to_string(count) : ""));
  }
  if (!fields.empty()) lines.add("fields", "%s", joined(fields).c_str());
  if (info.contains("reference_system")) lines.add("crs", "%s", text(info["reference_system"]).c_str());
  if (info["viewpoint"] != Json(tufted::Geometry().viewpoint))
    lines.add("viewpoint", "%s", info["viewpoint"].dump().c_str());
  return lines;
}

Summary infoBody(const Json& info) {
  Summary lines;
  const bool is_mesh = info["kind"] == "mesh";
  if (is_mesh)
    lines.add("triangles", "%lld, %lld polygons triangulated", integer(info, "triangles"), integer(info, "polygons"));
  if (integer(info, "merged_vertices") > 0) lines.add("merged", "%lld equal corners", integer(info, "merged_vertices"));
  if (info.contains("selection"))
    lines.add("chosen", "%lld of %lld points, which the rest describes", integer(info["selection"], "kept"),
              integer(info["selection"], "points"));
  if (info.contains("classes"))
    for (const Json& each : info["classes"])
      lines.add("class", "%lld %s, %lld points", integer(each, "number"), each["name"].get<std::string>().c_str(),
                integer(each, "points"));
  addTriple("lowest", info["lowest"], lines);
  addTriple("highest", info["highest"], lines);
  if (integer(info, "sampled") < integer(info, "points"))
    lines.add("sample", "%lld points; --full looks at all", integer(info, "sampled"));
  lines.add("spacing", "%.4g (%.4g to %.4g)", real(info, "spacing"), real(info, "spacing_low"),
            real(info, "spacing_high"));
  lines.add("float step", "%.4g", real(info, "float_step"));
  if (is_mesh) {
    lines.add("mean edge", "%.4g", real(info, "mean_edge"));
    lines.add("edges", "%lld boundary, %lld nonmanifold", integer(info, "boundary_edges"),
              integer(info, "nonmanifold_edges"));
  }
  if (info.value("neighbors_clamped", false))
    lines.add("neighbors", "%lld, all other points", integer(info, "neighbors"));
  for (const auto& [member, name] : {std::pair("components", "components"), std::pair("graph_parts", "graph parts")})
    if (info.contains(member)) lines.add(name, "%lld", integer(info, member));
  if (info.value("structure", "") == nameOf(Structure::image))
    lines.add("structure", "depth image, built by its pixels");
  for (const Json& sentence : info["odd"]) lines.add("odd", "%s", sentence.get<std::string>().c_str());
  lines.add("to expect", "%.2g s, %.0f MB", real(info, "expected_seconds"), real(info, "expected_bytes") / 1e6);
  return lines;
}
