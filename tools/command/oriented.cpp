#include "oriented.h"

#include <CLI/CLI.hpp>
#include <string>

#include "options.h"
#include "tufted/errors.h"
#include "tufted/gradient.h"

namespace {

[[noreturn]] void refuse(const Operator& source, const std::string& missing) {
  throw tufted::IoError(source.name + ": has no " + missing + ", which `tufted laplacian --format npz,ply` writes");
}

}  // namespace

void addOrienting(CLI::App& command, Orienting& orienting) {
  command.add_flag("--consistent", orienting.consistent,
                   "Let normals of neighbours agree and point outwards, even if the position of the sensor is known");
}

void checkFrames(const Operator& source) {
  checkPositions(source);
  const tufted::Laplacian& laplacian = source.laplacian;
  const bool has_frames = laplacian.frames.normals.rows() > 0 || source.geometry.is_mesh;
  if (!laplacian.status.empty() && !has_frames) refuse(source, "frames of a cloud");
}

void checkPositions(const Operator& source) {
  const tufted::Laplacian& laplacian = source.laplacian;
  // An empty status means that the Laplacian is not yet built.
  if (!laplacian.status.empty() && laplacian.positions.rows() == 0) refuse(source, "measured_positions.npy");
}

tufted::Frames framesOf(const Operator& source) {
  if (!source.geometry.is_mesh) return source.laplacian.frames;
  return tufted::meshFrames(source.laplacian, source.geometry.points, source.geometry.triangles);
}

tufted::Frames orientedFrames(const Orienting& orienting, const Operator& source, Results& results) {
  const tufted::Laplacian& laplacian = source.laplacian;
  tufted::Frames frames = framesOf(source);
  if (frames.orientation == tufted::Orientation::viewpoint && !orienting.consistent) {
    results.report["orientation"] = {{"towards", "viewpoint"}};
    results.summary.add("normals", "towards the sensor");
    return frames;
  }
  tufted::OrientationReport made;
  frames = tufted::orientedFrames(
      laplacian, frames,
      {.up = source.up.isZero(0) ? nullptr : &source.up, .threads = source.threads, .progress = source.progress},
      &made);
  results.report["orientation"] = {{"towards", "outside"},
                                   {"components", made.components},
                                   {"open", made.open},
                                   {"turned", made.turned},
                                   {"disagreeing_edges", made.disagreeing_edges},
                                   {"seconds", made.seconds}};
  const std::string rest = std::to_string(made.turned) + " turned, " + std::to_string(made.disagreeing_edges) +
                           " pairs of neighbours disagree";
  if (made.open < made.components)
    results.summary.add("normals", "outwards on %s, %s", countText(made.components - made.open, "component").c_str(),
                        rest.c_str());
  if (made.open > 0)
    results.summary.add("normals", "%s on %s without an outside%s%s", source.up.isZero(0) ? "alike" : "upwards",
                        countText(made.open, "open component").c_str(),
                        source.up.isZero(0) ? " (--up or, of a scan, --viewpoint decides)" : "",
                        made.open == made.components ? (", " + rest).c_str() : "");
  return frames;
}
