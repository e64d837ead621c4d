#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "base/buffer.h"
#include "stars/offsets.h"

namespace tufted {

/// A place on a surface.
struct PlaceOnFaces {
  Eigen::Vector3d position, normal;
};

/// Smooth faces that meet in creases and corners around one point, found from noisy points. Positions are relative to
/// that point. Memory of one worker.
class CreaseModel {
 public:
  /// Normals of faces differ by more than the angle of this cosine, which is 40 degrees. A smooth surface that bends by
  /// as much within a window is told from a crease by isRounded() only.
  static constexpr double same_face = 0.77;

  /// Forgets all points.
  /// @param most of the points that will be added
  /// @param variance of the noise
  /// @param unit of lengths, about the extent of the points
  void start(int most, double variance, double unit);
  /// Points are added in ascending distance.
  /// @param normal of the surface there, zero where it is not known; its sign does not matter
  void add(const Eigen::RowVector3d& position, const Eigen::RowVector3d& normal);
  /// Groups the points by their normals, after all are added: each in turn joins the group whose normal is most like
  /// its own, or founds one.
  void group();
  /// Finds the faces. False where fewer than two of them explain the points by noise alone.
  /// @param count of the points that are looked at, the first ones
  bool fit(int count);
  /// The place on the faces, each of which ends where it meets others, that is nearest to the origin.
  PlaceOnFaces nearest() const;

 private:
  static constexpr int most_faces = 4;
  static constexpr int most_groups = 8;  ///< bevels between faces, which few points are on, are groups as well

  /// A quadratic over a plane, or a plane.
  struct Face {
    Eigen::Vector3d normal, first, second;  ///< of the plane
    std::array<double, 6> coefficient;      ///< of 1, u, v, u^2, u v, v^2, in units
    bool is_plane;
    Eigen::Vector3d tangent;           ///< the normal of the tangent plane next to the origin
    double height;                     ///< of the origin over the tangent plane
    std::array<int, most_faces> side;  ///< of each other face that this one lies on: 1 above, -1 below, 0 both
    Buffer<int> members;               ///< points that it is fitted through
    Buffer<double> heights;            ///< of all points over it
  };

  /// The largest of the groups that the first points make become faces. False where fewer than two do.
  bool startFaces();
  void joinClosest(const Eigen::Vector3d& normal, int group, int from, int to);
  bool fitFace(Face& face);
  void fitFaces();
  void findTangents();
  void measure();
  void drop(int f);
  void dropAlike();
  void findSides();
  void chooseMembers(int f);
  bool isRounded();
  bool isExplained() const;
  bool isOnFace(int f, const Eigen::Vector3d& x, unsigned meeting) const;
  Eigen::Vector3d meetingPlace(unsigned meeting) const;

  Eigen::Vector3d positionOf(int i) const { return {coordinates_[0][i], coordinates_[1][i], coordinates_[2][i]}; }
  int size() const { return size_; }

  double variance_ = 0, unit_ = 1;
  std::array<Buffer<double>, 3> coordinates_;
  /// The normals that are known, and which of the points have them.
  std::array<Buffer<double>, 3> normals_;
  Buffer<int> known_;
  std::array<int, most_groups> founders_;  ///< of the groups, among these points
  int groups_ = 0;
  Buffer<int> group_;       ///< of each of these points, its group, or -1
  Buffer<double> closest_;  ///< the cosine between its normal and that of the group
  Buffer<double> joined_;   ///< as group_, of those that are being made
  int points_ = 0;          ///< that were added
  int normals_known_ = 0;   ///< points whose normals are known
  int size_ = 0;            ///< points that are looked at
  int count_ = 0;           ///< faces
  std::array<Face, most_faces> faces_;
  OffsetBuffer offsets_;
  Buffer<std::uint8_t> is_member_;
  Buffer<double> room_;
};

}  // namespace tufted
