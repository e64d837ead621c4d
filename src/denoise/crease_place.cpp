#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <limits>

#include "denoise/crease_model.h"

namespace tufted {
namespace {

/// Whether face f is one of the `faces`, which are bits.
bool holdsFace(unsigned faces, int f) {
  return (faces >> f & 1U) != 0;
}

}  // namespace

/// @param meeting faces that x is on
bool CreaseModel::isOnFace(int f, const Eigen::Vector3d& x, unsigned meeting) const {
  for (int g = 0; g < count_; ++g)
    if (!holdsFace(meeting, g) && faces_[f].side[g] * (faces_[g].height + faces_[g].tangent.dot(x)) < 0) return false;
  return true;
}

/// The place nearest to the origin where the tangent planes of up to three faces meet; not finite where they do not.
Eigen::Vector3d CreaseModel::meetingPlace(unsigned meeting) const {
  std::array<const Face*, 3> of{};
  int n = 0;
  for (int f = 0; f < count_; ++f)
    if (holdsFace(meeting, f)) of[n++] = &faces_[f];
  const Face& a = *of[0];
  if (n == 1) return -a.height * a.tangent;
  const Face& b = *of[1];
  if (n == 2) {
    const double cosine = a.tangent.dot(b.tangent), squared_sine = 1 - cosine * cosine;
    return ((cosine * b.height - a.height) * a.tangent + (cosine * a.height - b.height) * b.tangent) / squared_sine;
  }
  const Face& c = *of[2];
  const Eigen::Vector3d across = b.tangent.cross(c.tangent);
  return -(a.height * across + b.height * c.tangent.cross(a.tangent) + c.height * a.tangent.cross(b.tangent)) /
         a.tangent.dot(across);
}

PlaceOnFaces CreaseModel::nearest() const {
  PlaceOnFaces best{Eigen::Vector3d::Zero(), faces_[0].tangent};
  double least = std::numeric_limits<double>::infinity();
  for (unsigned meeting = 1; meeting < 1U << count_; ++meeting) {
    if (std::popcount(meeting) > 3) continue;
    const Eigen::Vector3d x = meetingPlace(meeting);
    if (!(x.squaredNorm() < least)) continue;
    bool is_on_all = true;
    for (int f = 0; f < count_ && is_on_all; ++f) is_on_all = !holdsFace(meeting, f) || isOnFace(f, x, meeting);
    if (!is_on_all) continue;
    least = x.squaredNorm();
    best = {x, faces_[std::countr_zero(meeting)].tangent};
  }
  return best;
}

}  // namespace tufted
