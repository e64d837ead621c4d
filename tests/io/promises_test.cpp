// A Laplacian says in files what it is of, and one that breaks a promise is refused by its entry.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "field_values.h"
#include "laplacian_folder.h"
#include "odd_sphere.h"
#include "tufted/check.h"
#include "tufted/distance.h"
#include "tufted/gradient.h"

namespace promises_test {
namespace {

using tufted::Format;
using tufted::Kind;
using tufted::Laplacian;
using tufted::PointStatus;
using tufted::Sign;

/// A square of 8 x 8 quads that is bent upwards.
tufted::Geometry mesh() {
  constexpr int side = 9;
  tufted::Geometry geometry;
  geometry.is_mesh = true;
  geometry.points.resize(side * side, 3);
  geometry.triangles.resize(2 * (side - 1) * (side - 1), 3);
  geometry.width = side * side;
  for (int i = 0; i < side * side; ++i)
    geometry.points.row(i) << i % side, i / side, 0.05 * (i % side) * (i % side);  // NOLINT(bugprone-integer-division)
  for (int f = 0, row = 0; row + 1 < side; ++row) {
    for (int column = 0; column + 1 < side; ++column) {
      const int a = row * side + column;
      geometry.triangles.row(f++) << a, a + 1, a + side;
      geometry.triangles.row(f++) << a + 1, a + side + 1, a + side;
    }
  }
  return geometry;
}

class Promises : public LaplacianFolder {
 protected:
  void write(const Laplacian& laplacian, const tufted::Geometry& geometry, tufted::WriteOptions options = {}) const {
    options.formats = {Format::npz, Format::cover};
    tufted::writeLaplacian(dir_.path(), laplacian, geometry, options);
  }

  void changeReport(const std::function<void(nlohmann::ordered_json&)>& change) const {
    auto report = nlohmann::ordered_json::parse(readAll(dir_ / "report.json"));
    change(report);
    dir_.write("report.json", report.dump());
  }
};

tufted::VectorXd distances(const Laplacian& laplacian) {
  return tufted::DistanceSolver(laplacian).query({0});
}

TEST_F(Promises, DistancesAreTheSameWithAndWithoutFramesAfterARoundThroughFiles) {
  const tufted::Geometry square = mesh(), sphere = tufted::oddSphere(101);
  Laplacian framed = tufted::meshLaplacian(square.points, square.triangles);
  const tufted::VectorXd on_mesh = distances(framed);
  framed.frames = tufted::meshFrames(square.points, square.triangles);
  write(framed, square);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).kind, Kind::mesh);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).frames.normals.rows(), 81);
  EXPECT_EQ(distances(tufted::readLaplacian(dir_.path())), on_mesh);

  Laplacian bare = tufted::pointCloudLaplacian(sphere.points);
  const tufted::VectorXd on_cloud = distances(bare);
  bare.frames = {};
  write(bare, sphere);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).kind, Kind::cloud);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).frames.normals.rows(), 0);
  EXPECT_EQ(distances(tufted::readLaplacian(dir_.path())), on_cloud);
}

TEST_F(Promises, OfAnOlderFolderTheOptionsOfTheBuildSayWhatItIs) {
  const tufted::Geometry square = mesh(), sphere = tufted::oddSphere(101);
  const tufted::CloudOptions cloud_options;
  const tufted::MeshOptions mesh_options;
  const auto forget = [](nlohmann::ordered_json& report) { ASSERT_EQ(report.erase("kind"), 1u); };
  write(tufted::pointCloudLaplacian(sphere.points), sphere, {.cloud = &cloud_options});
  changeReport(forget);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).kind, Kind::cloud);
  write(tufted::meshLaplacian(square.points, square.triangles), square, {.mesh = &mesh_options});
  changeReport(forget);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).kind, Kind::mesh);
  write(tufted::pointCloudLaplacian(sphere.points), sphere);  // by a program of one's own
  changeReport(forget);
  EXPECT_EQ(refusal(),
            "report.json: does not say of what the cover is, must have \"kind\": \"cloud\" or \"kind\": \"mesh\"");
  EXPECT_FALSE(tufted::readLaplacian(dir_.path(), false).hasCover());
  changeReport([](nlohmann::ordered_json& report) { report["kind"] = "sphere"; });
  EXPECT_EQ(refusal(), "report.json: is of the kind '\"sphere\"', must be cloud or mesh");
}

