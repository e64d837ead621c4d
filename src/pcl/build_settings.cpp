#include "tufted/pcl/build_settings.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>

#include "tufted/errors.h"
#include "tufted/pcl/impl/say_warnings.hpp"

namespace tufted {

std::optional<ScanStructure> detail::pixelsOf(const CloudInput& input, OrganizedSearch organized) {
  if (organized == OrganizedSearch::off) return std::nullopt;
  if (organized == OrganizedSearch::on && input.height <= 1) {
    throw InvalidInput("setOrganizedSearch: the input has height " + std::to_string(input.height) +
                       ", must be more than 1 for an organized cloud");
  }
  if (organized == OrganizedSearch::automatic &&
      (input.height <= 1 || !isDepthImage(input.points, input.width, input.height, input.sensor))) {
    return std::nullopt;
  }
  ScanStructure whole = imageStructure(input.width, input.height, input.sensor);
  if (input.indices == nullptr) return whole;
  ScanStructure structure{.row = {}, .position = {}, .has_rings = false, .origin = whole.origin};
  for (const pcl::index_t i : *input.indices) {
    structure.row.push_back(whole.row.at(i));
    structure.position.push_back(whole.position.at(i));
  }
  return structure;
}

bool detail::reported(const std::string& class_name, const char* method, const std::function<void()>& call) {
  try {
    call();
    return true;
  } catch (const std::exception& error) {
    PCL_ERROR("[tufted::%s::%s] %s\n", class_name.c_str(), method, error.what());
    return false;
  }
}

void detail::refuseSearches(double radius, bool has_search_surface) {
  if (radius != 0)
    throw InvalidInput("setRadiusSearch: radius = " + std::to_string(radius) +
                       ", must be 0, as a surface is found by k neighbours");
  if (has_search_surface)
    throw InvalidInput("setSearchSurface: is another cloud, must be the input or null; see setSurface and setIndices");
}

bool detail::hasValues(const Laplacian& laplacian, int i) {
  return laplacian.status[laplacian.representative[i]] == PointStatus::active;
}

detail::PointValues detail::rowsOf(const Laplacian& laplacian, const PointValues& values, const pcl::Indices& indices,
                                   bool& all) {
  PointValues rows(static_cast<Eigen::Index>(indices.size()), values.cols());
  all = true;
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const pcl::index_t i = indices[static_cast<std::size_t>(r)];
    const bool has_values = hasValues(laplacian, i);
    if (has_values) rows.row(r) = values.row(i);
    if (!has_values) rows.row(r).setConstant(std::numeric_limits<float>::quiet_NaN());
    all = all && has_values;
  }
  return rows;
}

namespace {

template <class T>
std::optional<T> copyOf(const T* borrowed) {
  return borrowed == nullptr ? std::nullopt : std::optional<T>(*borrowed);
}

template <class T>
const T* pointerTo(const std::optional<T>& owned) {
  return owned ? &*owned : nullptr;
}

}  // namespace

void BuildSettings::setOptions(const CloudOptions& options) {
  // The options may be those of getOptions(), which borrow from this object.
  auto normals = copyOf(options.normals);
  auto neighborhoods = copyOf(options.neighborhoods);
  auto structure = copyOf(options.structure);
  auto viewpoint = copyOf(options.viewpoint);
  normals_ = std::move(normals);
  neighborhoods_ = std::move(neighborhoods);
  structure_ = std::move(structure);
  viewpoint_ = viewpoint;
  options_ = options;
  options_.normals = nullptr;
  options_.neighborhoods = nullptr;
  options_.structure = nullptr;
  options_.viewpoint = nullptr;
}

CloudOptions BuildSettings::getOptions() const {
  CloudOptions options = options_;
  options.neighbors = neighbors_.value_or(options.neighbors);
  options.threads = threads_.value_or(options.threads);
  options.normals = pointerTo(normals_);
  options.neighborhoods = pointerTo(neighborhoods_);
  options.structure = pointerTo(structure_);
  options.viewpoint = pointerTo(viewpoint_);
  return options;
}

const Eigen::Vector3d* BuildSettings::viewpointOf(const detail::CloudInput& input) const {
  return viewpoint_ ? &*viewpoint_ : input.height > 1 ? &input.sensor : nullptr;
}

void BuildSettings::withOptions(const detail::CloudInput& input,
                                const std::function<void(const PointsRef&, const CloudOptions&)>& build) const {
  CloudOptions options = getOptions();
  std::optional<ScanStructure> pixels;
  const bool is_set = options.neighborhoods != nullptr || options.structure != nullptr;
  if (!input.neighborhoods && !(is_set && organized_ == OrganizedSearch::automatic)) {
    pixels = detail::pixelsOf(input, organized_);
  }
  if (input.neighborhoods || pixels) {
    options.neighborhoods = pointerTo(input.neighborhoods);
    options.structure = pointerTo(pixels);
  }
  options.viewpoint = viewpointOf(input);
  if (input.indices == nullptr) return build(input.points, options);
  const Points points = input.points(*input.indices, Eigen::all);
  build(points, options);
}

std::shared_ptr<const Laplacian> BuildSettings::build(const detail::CloudInput& input) {
  // Results share the ownership of their builder, so a builder that is owned once is free. Of the free ones one is
  // kept: who holds the last frame until the next one is built makes two builders take turns.
  const auto isFree = [](const std::shared_ptr<LaplacianBuilder>& builder) { return builder.use_count() == 1; };
  const auto free = std::find_if(builders_.begin(), builders_.end(), isFree);
  std::shared_ptr<LaplacianBuilder> builder;
  if (free == builders_.end()) {
    builder = std::make_shared<LaplacianBuilder>();
  } else {
    std::atomic_thread_fence(std::memory_order_acquire);  // after the last read of a result by another thread
    builder = std::move(*free);
    builders_.erase(free);
  }
  std::erase_if(builders_, isFree);
  builders_.push_back(builder);
  const Laplacian* result = nullptr;
  withOptions(input, [&](const PointsRef& points, const CloudOptions& options) {
    result = &builder->pointCloud(points, options);
  });
  return {builder, result};
}

const Laplacian& SurfaceSettings::surfaceOf(const std::string& class_name, const detail::CloudInput& input) {
  used_.reset();
  if (given_ == nullptr) {
    used_ = build(input);
    detail::sayWarnings(class_name, used_->report);
    return *used_;
  }
  if (given_->M.size() != input.points.rows()) {
    throw InvalidInput("setSurface: the Laplacian has " + std::to_string(given_->M.size()) + " rows, must have " +
                       std::to_string(input.points.rows()) + ", one per point of the input");
  }
  used_ = given_;
  return *used_;
}

}  // namespace tufted
