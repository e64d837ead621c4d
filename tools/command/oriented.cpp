#include "oriented.h"

#include <CLI/CLI.hpp>

#include "tufted/errors.h"
#include "tufted/gradient.h"

void addOrienting(CLI::App& command, Orienting& orienting) {
  command.add_flag("--consistent", orienting.consistent,
                   "Normals as their neighbours' and outwards, even where the sensor's position is known");
}

void checkFrames(const Operator& source) {
  const tufted::Laplacian& laplacian = source.laplacian;
  if (laplacian.status.empty()) return;  // is yet to be built
  const bool has_frames = laplacian.frames.normals.rows() > 0 || source.geometry.is_mesh;
  if (!has_frames || laplacian.positions.rows() == 0)
    throw tufted::IoError(source.name + ": has no " + (has_frames ? "measured_positions.npy" : "frames of a cloud") +
                          ", which `tufted laplacian --format npz,ply` writes");
}

tufted::Frames orientedFrames(const Orienting& orienting, const Operator& source, Results& results) {
  const tufted::Laplacian& laplacian = source.laplacian;
  const bool is_mesh = source.geometry.is_mesh;
  tufted::Frames frames =
      is_mesh ? tufted::meshFrames(source.geometry.points, source.geometry.triangles) : laplacian.frames;
  if (frames.orientation == tufted::Orientation::viewpoint && !orienting.consistent) {
    results.report["orientation"] = {{"towards", "viewpoint"}};
    results.summary.add("normals", "towards the sensor");
    return frames;
  }
  tufted::OrientationReport made;
  frames = tufted::orientedFrames(laplacian, frames, {.progress = source.progress}, &made);
  results.report["orientation"] = {{"towards", "outside"},
                                   {"components", made.components},
                                   {"turned", made.turned},
                                   {"disagreeing_edges", made.disagreeing_edges},
                                   {"seconds", made.seconds}};
  results.summary.add("normals", "outwards on %lld components, %lld turned, %lld pairs of neighbours disagree",
                      static_cast<long long>(made.components), static_cast<long long>(made.turned),
                      static_cast<long long>(made.disagreeing_edges));
  return frames;
}