TEST_F(Promises, ACloudAndItsDummiesAreReadWithEitherSign) {
  const tufted::Geometry sphere = tufted::oddSphere(101);
  const Laplacian laplacian = tufted::pointCloudLaplacian(sphere.points);
  for (const Sign sign : {Sign::psd, Sign::igl}) {
    for (const bool dummy : {false, true}) {
      write(laplacian, sphere, {.sign = sign, .dummy = dummy});
      EXPECT_EQ(refusal(), "");
      const Laplacian read = tufted::readLaplacian(dir_.path());
      EXPECT_EQ(tufted::VectorXd(read.L.coeffs()), tufted::VectorXd(laplacian.L.coeffs()));
      EXPECT_EQ(read.M, laplacian.M);
      EXPECT_EQ(tufted::validate(read).faults, std::vector<std::string>{});
    }
  }
}

struct Plant {
  const char* name;
  std::function<void(Laplacian&)> break_it;
  std::vector<std::string> refusal;  ///< parts of what the reader says
  const char* promise;               ///< that validate() finds broken
};

/// The first neighbour of point 0, which is active.
int neighbor(const Laplacian& laplacian) {
  for (tufted::SparseMatrix::InnerIterator entry(laplacian.L, 0); entry; ++entry)
    if (entry.row() != 0) return static_cast<int>(entry.row());
  return -1;
}

/// Scales L(0, j) and L(j, 0), whose rows then sum to something else.
void scaleWeight(Laplacian& laplacian, double factor) {
  const int j = neighbor(laplacian);
  laplacian.L.coeffRef(0, j) *= factor;
  laplacian.L.coeffRef(j, 0) *= factor;
}

std::vector<Plant> plants() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"Asymmetric",
       [](Laplacian& l) { l.L.coeffRef(neighbor(l), 0) *= 1 + 1e-15; },
       {"L.npz: L(", "must be equal"},
       "symmetry"},
      {"OneSideOnly",
       [](Laplacian& l) { l.L.prune([&](auto i, auto j, double) { return i != 0 || j != neighbor(l); }); },
       {"L.npz: L(", "= 0, ", "must be equal"},
       "symmetry"},
      {"Positive",
       [](Laplacian& l) { scaleWeight(l, -1); },
       {"L.npz: L(", "must not be above 0 off"},
       "off-diagonal sign"},
      {"WeightTimes1e-13More",
       [](Laplacian& l) { scaleWeight(l, 1 + 1e-13); },
       {"L.npz: row 0 sums to ", "beside L(0, 0) = ", "must sum to 0 within rounding"},
       "row sum"},
      {"Diagonal", [](Laplacian& l) { l.L.coeffRef(11, 11) *= 2; }, {"L.npz: row 11 sums to "}, "row sum"},
      {"NegativeDiagonal",
       [](Laplacian& l) { l.L.coeffRef(11, 11) *= -1; },
       {"L.npz: L(11, 11) = -", "above 0"},
       "positive diagonal"},
      {"NotFinite",
       [](Laplacian& l) { l.L.coeffRef(11, 11) = INFINITY; },
       {"L.npz: L(11, 11) = inf, must be finite"},
       "finite"},
      {"EntryOfNobody",
       [](Laplacian& l) {
         l.L.coeffRef(9, 9) = 2;
         l.L.makeCompressed();
       },
       {"L.npz: L(9, 9) = 2, must be 0: by status.npy point 9 is not active"},
       "inactive is zero"},
      {"ActiveWithoutEntry",
       [](Laplacian& l) { l.status[9] = PointStatus::active; },
       {"L.npz: L(9, 9) = 0, must be above 0: by status.npy point 9 is active"},
       "positive diagonal"},
      {"InactiveWithEntries",
       [](Laplacian& l) { l.status[0] = PointStatus::isolated; },
       {"L.npz: L(0, 0) = ", "must be 0: by status.npy point 0 is not active"},
       "inactive is zero"},
      {"NegativeMass", [](Laplacian& l) { l.M[5] = -1; }, {"M.npy: M(5) = -1, must be finite and at least 0"}, "mass"},
      {"MassNotANumber", [](Laplacian& l) { l.M[5] = nan; }, {"M.npy: M(5) = nan, must be finite"}, "finite"},
      {"MassOfNobody", [](Laplacian& l) { l.M[9] = 1; }, {"M.npy: M(9) = 1, must be 0"}, "inactive is zero"},
      {"CopyOfALaterPoint",
       [](Laplacian& l) { l.representative[7] = 8; },
       {"representative.npy: point 7 names 8, must name an earlier one"},
       "representative"},
      {"CopyOfNothing",
       [](Laplacian& l) { l.representative[8] = 3; },
       {"representative.npy: point 8 names 3, must name itself"},
       "representative"},
      {"EndOfNoSurface",
       [](Laplacian& l) { l.boundary[9] = tufted::Boundary::rim; },
       {"boundary.npy: point 9 has 1, must have 0"},
       "boundary"},
      {"PositionNowhere",
       [](Laplacian& l) { l.positions(5, 1) = nan; },
       {"measured_positions.npy: the position of point 5 is not finite"},
       "position"},
  };
}

