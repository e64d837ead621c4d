// What a caller is told: by the function that was called, with the value, the rule or what to change.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::failures_test {
namespace {

using Eigen::MatrixXd;

/// Everything that takes a Laplacian, by the name that errors begin with.
struct Caller {
  std::string function;
  std::function<void(const Laplacian&)> call;
};
std::vector<Caller> callers(const Points& points) {
  static const Spectrum spectrum_of = spectrum(pointCloudLaplacian(points), 3);
  const Pins pins{{0}, MatrixXd::Ones(1, 1)};
  const MatrixXd one = MatrixXd::Ones(points.rows(), 1);
  return {{"Solver::laplacian", [](const Laplacian& laplacian) { Solver::laplacian(laplacian); }},
          {"spectrum", [](const Laplacian& laplacian) { spectrum(laplacian, 3); }},
          {"filterSignals", [=](const Laplacian& laplacian) { filterSignals(laplacian, spectrum_of, one); }},
          {"DistanceSolver",
           [](const Laplacian& laplacian) { DistanceSolver solver(laplacian, {.method = DistanceMethod::heat}); }},
          {"harmonic", [=](const Laplacian& laplacian) { harmonic(laplacian, pins); }},
          {"biharmonic", [=](const Laplacian& laplacian) { biharmonic(laplacian, pins); }},
          {"poisson", [=](const Laplacian& laplacian) { poisson(laplacian, one); }},
          {"poisson", [=](const Laplacian& laplacian) { poisson(laplacian, one, pins); }},
          {"greensFunction", [](const Laplacian& laplacian) { greensFunction(laplacian, {0}); }},
          {"smooth", [=](const Laplacian& laplacian) { smooth(laplacian, points); }},
          {"nearestPoint",
           [=](const Laplacian& laplacian) {
             nearestPoint(laplacian, points, {0, 0, 0});
           }},
          {"nearestPoints", [=](const Laplacian& laplacian) { nearestPoints(laplacian, points, points); }},
          {"gradients", [=](const Laplacian& laplacian) { gradients(laplacian, points); }}};
}

TEST(EveryFunction, RefusesALaplacianWhoseMembersDoNotFit) {
  const Points points = shapes::sphere(100).points;
  const Laplacian whole = pointCloudLaplacian(points);
  const std::vector<std::pair<std::string, std::function<void(Laplacian&)>>> faults = {
      {"rows of L = 99", [](Laplacian& torn) { torn.L = SparseMatrix(torn.L.topRows(99)); }},
      {"columns of L = 99", [](Laplacian& torn) { torn.L = SparseMatrix(torn.L.leftCols(99)); }},
      {"size of M = 99", [](Laplacian& torn) { torn.M.conservativeResize(99); }},
      {"size of representative = 101", [](Laplacian& torn) { torn.representative.push_back(100); }},
      {"size of boundary = 0", [](Laplacian& torn) { torn.boundary.clear(); }},
      {"size of cover_areas = 7", [](Laplacian& torn) { torn.cover_areas.resize(7); }},
      {"rows of frames.normals = 99", [](Laplacian& torn) { torn.frames.normals.conservativeResize(99, 3); }},
      {"rows of frames.tangents = 99", [](Laplacian& torn) { torn.frames.tangents.conservativeResize(99, 3); }},
      {"representative of point 3 = -1", [](Laplacian& torn) { torn.representative[3] = -1; }},
      {"representative of point 3 = 100", [](Laplacian& torn) { torn.representative[3] = 100; }},
      {"representative of point 5 = 4",
       [](Laplacian& torn) { torn.representative[5] = 4, torn.representative[4] = 3; }},
      {"vertices of the cover = 4", [](Laplacian& torn) {
         const shapes::Mesh other = shapes::tetrahedron();
         torn.cover_source = meshLaplacian(other.points, other.triangles).cover_source;
       }}};
  for (const Caller& caller : callers(points)) {
    const std::string& function = caller.function;
    EXPECT_EQ(support::refusal([&] { caller.call(whole); }), "accepted") << function;
    for (const auto& [what, plant] : faults) {
      Laplacian torn = whole;
      plant(torn);
      const std::string said = support::refusal([&] { caller.call(torn); });
      EXPECT_EQ(said.find(function + ": " + what + ", must "), 0) << said;
    }
  }
}

TEST(DistanceSolver, RefusesACoverOfOtherPoints) {
  const shapes::Mesh mesh = shapes::gridSquare(4);
  Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  IntrinsicTriangulation cover = laplacian.cover();
  cover.faces[3][1] = 25;
  laplacian.setCover(cover);
  EXPECT_EQ(support::refusal([&] { DistanceSolver solver(laplacian); }),
            "DistanceSolver: cover has the corner 25, must lie in [0, 25)");
  cover = meshLaplacian(mesh.points, mesh.triangles).cover();
  Laplacian of_stars = pointCloudLaplacian(shapes::sphere(40).points);
  of_stars.cover_source = pointCloudLaplacian(shapes::sphere(60).points).cover_source;
  EXPECT_EQ(support::refusal([&] { DistanceSolver solver(of_stars); }),
            "DistanceSolver: cover has 60 vertices, must have 40");
  cover.length.pop_back();
  laplacian.setCover(cover);
  EXPECT_EQ(support::refusal([&] { DistanceSolver solver(laplacian); }).find("DistanceSolver: cover has"), 0);
}

std::string failure(const std::function<void()>& call) {
  return support::refusal<SolverFailure>(call);
}

TEST(SolverFailure, NamesTheFunctionThatWasCalledAndTheMatrix) {
  const Points points = shapes::sphere(100).points;
  Laplacian negative = pointCloudLaplacian(points), nan = negative;
  negative.L *= -100;
  nan.L.coeffRef(7, 7) = NAN;
  for (const Caller& caller : callers(points)) {
    const std::string& function = caller.function;
    if (function == "filterSignals" || function.starts_with("nearestPoint") || function == "gradients") continue;
    for (const Laplacian* wrong : {&negative, &nan}) {
      if (wrong == &negative && function == "biharmonic") continue;  // whose matrix has a square of L
      const std::string said = failure([&] { caller.call(*wrong); });
      EXPECT_EQ(said.find(function + ": "), 0) << said;
      EXPECT_NE(said.find("; validate() names what is wrong with the Laplacian"), std::string::npos) << said;
      EXPECT_EQ(said.find("Solver::", 1), std::string::npos) << said;
    }
    EXPECT_NE(failure([&] { caller.call(nan); }).find("not finite"), std::string::npos) << function;
  }
}

TEST(SolverFailure, SaysWhatToChangeWhereIterationsDoNotSuffice) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(4000).points);
  const SolverOptions few = {.method = SolverMethod::multigrid, .max_iterations = 2};
  const Pins pins{{0, 1}, Eigen::VectorXd{{0, 1}}};
  const DistanceSolver distance(laplacian, {.method = DistanceMethod::heat, .solver = few});
  const Solver solver = Solver::laplacian(laplacian, few);
  const std::vector<std::pair<std::string, std::function<void()>>> calls = {
      {"Solver::solve", [&] { solver.solve(VectorXd(laplacian.L.col(0))); }},
      {"DistanceSolver::query", [&] { distance.query({0}); }},
      {"harmonic", [&] { harmonic(laplacian, pins, few); }},
      {"poisson", [&] { poisson(laplacian, Eigen::MatrixXd(laplacian.L.col(0)), few); }},
      {"poisson", [&] { poisson(laplacian, Eigen::MatrixXd(laplacian.L.col(0)), pins, few); }},
      {"greensFunction", [&] { greensFunction(laplacian, {0}, few); }}};
  for (const auto& [function, call] : calls) {
    const std::string said = failure(call);
    EXPECT_EQ(said.find(function + ": |b - A x| / |b| is "), 0) << said;
    EXPECT_NE(said.find(" after 2 iterations of multigrid on "), std::string::npos) << said;
    EXPECT_NE(said.find("raise max_iterations"), std::string::npos) << said;
    EXPECT_NE(said.find("SolverMethod::cholesky"), std::string::npos) << said;
    EXPECT_EQ(said.find("0.000000"), std::string::npos) << said;
  }
  const std::string said = failure([&] { spectrum(laplacian, 40, {.max_iterations = 2}); });
  EXPECT_EQ(said,
            "spectrum: max_iterations = 2 do not suffice for 39 eigenvalues to a tolerance of 1e-10; raise either");
}

