#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shapes/shapes.h"
#include "tufted/laplacian.h"

/// The table of real scans: cases (a dataset each) have metrics, each of which is one row per variant of the build.
namespace tufted::bench {

/// Which structure of the scan finds the neighbours.
enum class Neighbors { searched, image, rings };

/// A way to build; the first of the table is the one that others are compared with.
struct Variant {
  std::string name;
  CloudOptions options;
  Neighbors neighbors = Neighbors::searched;
};

/// A cloud with its truth.
struct Sample {
  shapes::Cloud cloud;
  shapes::ScanTruth truth{};                   ///< rooms only: of the same rays without noise
  shapes::ImageEdges edges{};                  ///< depth images only: of the same pixels, all seen and not rounded
  std::optional<Eigen::Vector3d> viewpoint{};  ///< told to the build

  /// Whether it has what a variant finds neighbours by.
  bool has(Neighbors neighbors) const;
};

/// One build of one sample.
class Build {
 public:
  /// @param sample borrowed
  /// @param core the build of the first variant; null for that one itself
  Build(const Sample& sample, const Variant& variant, const Build* core);

  const Sample& sample() const { return sample_; }
  const shapes::Cloud& cloud() const { return sample_.cloud; }
  const Laplacian& laplacian() const { return laplacian_; }
  const Build& core() const { return core_ == nullptr ? *this : *core_; }
  double seconds() const { return seconds_; }
  /// Seconds of all steps up to the neighbours of each point, without its plane.
  double searchSeconds() const;
  /// The union of stars, see unionOfStars(); computed when first asked for.
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

/// What the mean over the seeds must hold: the rule applied to `factor` times the reference's mean plus `value`.
struct Mark {
  enum class Rule { none, at_most, at_least, off_by_at_most };  ///< the last one compares the mean distance from 0
  enum class Reference { none, core, yardstick };

  Rule rule = Rule::none;
  double value = 0;
  Reference reference = Reference::none;
  double factor = 1;
  double stretch = std::numeric_limits<double>::quiet_NaN();  ///< a further value, wished for
  std::string variant = "scan";                               ///< the one the mark is for; "all": every one
  bool at_any_size = false;                                   ///< not only at the size of the cloud that it was set for
};

enum class Format { scientific, percent, signed_percent, count, seconds };

/// What the metric is compared with: a figure of the sample alone.
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
  std::string what;     ///< row of "What must be shown"
  std::string dataset;  ///< with its size
  std::function<Sample(std::uint64_t seed)> make;
  std::vector<Metric> metrics;
  bool is_random = true;     ///< false: every seed gives the same cloud, so one is enough
  bool is_full_size = true;  ///< false: smaller than the size that marks without a reference were set for
};

/// Every case. `is_quick`: a quarter of the points of shapes and images, and rooms at 0.2 and 0.4 degrees only.
std::vector<Case> scanCases(bool is_quick);

void addShapes(bool is_quick, std::vector<Case>& cases);  ///< surfaces with an analytic spectrum
void addRooms(bool is_quick, std::vector<Case>& cases);   ///< spinning scanners
void addDepthCamera(bool is_quick, std::vector<Case>& cases);
/// Real clouds, where their folders are present: depth images, and others for the guarantees alone.
void addFiles(std::vector<Case>& cases);

}  // namespace tufted::bench
