#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <optional>
#include <string>
#include <vector>

#include "input.h"
#include "structure.h"
#include "summary.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"

/// How a Laplacian is built, by the options of a command.
struct Build {
  bool normals = false;  ///< whether to use the normals of the file
  tufted::Preset preset = tufted::Preset::scan;
  Structure structure = Structure::automatic;  ///< after the build the one that was used
  bool denoise = false;           ///< whether noisy points are moved with any preset, and commands use moved points
  std::optional<double> mollify;  ///< empty: the default

  /// The options of the build. They borrow from the members below and from the geometry.
  tufted::CloudOptions cloud;
  tufted::MeshOptions mesh;
  std::string given_viewpoint;  ///< X,Y,Z; empty: that of the file, if it has one
  std::optional<tufted::ScanStructure> scan;
  std::string doubt;  ///< see doubtOf()
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  tufted::Points moved;  ///< the points as moved by --denoise; 0 x 3 without it

  const CLI::Option* neighbors = nullptr;      ///< --neighbors
  const CLI::Option* seed = nullptr;           ///< --seed
  std::vector<const CLI::Option*> cloud_only;  ///< options that do not apply to meshes
  std::vector<const CLI::Option*> building;    ///< options that do not apply with --operator
};

/// The name of a preset, as --preset takes it.
std::string presetName(tufted::Preset preset);

/// Adds the options of building. They set `build`, which must outlive the command.
void addBuildOptions(CLI::App& command, Build& build);

/// @throws CLI::RequiresError for --seed without --order random
void checkSeed(const Build& build);

/// Builds the Laplacian of the geometry that was read, and completes `build`.
/// @param keep_cover whether the result keeps its cover
/// @throws InvalidInput for options of clouds with a mesh, IoError if the input lacks what an option needs
tufted::Laplacian buildLaplacian(const tufted::Geometry& geometry, const Input& input, Build& build, bool keep_cover,
                                 const tufted::Progress& progress);

/// Adds to the summary whether the cloud was built as a depth image, the strength of the noise if points were moved,
/// and the number of neighbours if the cloud has fewer points than were asked for.
void addBuild(const tufted::Report& report, const Build& build, Summary& summary);