TEST(SolverFailure, SaysWhatToChangeWhereCorrectionsStayLarge) {
  // What is missing is told by differences, and rows that do not sum to 0 correct it by too little.
  Laplacian laplacian = pointCloudLaplacian(shapes::sphere(1000).points);
  laplacian.L.diagonal() *= 10;
  const Pins pins{{0, 1}, Eigen::VectorXd{{0, 1}}};
  for (const SolverMethod method : {SolverMethod::cholesky, SolverMethod::multigrid}) {
    // Nobody is told to take what is in use.
    const std::string advice = method == SolverMethod::multigrid ? "set method to SolverMethod::cholesky, or " : "";
    EXPECT_EQ(failure([&] { harmonic(laplacian, pins, {.method = method}); }),
              "harmonic: corrections do not become small, so digits are wrong; the matrix is too close to singular; " +
                  advice + "pin more points");
  }
}

TEST(SolverFailure, SaysThatMultigridIsNotFitForBending) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(1000).points);
  const Pins pins{{0, 1}, Eigen::VectorXd{{0, 1}}};
  EXPECT_EQ(failure([&] { biharmonic(laplacian, pins, {.method = SolverMethod::multigrid}); }),
            "biharmonic: multigrid is not fit for L M^-1 L; set method to SolverMethod::cholesky");
  const std::string said = failure([&] { biharmonic(laplacian, pins, {.memory_limit = 1000}); });
  EXPECT_EQ(said.find("biharmonic: a factor of L M^-1 L takes "), 0) << said;
  EXPECT_NE(said.find("raise memory_limit"), std::string::npos) << said;
  EXPECT_EQ(failure([&] { harmonic(laplacian, pins, {.memory_limit = 1000}); }), "accepted");
}

