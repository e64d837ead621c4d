#include "denoise/crease_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "denoise/quadratic_fit.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr int least_members = 12;      // four times as many points as a plane has coefficients
constexpr int least_curved = 24;       // four times as many as a quadratic has
constexpr double least_bend = 4;       // chi squared that the quadratic's three further coefficients have to explain
constexpr int member_rounds = 2;       // of choosing members and fitting; a third changes nothing
constexpr double ambiguous = 2;        // sigmas: points nearer to a crease may belong to either face
constexpr double member_height = 3;    // sigmas from a face, farther points are not of it
constexpr double lesser_side = 0.1;    // of the points, that noise alone may put on the other side of a face that ends
constexpr double most_rounded = 1;     // sigmas of a mean; points next to a crease lie on its outer side
constexpr double well_modelled = 1.6;  // of the noise's variance, that of the distances; small faces may be missed

/// The unit normals of some points.
struct KnownNormals {
  const double *x, *y, *z;

  explicit KnownNormals(const std::array<Buffer<double>, 3>& axes)
      : x(axes[0].data()), y(axes[1].data()), z(axes[2].data()) {}
  Eigen::Vector3d operator[](int i) const { return {x[i], y[i], z[i]}; }
};

}  // namespace

void CreaseModel::start(int most, double variance, double unit) {
  variance_ = variance;
  unit_ = unit;
  points_ = normals_known_ = 0;
  const auto room = static_cast<std::size_t>(most);
  if (known_.size() >= room) return;
  for (Buffer<double>& coordinate : coordinates_) coordinate.resize(room);
  for (Buffer<double>& coordinate : normals_) coordinate.resize(room);
  known_.resize(room);
}

void CreaseModel::add(const Eigen::RowVector3d& position, const Eigen::RowVector3d& normal) {
  for (int axis = 0; axis < 3; ++axis) coordinates_[axis][points_] = position[axis];
  const int i = points_++;
  if (normal.isZero(0)) return;
  for (int axis = 0; axis < 3; ++axis) normals_[axis][normals_known_] = normal[axis];
  known_[normals_known_++] = i;
}

/// Points whose normals are more like this one than like that of their group join this group.
void CreaseModel::joinClosest(const Eigen::Vector3d& normal, int group, int from, int to) {
  const KnownNormals normals(normals_);
  const double x = normal[0], y = normal[1], z = normal[2];
  double* const closest = closest_.data();
  double* const joined = joined_.data();  // numbers as wide as the cosines, which are chosen along with them
  const double number = group;
  for (int i = from; i < to; ++i) {
    const double cosine = std::abs(normals.x[i] * x + (normals.y[i] * y + normals.z[i] * z));
    const double is_closer = cosine > closest[i] ? 1 : 0;  // a factor and no branch, so that packets are computed
    closest[i] = cosine > closest[i] ? cosine : closest[i];
    joined[i] += is_closer * (number - joined[i]);
  }
}

void CreaseModel::group() {
  const int n = normals_known_;
  joined_.assign(static_cast<std::size_t>(n), -1);
  closest_.assign(static_cast<std::size_t>(n), same_face);
  groups_ = 0;
  for (int founder = 0; founder < n && groups_ < most_groups; ++founder) {
    if (joined_[founder] >= 0) continue;
    joinClosest(KnownNormals(normals_)[founder], groups_, founder, n);
    joined_[founder] = groups_;  // also where rounding would not have it
    founders_[groups_++] = founder;
  }
  group_.assign(joined_.begin(), joined_.end());
}

bool CreaseModel::startFaces() {
  const KnownNormals normals(normals_);
  const auto end =
      static_cast<int>(std::lower_bound(known_.begin(), known_.begin() + normals_known_, size()) - known_.begin());
  std::array<int, most_groups + 1> counts{};  // the first is of those of no group
  for (int i = 0; i < end; ++i) ++counts[group_[i] + 1];
  std::array<int, most_groups> largest{};
  count_ = 0;
  for (int g = 0; g < groups_; ++g) {
    if (counts[g + 1] < least_members) continue;
    int at = count_++;  // the largest first, in their order
    for (; at > 0 && counts[largest[at - 1] + 1] < counts[g + 1]; --at) largest[at] = largest[at - 1];
    largest[at] = g;
  }
  if (count_ < 2) return false;
  count_ = std::min(count_, most_faces);
  std::array<Eigen::Vector3d, most_groups + 1> sums;
  sums.fill(Eigen::Vector3d::Zero());
  std::array<Eigen::Vector3d, most_groups + 1> first;
  first[0].setZero();
  for (int g = 0; g < groups_; ++g) first[g + 1] = normals[founders_[g]];
  for (int i = 0; i < end; ++i) {
    const int g = group_[i] + 1;
    const Eigen::Vector3d normal = normals[i];
    sums[g] += std::copysign(1, first[g].dot(normal)) * normal;
  }
  std::fill_n(joined_.begin(), end, -1);
  std::fill_n(closest_.begin(), end, same_face);
  for (int f = 0; f < count_; ++f) {
    faces_[f].normal = sums[largest[f] + 1].normalized();
    faces_[f].members.clear();
    joinClosest(faces_[f].normal, f, 0, end);
  }
  for (int i = 0; i < end; ++i)
    if (joined_[i] >= 0) faces_[static_cast<int>(joined_[i])].members.push_back(known_[i]);
  return true;
}

