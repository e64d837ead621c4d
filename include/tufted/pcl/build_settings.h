#pragma once

#include <pcl/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/laplacian_builder.h"
#include "tufted/pcl/surface_values.h"

namespace tufted {

/// Whether the pixels of an organized cloud replace the search for neighbours.
enum class OrganizedSearch {
  automatic,  ///< if isDepthImage() recognises what a pinhole camera at sensor_origin_ saw, as the command `tufted`
              ///< does
  on,         ///< the cloud is declared a depth image seen from its sensor_origin_; a search method replaces pixels
  off,        ///< never: neighbours are found in space
};

/// The setting of PCL classes that use the pixels of an organized cloud.
class OrganizedSettings {
 public:
  /// Whether pixels replace the search, by default OrganizedSearch::automatic. In a depth image no tree is built, k has
  /// no effect, and noise is measured along the line of sight.
  void setOrganizedSearch(OrganizedSearch organized) { organized_ = organized; }
  /// True declares an organized input a depth image; false has neighbours found in space.
  void setOrganizedSearch(bool organized) { organized_ = organized ? OrganizedSearch::on : OrganizedSearch::off; }
  /// See setOrganizedSearch().
  OrganizedSearch getOrganizedSearch() const { return organized_; }

 protected:
  OrganizedSearch organized_ = OrganizedSearch::automatic;  ///< see setOrganizedSearch()
};

namespace detail {

/// A cloud of PCL as the core takes it.
struct CloudInput {
  Points points;                                     ///< all points of the cloud, in double
  int width = 0;                                     ///< that of the cloud
  int height = 0;                                    ///< that of the cloud; above 1 it is organized
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< the cloud's sensor_origin_
  const pcl::Indices* indices = nullptr;             ///< points to build from, one row each; null: all, in their order
  std::optional<Neighborhoods> neighborhoods = {};   ///< found by a search method, one row per row of the Laplacian
};

/// The pixels of a depth image, or nothing if neighbours are to be found in space.
/// @throws InvalidInput if the cloud is declared a depth image but is not organized
std::optional<ScanStructure> pixelsOf(const CloudInput& input, OrganizedSearch organized);

/// Calls a function and reports what it throws on PCL's console.
/// @return whether nothing was thrown
bool reported(const std::string& class_name, const char* method, const std::function<void()>& call);

/// Throws InvalidInput if a feature was given a radius or another cloud to search.
void refuseSearches(double radius, bool has_search_surface);

/// Whether a point has values: it takes part, or coincides with a point that does.
bool hasValues(const Laplacian& laplacian, int i);

/// The rows of `values` that `indices` name, NaN where a point has none.
/// @param[out] all whether all of these points have values
PointValues rowsOf(const Laplacian& laplacian, const PointValues& values, const pcl::Indices& indices, bool& all);

}  // namespace detail

/// Settings that the PCL classes have in common: how they build the Laplacian of their input.
class BuildSettings : public OrganizedSettings {
 public:
  /// Sets the options of the core. What they borrow (normals, neighborhoods, structure, viewpoint) is copied and may be
  /// discarded after the call. Whatever the order of calls, `neighbors` and `threads` have no effect once setKSearch()
  /// and setNumberOfThreads() have been called. Options without a viewpoint discard that of setViewPoint(). A search
  /// method, or pixels that setOrganizedSearch() declares, replace neighborhoods and structure; automatic recognition
  /// does not.
  void setOptions(const CloudOptions& options);
  /// The options in effect, which borrow what this object owns.
  CloudOptions getOptions() const;

  /// The steps of the build for a kind of cloud, by default Preset::scan. Replaces CloudOptions::steps.
  void setPreset(Preset preset) { options_.steps = cloudSteps(preset); }

  /// At most this many threads; 0 (default): one per processor.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = static_cast<int>(threads); }
  /// See setNumberOfThreads().
  unsigned int getNumberOfThreads() const { return static_cast<unsigned int>(getOptions().threads); }

  /// The position of the sensor, which normals face and which distinguishes jumps from rims. Without a call it is the
  /// sensor_origin_ of an organized input, and unknown for another one.
  void setViewPoint(float x, float y, float z) { viewpoint_ = Eigen::Vector3d(x, y, z); }

 protected:
  /// Calls `build` with the points and the options of a build. Errors are those of pointCloudLaplacian().
  void withOptions(const detail::CloudInput& input,
                   const std::function<void(const PointsRef&, const CloudOptions&)>& build) const;
  /// Builds in memory that no earlier result uses any more. The result stays valid as long as someone holds it.
  std::shared_ptr<const Laplacian> build(const detail::CloudInput& input);
  /// The position of the sensor, null if unknown. Belongs to this object or to `input`.
  const Eigen::Vector3d* viewpointOf(const detail::CloudInput& input) const;

  CloudOptions options_;               ///< as set, without what they borrow
  std::optional<int> neighbors_ = {};  ///< k as set by setKSearch()

 private:
  std::optional<int> threads_;
  std::optional<Points> normals_;
  std::optional<Neighborhoods> neighborhoods_;
  std::optional<ScanStructure> structure_;
  std::optional<Eigen::Vector3d> viewpoint_;
  std::vector<std::shared_ptr<LaplacianBuilder>> builders_;
};

/// Settings of classes that use a Laplacian: one that was built before, or their own.
class SurfaceSettings : public BuildSettings {
 public:
  /// Uses a Laplacian that was built before, row i for point i of the input: that of LaplacianEstimation::compute()
  /// without setIndices(). Of the settings only the threads and, for normals and curvatures, the viewpoint have an
  /// effect then. Null (default): every computation builds its own, from all points of the input, whatever setIndices()
  /// says.
  void setSurface(std::shared_ptr<const Laplacian> surface) { given_ = std::move(surface); }
  /// The Laplacian of the last computation, whose status says why a point takes no part; null before the first.
  const std::shared_ptr<const Laplacian>& getSurface() const { return used_; }

 protected:
  /// The Laplacian that was given, or a new one, whose warnings are printed on PCL's console.
  /// @throws InvalidInput if the one that was given has not one row per point of the cloud
  const Laplacian& surfaceOf(const std::string& class_name, const detail::CloudInput& input);
  /// Whether a Laplacian was given, so that no neighbours are needed.
  bool hasGivenSurface() const { return given_ != nullptr; }

 private:
  std::shared_ptr<const Laplacian> given_, used_;
};

}  // namespace tufted