TEST(NumberText, ShowsSmallAndLargeNumbers) {
  EXPECT_EQ(numberText(1.25e-13), "1.25e-13");
  EXPECT_EQ(numberText(640.5), "640.5");
  EXPECT_EQ(numberText(-3e300), "-3e+300");
}

// Cancellation ----------------------------------------------------------------------------------------------------

/// Cancels at one call of Progress after the other.
void expectToCancelAtEveryCall(const std::string& name, int least, const std::function<void(const Progress&)>& work) {
  int calls = 0;
  const auto workUntil = [&](int stop) {
    calls = 0;
    double last = -1;
    std::string stage_before;
    work([&](std::string_view stage, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1) << name << ", " << stage;
      EXPECT_TRUE(stage != stage_before || fraction == 0 || fraction >= last) << name << ", " << stage;
      stage_before = stage, last = fraction;
      return ++calls < stop;
    });
  };
  workUntil(std::numeric_limits<int>::max());
  const int all = calls;
  EXPECT_GE(all, least) << name;
  for (int stop = 1; stop <= all; ++stop) EXPECT_THROW(workUntil(stop), Cancelled) << name << ": " << stop;
}

TEST(Progress, CancelsSolvesAndQueriesAtEveryCall) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::disk(600).points);
  const VectorXd f = laplacian.L * VectorXd::LinSpaced(600, 0, 1);
  const Pins pins{{0, 1}, Eigen::VectorXd{{0, 1}}};
  for (const SolverMethod method : {SolverMethod::cholesky, SolverMethod::multigrid}) {
    const bool by_multigrid = method == SolverMethod::multigrid;
    const SolverOptions made = {.method = method, .threads = 1};
    const auto options = [&](const Progress& progress) {
      SolverOptions result = made;
      result.progress = progress;
      return result;
    };
    const Solver solver = Solver::laplacian(laplacian, made);
    const DistanceSolver distance(laplacian, {.method = DistanceMethod::heat, .solver = made});
    expectToCancelAtEveryCall("Solver", 2,
                              [&](const Progress& progress) { Solver::laplacian(laplacian, options(progress)); });
    expectToCancelAtEveryCall("smooth", 5, [&](const Progress& progress) {
      smooth(laplacian, laplacian.positions, {.iterations = 3, .solver = options(progress)});
    });
    expectToCancelAtEveryCall("solve", by_multigrid ? 10 : 2,
                              [&](const Progress& progress) { solver.solve(f, nullptr, progress); });
    expectToCancelAtEveryCall("query", by_multigrid ? 30 : 8,
                              [&](const Progress& progress) { distance.query({0}, nullptr, progress); });
    expectToCancelAtEveryCall("harmonic", 5,
                              [&](const Progress& progress) { harmonic(laplacian, pins, options(progress)); });
    expectToCancelAtEveryCall("poisson", 5,
                              [&](const Progress& progress) { poisson(laplacian, f, options(progress)); });
    expectToCancelAtEveryCall("poisson with pins", 5,
                              [&](const Progress& progress) { poisson(laplacian, f, pins, options(progress)); });
    if (!by_multigrid)
      expectToCancelAtEveryCall("biharmonic", 5,
                                [&](const Progress& progress) { biharmonic(laplacian, pins, options(progress)); });
    expectToCancelAtEveryCall("DistanceSolver", by_multigrid ? 3 : 6, [&](const Progress& progress) {
      DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = options(progress)});
    });
    expectToCancelAtEveryCall("green", 5,
                              [&](const Progress& progress) { greensFunction(laplacian, {0}, options(progress)); });
  }
}

