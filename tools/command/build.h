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

/// How a Laplacian is built, as the options of a command state it.
struct Build {
  bool normals = false;  ///< whether to use the normals of the file
  tufted::Preset preset = tufted::Preset::scan;
  Structure structure = Structure::automatic;  ///< that which was used, in the end
  bool denoise = false;           ///< whether noisy points are moved with any preset, and commands start there
  std::optional<double> mollify;  ///< if empty, the default of clouds or of meshes

  /// The options that were used in the end; they borrow from the members below and from the geometry.
  tufted::CloudOptions cloud;
  tufted::MeshOptions mesh;
  std::string given_viewpoint;  ///< X,Y,Z; empty: that of the file, if it has one
  std::optional<tufted::ScanStructure> scan;
  std::string doubt;  ///< see doubtOf()
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  tufted::Points moved;  ///< where --denoise has moved the points; 0 x 3 without it

  const CLI::Option* neighbors = nullptr;      ///< --neighbors
  const CLI::Option* seed = nullptr;           ///< --seed
  std::vector<const CLI::Option*> cloud_only;  ///< options that have no meaning for a mesh
  std::vector<const CLI::Option*> building;    ///< options that have no meaning for a Laplacian that was built before
};

/// Adds all options of building; they set `build`, which must outlive the command.
void addBuildOptions(CLI::App& command, Build& build);

/// @throws CLI::RequiresError for --seed without --order random
void checkSeed(const Build& build);

/// Builds the Laplacian of what was read, with the options as `build` has them; fills in its members.
/// @param keep_cover whether the result keeps its cover
/// @throws InvalidInput for options of clouds where the input is a mesh, IoError for what the input does not have
tufted::Laplacian buildLaplacian(const tufted::Geometry& geometry, const Input& input, Build& build, bool keep_cover,
                                 const tufted::Progress& progress);

/// Tells that the points are a depth image, if the build made use of it; how strong the noise is that points were moved
/// out of, if any; and how many neighbours were used, if the cloud has fewer than were asked for.
void addBuild(const tufted::Report& report, const Build& build, Summary& summary);