TEST_F(Promises, WhatBreaksOneIsRefusedByItsEntryAndNamedByValidate) {
  const tufted::Geometry sphere = tufted::oddSphere(101);
  const Laplacian laplacian = tufted::pointCloudLaplacian(sphere.points);
  for (const Plant& plant : plants()) {
    Laplacian broken = laplacian;
    plant.break_it(broken);
    for (const Sign sign : {Sign::psd, Sign::igl}) {
      write(broken, sphere, {.sign = sign});
      for (const std::string& part : plant.refusal)
        EXPECT_NE(refusal().find(part), std::string::npos) << plant.name << ": '" << refusal() << "' lacks " << part;
      const auto faults = tufted::validate(tufted::readUncheckedLaplacian(dir_.path())).faults;
      const bool found = std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
        return fault.starts_with(std::string(plant.promise) + ": ");
      });
      EXPECT_TRUE(found) << plant.name << ": " << testing::PrintToString(faults);
    }
  }
}

TEST_F(Promises, AreJudgedBehindDummies) {
  const tufted::Geometry sphere = tufted::oddSphere(101);
  Laplacian broken = tufted::pointCloudLaplacian(sphere.points);
  scaleWeight(broken, 2);
  for (const Sign sign : {Sign::psd, Sign::igl}) {
    write(broken, sphere, {.sign = sign, .dummy = true});
    EXPECT_TRUE(refusal().starts_with("L.npz: row 0 sums to ")) << refusal();
  }
}

TEST_F(Promises, AReportOfAnotherCloudIsRefused) {
  const tufted::Geometry sphere = tufted::oddSphere(101);
  write(tufted::pointCloudLaplacian(sphere.points), sphere);
  changeReport([](nlohmann::ordered_json& report) { report["report"]["points"] = 100; });
  EXPECT_EQ(refusal(), "report.json: counts 100 points, and L has 200 rows");
}

TEST_F(Promises, FailuresThatOnlyTheReportKnowsReachValidate) {
  const tufted::Geometry sphere = tufted::oddSphere(101);
  Laplacian laplacian = tufted::pointCloudLaplacian(sphere.points);
  laplacian.report.flip_failures = 2;
  laplacian.report.clamped_large = 1;
  write(laplacian, sphere);
  EXPECT_EQ(tufted::validate(tufted::readLaplacian(dir_.path())).faults, tufted::validate(laplacian).faults);
  EXPECT_EQ(tufted::validate(laplacian).faults.size(), 1u);
}

}  // namespace
}  // namespace promises_test