TEST(EveryFunction, RefusesAChoiceThatIsNone) {
  const shapes::Mesh mesh = shapes::gridSquare(6);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Frames frames = meshFrames(mesh.points, mesh.triangles);
  const Points& points = mesh.points;
  const MatrixXd one = MatrixXd::Ones(points.rows(), 1);
  const auto expect = [](const std::string& message, const std::function<void()>& call) {
    EXPECT_EQ(support::refusal(call), message);
  };
  expect("DistanceSolver: method = 7, must lie in [0, 1]",
         [&] { DistanceSolver(laplacian, {.method = static_cast<DistanceMethod>(7)}); });
  expect("DistanceSolver: unit = 7, must lie in [0, 1]",
         [&] { DistanceSolver(laplacian, {.unit = static_cast<TimeUnit>(7)}); });
  expect("SignedDistanceSolver: method = 7, must lie in [0, 1]",
         [&] { SignedDistanceSolver(laplacian, frames, {.method = static_cast<DistanceMethod>(7)}); });
  expect("LogMapSolver: method = 7, must lie in [0, 1]",
         [&] { LogMapSolver(laplacian, frames, {.method = static_cast<LogMapMethod>(7)}); });
  expect("segments: method = 7, must lie in [0, 2]",
         [&] { segments(laplacian, {.method = static_cast<SegmentMethod>(7)}); });
  expect("smooth: method = 7, must lie in [0, 1]",
         [&] { smooth(laplacian, points, {.method = static_cast<SmoothingMethod>(7)}); });
  expect("parameterize: method = 7, must lie in [0, 1]",
         [&] { parameterize(laplacian, mesh.triangles, {.method = static_cast<ParameterizationMethod>(7)}); });
  expect("parameterize: weights = 7, must lie in [0, 1]", [&] {
    parameterize(laplacian, mesh.triangles,
                 {.method = ParameterizationMethod::harmonic, .weights = static_cast<HarmonicWeights>(7)});
  });
  expect("deform: method = 7, must lie in [0, 1]",
         [&] { deform(laplacian, {0}, points.topRows(1), {.method = static_cast<DeformationMethod>(7)}); });
  expect("curvatures: method = 7, must lie in [0, 1]",
         [&] { curvatures(laplacian, frames, {.method = static_cast<CurvatureMethod>(7)}); });
  expect("InterpolationSolver: kind = 7, must lie in [0, 1]",
         [&] { InterpolationSolver(laplacian, {0}, static_cast<Interpolation>(7)); });
  expect("spectralEmbedding: embedding = 7, must lie in [0, 1]",
         [&] { spectralEmbedding(spectrum(laplacian, 3), static_cast<Embedding>(7)); });
  expect("poisson: method = -1, must lie in [0, 2]",
         [&] { poisson(laplacian, one, {.method = static_cast<SolverMethod>(-1)}); });
}

}  // namespace
}  // namespace tufted::failures_test
