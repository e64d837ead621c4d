#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shapes/shapes.h"
#include "tufted/laplacian.h"

/// The table of tufted_scans: each case is a dataset with metrics, and each metric has a row per variant of the build.
namespace tufted::bench {

/// How neighbours are found.
enum class Neighbors { searched, image, rings };

/// A variant of the build; others are compared with the first of the table.
struct Variant {
  std::string name;
  CloudOptions options;
  Neighbors neighbors = Neighbors::searched;
};

/// A cloud with its truth.
struct Sample {
  shapes::Cloud cloud;
  shapes::ScanTruth truth{};                   ///< rooms only: the same rays without noise
  shapes::ImageEdges edges{};                  ///< depth images only: edges of the same image, complete and not rounded
  std::optional<Eigen::Vector3d> viewpoint{};  ///< position of the sensor, given to the build

  /// Whether it has the structure for this way to find neighbours.
  bool has(Neighbors neighbors) const;
};

/// One build of one sample.
class Build {
 public:
  /// @param sample borrowed
  /// @param core the build of the first variant; null for that itself
  Build(const Sample& sample, const Variant& variant, const Build* core);

  const Sample& sample() const { return sample_; }
  const shapes::Cloud& cloud() const { return sample_.cloud; }
  const Laplacian& laplacian() const { return laplacian_; }
  const Build& core() const { return core_ == nullptr ? *this : *core_; }
  double seconds() const { return seconds_; }
  /// Seconds of all steps until each point has its neighbours, without its plane.
  double searchSeconds() const;
  /// The union of stars, see unionOfStars(); computed by the first call.
  const Triangles& stars() const;

 private:
  const Sample& sample_;
  std::optional<ScanStructure> structure_;
  CloudOptions options_;
  const Build* core_;
  Laplacian laplacian_;
  double seconds_;
  mutable std::optional<Triangles> stars_;
};

/// A condition on the mean over the seeds: the rule with the bound `factor` times the reference's mean plus `value`.
struct Mark {
  enum class Rule { none, at_most, at_least, off_by_at_most };  ///< the last one compares the mean distance from 0
  enum class Reference { none, core, yardstick };

  Rule rule = Rule::none;
  double value = 0;
  Reference reference = Reference::none;
  double factor = 1;
  double stretch = std::numeric_limits<double>::quiet_NaN();  ///< a harder value that is desired, not required
  std::string variant = "scan";                               ///< variant to which the mark applies; "all": all
  bool at_any_size = false;                                   ///< whether it applies also to smaller clouds
};

enum class Format { scientific, percent, signed_percent, count, seconds };

/// A figure of the sample without a build, with which the metric is compared.
struct Yardstick {
  std::string name{};
  std::function<double(const Sample&)> measure{};
};

struct Metric {
  std::string name;
  Format format;
  std::function<double(const Build&)> measure;
  Mark mark{};
  Yardstick yardstick{};
};

struct Case {
  std::string what;     ///< what the case shows
  std::string dataset;  ///< name of the dataset, with its size
  std::function<Sample(std::uint64_t seed)> make;
  std::vector<Metric> metrics;
  bool is_random = true;     ///< false: every seed gives the same cloud, so one is enough
  bool is_full_size = true;  ///< false: smaller than the size for which marks without a reference were set
};

/// Every case. `is_quick`: a quarter of the points of shapes and images, and rooms at 0.2 and 0.4 degrees only.
std::vector<Case> scanCases(bool is_quick);

void addShapes(bool is_quick, std::vector<Case>& cases);  ///< surfaces with an analytic spectrum
void addRooms(bool is_quick, std::vector<Case>& cases);   ///< spinning scanners
void addDepthCamera(bool is_quick, std::vector<Case>& cases);
/// Real clouds, if their folders exist: depth images, and others for which only the guarantees are checked.
void addFiles(std::vector<Case>& cases);

}  // namespace tufted::bench
