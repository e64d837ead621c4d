// Builds of clouds that are larger than memory.
#include "tufted/io/tiles.h"

#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/module.h"
#include "python/running.h"

namespace py = pybind11;

namespace tufted::python {
namespace {

/// Builds a cloud by tiles.
/// @param source path of a file, or N x 3 points
/// @param selection_text what `selection` is, for report.json; empty: all points
/// @return warnings
std::vector<std::string> writeByTiles(const std::filesystem::path& dir, const py::object& source,
                                      const Selection& selection, const std::string& selection_text,
                                      const std::string& preset, bool keep_noise, double memory, int neighbors,
                                      double mollify, int threads, const py::object& progress) {
  TileOptions options;
  options.cloud.steps = cloudSteps(
      chosen<Preset>("preset", preset, {{"clean", Preset::clean}, {"scan", Preset::scan}, {"lidar", Preset::lidar}}));
  options.cloud.steps.denoise = options.cloud.steps.denoise && !keep_noise;
  options.cloud.neighbors = neighbors;
  options.cloud.mollify = mollify;
  options.cloud.threads = threads;
  TileSourceText text{.selection = selection_text, .preset = preset, .keep_noise = keep_noise};
  const bool is_file = !py::isinstance<Doubles>(source);
  if (is_file) text.source = source.cast<std::filesystem::path>().string();
  const Doubles points = is_file ? Doubles() : source.cast<Doubles>();
  return run(progress, [&](const Progress& called) {
    FileSource opened;
    if (is_file)
      opened = sourceOf(text.source, ReadAs::automatic, selection, called);
    else
      static_cast<PointSource&>(opened) = sourceOf(pointsOf(points));
    options.progress = called;
    if (opened.memory > 0 && memory <= opened.memory)
      throw InvalidInput("laplacian_by_tiles: memory = " + std::to_string(std::llround(memory)) +
                         " bytes, must be more than the " + std::to_string(std::llround(opened.memory)) +
                         " that reading " + text.source + " takes");
    options.memory = memory - opened.memory;
    text.of = opened.of;
    text.rows = opened.rows;
    std::vector<std::string> notes = opened.notes;
    for (std::string& line : warnings(writeLaplacianByTiles(dir, opened, options, text))) notes.push_back(line);
    return notes;
  });
}

}  // namespace

void addTiles(py::module_& module) {
  module.def("write_by_tiles", &writeByTiles);
}

}  // namespace tufted::python
