#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "paths.h"
#include "summary.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"
#include "tufted/view/picture.h"
#include "tufted/view/scene.h"
#include "tufted/view/whole_file.h"

// A look at results: pages, pictures, and colours of the copies of the points.

/// What a command shows, as its options state it.
struct Look {
  std::filesystem::path png;   ///< empty: no picture
  std::filesystem::path page;  ///< empty: no page
  std::string color;           ///< name of the field that is shown; empty: the first
  std::optional<int> column;   ///< of this field; without one the first that is not constant
  tufted::PictureOptions picture;

  bool isWanted() const { return !png.empty() || !page.empty(); }
};

/// Adds --png and the options of what it shows.
void addPictureOptions(CLI::App& command, Look& look);
/// Adds these, and --view.
void addLookOptions(CLI::App& command, Look& look);

/// Refuses files that cannot be written, before anything is computed.
/// @param out where the results go: it and the folders above it are made if they are missing; empty: nowhere
/// @param inputs of the command
/// @throws InvalidInput, IoError
void checkLook(const Look& look, const std::filesystem::path& out, const std::vector<NamedInput>& inputs);

/// A field that there will be to look at.
struct ShownField {
  std::string name;
  Eigen::Index columns = 1;  ///< of which one is shown; 1 also for values that are shown as a whole; 0: not known yet
};

/// What there is to see of a Laplacian beside results.
inline const std::vector<ShownField> laplacian_fields = {{"mass"}, {"boundary"}, {"component"}};

/// Refuses a name of --color that is none of the fields that there will be, and a --column that its field does not
/// have.
/// @param fields that there will be beside those of the file, the one that is seen first in front
/// @throws InvalidInput
void checkField(const Look& look, const tufted::Geometry& geometry, std::vector<ShownField> fields);

/// Looks from where the sensor of a depth image stood, where the command line does not say from where.
void lookFromSensor(const tufted::Geometry& geometry, Look& look);

/// The page and the picture that are wanted, whole on the disk, but for their names.
/// @throws InvalidInput for a field or a column that there is not, IoError
std::vector<tufted::WholeFile> prepareLook(const tufted::Scene& scene, const Look& look);

/// Gives the copies of the points the colours of the field that --color names: fields red, green and blue, and
/// MeshLab's quality, in place of those that they have.
void colorCopies(const tufted::Scene& scene, const Look& look, tufted::Geometry& geometry);

/// Writes results, with the colours that --color asks for on the copies of the points, and a look at them where that is
/// wanted. Whatever is wrong with the look is found before the results replace former ones.
/// @param scene_of makes the scene, which is made only if it is looked at
/// @param write writes the results
template <class SceneOf, class Write>
void writeAndShow(Look& look, tufted::Geometry& geometry, const SceneOf& scene_of, const Write& write) {
  if (!look.isWanted() && look.color.empty()) return write();
  const tufted::Scene scene = scene_of();
  lookFromSensor(geometry, look);
  std::vector<tufted::WholeFile> files = prepareLook(scene, look);
  colorCopies(scene, look, geometry);
  write();
  for (tufted::WholeFile& file : files) file.giveName();
}

/// Says where a look was written to.
void addLook(const Look& look, Summary& summary);
