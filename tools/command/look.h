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

/// What a command shows, by its options.
struct Look {
  std::filesystem::path png;   ///< empty: no picture
  std::filesystem::path page;  ///< empty: no page
  std::string color;           ///< name of the field that is shown; empty: the first
  std::optional<int> column;   ///< column of this field; empty: the first that is not constant
  tufted::PictureOptions picture;

  bool isWanted() const { return !png.empty() || !page.empty(); }
};

/// Adds --png and the options of pictures.
void addPictureOptions(CLI::App& command, Look& look);
/// Adds the same and --view.
void addLookOptions(CLI::App& command, Look& look);

/// Checks before the build that the files of a look can be written.
/// @param out folder of the results, which is made with its parents if missing; empty: none
/// @param inputs files and folders that the command reads
/// @throws InvalidInput, IoError
void checkLook(const Look& look, const std::filesystem::path& out, const std::vector<NamedInput>& inputs);

/// A field that can be shown.
struct ShownField {
  std::string name;
  Eigen::Index columns = 1;  ///< columns to choose from; 1 also if all are shown together; 0: not known yet
  Eigen::Index least = 1;    ///< columns that there are at least, where they are not known
};

/// The fields of every Laplacian.
inline const std::vector<ShownField> laplacian_fields = {{"mass"}, {"boundary"}, {"component"}};

/// Checks --color and --column before the build.
/// @param fields that can be shown in addition to those of the file, beginning with the default
/// @param has_normals whether the picture has those of a cloud; not where points move
/// @throws InvalidInput for a field or a column that will not exist
void checkField(const Look& look, const tufted::Geometry& geometry, std::vector<ShownField> fields,
                bool has_normals = true);

/// Sets the camera to the sensor of a depth image, unless the options place it.
void lookFromSensor(const tufted::Geometry& geometry, Look& look);

/// Adds the coordinate or the direction of the normals that --color names, unless the scene has a field of that name,
/// and the height if the scene has no field.
void addPlaceField(const Look& look, tufted::Scene& scene);

/// Writes the page and the picture of a look without their names, see WholeFile.
/// @throws InvalidInput for a field or a column that does not exist, IoError
std::vector<tufted::WholeFile> prepareLook(const tufted::Scene& scene, const Look& look);

/// Adds the colours of the field --color to the copies of the points: fields red, green, blue and MeshLab's quality,
/// which replace existing ones.
void colorCopies(const tufted::Scene& scene, const Look& look, tufted::Geometry& geometry);

/// Writes results, with the colours of --color on the copies of the points, and the look if one is wanted. Errors of
/// the look are found before the results replace earlier ones.
/// @param scene_of makes the scene; called only if it is shown
/// @param write writes the results
template <class SceneOf, class Write>
void writeAndShow(Look& look, tufted::Geometry& geometry, const SceneOf& scene_of, const Write& write) {
  if (!look.isWanted() && look.color.empty()) return write();
  tufted::Scene scene = scene_of();
  lookFromSensor(geometry, look);
  addPlaceField(look, scene);
  std::vector<tufted::WholeFile> files = prepareLook(scene, look);
  colorCopies(scene, look, geometry);
  write();
  for (tufted::WholeFile& file : files) file.giveName();
}

/// Adds the files of a look to the summary.
void addLook(const Look& look, Summary& summary);