/// A plane through the members, which is far steadier at its rim than a quadratic, or where they bend, a mean of both.
bool CreaseModel::fitFace(Face& face) {
  const auto count = static_cast<int>(face.members.size());
  if (count < least_members) return false;
  face.first = tangentOf(face.normal);
  face.second = face.normal.cross(face.first);
  offsets_.fill(count, [&](int i) -> Eigen::RowVector3d { return positionOf(face.members[i]).transpose(); });
  HeightMoments moments = heightMoments(offsets_.view(), face.normal, unit_);
  moments.count = count;  // the origin counts only if it is a member
  const HeightSums& s = moments.sums;
  Eigen::Matrix3d gram;
  gram << count, s.u, s.v, s.u, s.uu, s.uv, s.v, s.uv, s.vv;
  const Eigen::Vector3d right(s.h, s.hu, s.hv), plane = gram.ldlt().solve(right);
  if (!plane.allFinite()) return false;
  // The more of the plane's residuals a quadratic explains, in units of the noise, the more it counts (the estimator of
  // James and Stein). A decision for either would move one point by this one and the next by that one.
  const double residual = (s.hh - plane.dot(right)) * unit_ * unit_;
  if (count >= least_curved && residual > least_bend * variance_) {
    HeightFit fit;
    fitHeights({&moments, 1}, {&fit, 1});
    const double gain = residual - fit.variance * static_cast<double>(count - std::ssize(fit.coefficient));
    if (fit.is_valid && gain > least_bend * variance_) {
      const double share = 1 - least_bend * variance_ / gain;
      for (int j = 0; j < std::ssize(face.coefficient); ++j)
        face.coefficient[j] = share * fit.coefficient[j] + (j < 3 ? (1 - share) * plane[j] : 0);
      face.is_plane = false;
      return true;
    }
  }
  const Eigen::Vector3d across = face.normal - plane[1] * face.first - plane[2] * face.second;
  const double length = across.norm();
  face.normal = across / length;
  face.coefficient = {plane[0] / length};
  face.is_plane = true;
  return true;
}

void CreaseModel::fitFaces() {
  for (int f = count_ - 1; f >= 0; --f)
    if (!fitFace(faces_[f])) drop(f);
}

/// Finds the tangent planes next to the origin.
void CreaseModel::findTangents() {
  for (Face& face : std::span(faces_).first(count_)) {
    const auto& c = face.coefficient;
    face.tangent = face.normal;
    face.height = -unit_ * c[0];
    if (face.is_plane) continue;
    const Eigen::Vector3d across = face.normal - c[1] * face.first - c[2] * face.second;
    const double length = across.norm();
    face.tangent = across / length;
    face.height /= length;
  }
}

/// Takes the heights of all points over the faces.
void CreaseModel::measure() {
  const double *const x = coordinates_[0].data(), *const y = coordinates_[1].data(), *const z = coordinates_[2].data();
  const int n = size();
  const double unit = unit_;
  for (Face& face : std::span(faces_).first(count_)) {
    face.heights.resize(static_cast<std::size_t>(n));
    double* const heights = face.heights.data();
    const std::array<double, 6> c = face.coefficient;
    const Eigen::Vector3d normal = face.normal, first = face.first, second = face.second;
    for (int i = 0; i < n; ++i) heights[i] = x[i] * normal[0] + y[i] * normal[1] + z[i] * normal[2] - unit * c[0];
    if (face.is_plane) continue;
    for (int i = 0; i < n; ++i) {
      const double px = x[i] / unit, py = y[i] / unit, pz = z[i] / unit;
      const double u = px * first[0] + (py * first[1] + pz * first[2]);
      const double v = px * second[0] + (py * second[1] + pz * second[2]);
      heights[i] -= unit * (c[1] * u + c[2] * v + c[3] * u * u + c[4] * u * v + c[5] * v * v);
    }
  }
}

void CreaseModel::drop(int f) {
  std::rotate(faces_.begin() + f, faces_.begin() + f + 1, faces_.begin() + count_);
  --count_;
}

