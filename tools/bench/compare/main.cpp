// tufted_compare: other Laplacians and ours on the same data, one table per question. See --help.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "bench/compare/tables.h"

namespace tufted::bench {

std::vector<CloudRival> rivalsOf(const Settings& settings) {
  const std::vector<CloudRival> all = cloudRivals();
  if (settings.rivals.empty()) return all;
  std::vector<CloudRival> rivals;
  for (const std::string& name : settings.rivals) {
    const auto named =
        std::find_if(all.begin(), all.end(), [&](const CloudRival& rival) { return rival.name == name; });
    if (named == all.end()) throw std::runtime_error("--rivals: no Laplacian is called " + name);
    rivals.push_back(*named);
  }
  return rivals;
}

std::vector<RealShape> shapesOf(const Settings& settings, int eigenvalues) {
  std::vector<RealShape> shapes;
  for (const auto& [path, half] : shapeFiles(settings.real / "shapes")) {
    if (static_cast<int>(shapes.size()) == settings.shapes) break;
    if (settings.half == Half::both || settings.half == half) shapes.push_back(realShape(path, eigenvalues));
  }
  return shapes;
}

}  // namespace tufted::bench

int main(int argc, char** argv) {
  namespace bench = tufted::bench;
  struct Command {
    const char *name, *purpose;
    bench::Table (*print)(const bench::Settings&);
  };
  const std::vector<Command> commands = {
      {"spectrum", "Errors of 40 eigenvalues on real shapes, a sphere and a torus", bench::printSpectrum},
      {"boundary", "How far harmonic functions leave the range of their pins", bench::printBoundary},
      {"green", "Sizes, times and signs of Green's functions for several k", bench::printGreen},
      {"noise", "Errors of 40 eigenvalues of a torus against noise", bench::printNoise},
      {"density", "Against a step of density", bench::printDensity},
      {"lines", "Against the spacing of scan lines", bench::printLines},
      {"sheets", "Of two squares against their distance", bench::printSheets},
      {"orders", "Eigenvalues with other orders of faces around edges", bench::printOrders},
      {"thick", "Meshes that are not manifold beside tetrahedra that fill a layer around them", bench::printThick},
      {"distance", "Errors of distances on the vertices of real shapes", bench::printDistance},
      {"dataset", "Whether all guarantees hold on the meshes of a folder", bench::printDataset},
      {"cover", "The tufted cover of a small mesh and its intrinsic edges, as a drawing", bench::printCover},
  };
  bench::Settings settings;
  std::string json;
  const std::map<std::string, bench::Half> halves = {
      {"choosing", bench::Half::choosing}, {"held-out", bench::Half::held_out}, {"both", bench::Half::both}};
  CLI::App app("Compares Laplacians of clouds and meshes, each command by one table.");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--real", settings.real, "Folder of shapes/");
  app.add_option("--meshes", settings.meshes, "Folder of meshes");
  app.add_option("--half", settings.half, "Which half of the shapes")->transform(CLI::CheckedTransformer(halves));
  app.add_option("--points", settings.points, "Points of each cloud");
  app.add_option("--noise", settings.noise, "spectrum, green, orders: standard deviation in spacings");
  app.add_option("--seed", settings.first_seed, "The first seed; constants are chosen on 1 to 9");
  app.add_option("--seeds", settings.seeds, "spectrum, noise, density, lines, sheets: how many seeds")
      ->check(CLI::Range(1, 100));
  app.add_option("--shapes", settings.shapes, "At most this many real shapes");
  app.add_option("--rivals", settings.rivals, "Only these")->delimiter(';');
  app.add_option("-k", settings.k, "The same tables: neighbours, instead of the number of each rival");
  app.add_option("--json", json, "Write the rows to this file as well");
  app.add_option("--svg", settings.picture, "Draw the table, of `cover` the cover, into this file");
  for (const Command& command : commands) {
    CLI::App* added = app.add_subcommand(command.name, command.purpose);
    if (command.print == bench::printDataset) added->add_option("DIR", settings.meshes, "Folder, with its subfolders");
    if (command.print != bench::printCover) continue;
    added->add_option("FILE", settings.file, "Mesh of at most 2,000 triangles (a sheared book of three pages)");
    added->add_option("--page", settings.page, "Write the cover as a page for any browser, which one can turn");
  }
  CLI11_PARSE(app, argc, argv);
  try {
    for (const Command& command : commands) {
      if (!app.got_subcommand(command.name)) continue;
      const bench::Table table = command.print(settings);
      if (!json.empty() && !(std::ofstream(json) << table.json().dump(1) << "\n"))
        throw std::runtime_error("cannot write " + json);
      if (!settings.picture.empty() && command.print != bench::printCover)
        drawTable(table, command.purpose, settings.picture);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_compare: %s\n", error.what());
    return 1;
  }
}