/// Leaves out the lesser of two faces that are alike.
void CreaseModel::dropAlike() {
  const auto is_larger = [](const Face& a, const Face& b) { return a.members.size() > b.members.size(); };
  for (int f = 1; f < count_; ++f)
    for (int g = f; g > 0 && is_larger(faces_[g], faces_[g - 1]); --g) std::swap(faces_[g], faces_[g - 1]);
  for (int f = 0; f < count_; ++f)
    for (int g = count_ - 1; g > f; --g)
      if (std::abs(faces_[f].tangent.dot(faces_[g].tangent)) > same_face) drop(g);
}

/// Finds on which side of the others each face lies, by the points on it that are clear of the others.
void CreaseModel::findSides() {
  const double bound = member_height * std::sqrt(variance_);
  for (int f = 0; f < count_; ++f)
    for (int g = 0; g < count_; ++g) {
      if (f == g) continue;
      const double *const own = faces_[f].heights.data(), *const other = faces_[g].heights.data();
      int above = 0, below = 0;
      for (int i = 0, n = size(); i < n; ++i) {
        const int is_on = std::abs(own[i]) <= bound ? 1 : 0;
        above += is_on & (other[i] > bound ? 1 : 0);
        below += is_on & (other[i] < -bound ? 1 : 0);
      }
      const double few = lesser_side * (above + below);
      faces_[f].side[g] = below < few ? 1 : above < few ? -1 : 0;
    }
}

/// Takes as members the points on a face that are clear of its creases. How far along the face a point lies says
/// nothing about its noise across it, so the choice has no bias, as the nearest points would have.
void CreaseModel::chooseMembers(int f) {
  const double sigma = std::sqrt(variance_);
  Face& face = faces_[f];
  const int n = size();
  room_.resize(static_cast<std::size_t>(n));
  double* const room = room_.data();
  const double* const height = face.heights.data();
  for (int i = 0; i < n; ++i) room[i] = member_height * sigma - std::abs(height[i]);
  for (int g = 0; g < count_; ++g) {
    if (g == f) continue;
    const double cosine = face.tangent.dot(faces_[g].tangent), sine = std::sqrt(1 - cosine * cosine);
    const double least = ambiguous * sigma * sine;
    const double* const other = faces_[g].heights.data();
    const auto keep_clear = [&](const auto& from_crease) {
      for (int i = 0; i < n; ++i) {
        const double left = from_crease(other[i] - height[i] * cosine) - least;  // distances times the sine
        room[i] = left < room[i] ? left : room[i];
      }
    };
    if (face.side[g] == 0)
      keep_clear([](double distance) { return std::abs(distance); });
    else
      keep_clear([side = static_cast<double>(face.side[g])](double distance) { return side * distance; });
  }
  face.members.resize(static_cast<std::size_t>(n));
  int count = 0;
  for (int i = 0; i < n; ++i) {
    face.members[count] = i;
    count += room[i] > 0 ? 1 : 0;
  }
  face.members.resize(static_cast<std::size_t>(count));
}

/// Whether the points next to the creases, through which no face is fitted, lie within them: around a bend. Noise alone
/// puts them a little outside.
bool CreaseModel::isRounded() {
  std::array<int, most_faces> inner{};  // the side of each face that all others are on
  for (int f = 0; f < count_; ++f)
    for (int g = 0; g < count_; ++g) {
      if (f == g) continue;
      const int side = faces_[g].side[f];
      if (side == 0 || inner[f] == -side) return false;  // no convex body, nor the hollow of one
      inner[f] = side;
    }
  is_member_.assign(static_cast<std::size_t>(size()), 0);
  for (const Face& face : std::span(faces_).first(count_))
    for (const int i : face.members) is_member_[i] = 1;
  const double bound = member_height * std::sqrt(variance_);
  double sum = 0;
  int n = 0;
  for (int i = 0; i < size(); ++i) {
    if (is_member_[i] != 0) continue;
    double depth = bound;
    for (int f = 0; f < count_; ++f) depth = std::min(depth, inner[f] * faces_[f].heights[i]);
    sum += std::max(depth, -bound);
    ++n;
  }
  return sum > 0 && sum * sum > most_rounded * most_rounded * variance_ * n;
}

bool CreaseModel::isExplained() const {
  double sum = 0;
  for (int i = 0; i < size(); ++i) {
    double least = std::abs(faces_[0].heights[i]);
    for (int f = 1; f < count_; ++f) least = std::min(least, std::abs(faces_[f].heights[i]));
    sum += least * least;
  }
  return sum < well_modelled * variance_ * size();
}

bool CreaseModel::fit(int count) {
  size_ = std::min(count, points_);
  if (!startFaces()) return false;
  fitFaces();
  for (int round = 0;; ++round) {
    findTangents();
    dropAlike();
    if (count_ < 2) return false;
    measure();
    findSides();
    if (round == member_rounds) break;
    for (int f = 0; f < count_; ++f) chooseMembers(f);
    fitFaces();
  }
  return isExplained() && !isRounded();
}

}  // namespace tufted
