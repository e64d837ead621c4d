// What happens if there is no memory: each request in turn fails. What comes out must be std::bad_alloc or an error of
// the library, nothing may be lost, and the next call must work.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <stdexcept>

#include "attacks/failing_malloc.h"
#include "attacks/odd_inputs.h"
#include "io/staged_files.h"
#include "io/temporary_dir.h"
#include "shapes/shapes.h"
#include "support/algorithms.h"
#include "tufted/errors.h"
#include "tufted/io/operators.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/io/write.h"
#include "tufted/laplacian_builder.h"
#include "tufted/view/page.h"
#include "tufted/view/picture.h"

namespace tufted::attacks {
namespace {

namespace fs = std::filesystem;

enum class Outcome { done, done_without, no_memory, own_error, other_error };

/// Calls while the request number `nth`, or all from then on, fail. What is thrown is destroyed before this returns.
Outcome callWithFailure(const std::function<void()>& call, std::int64_t nth, bool from_then_on, std::string& message,
                        std::size_t least = 0) {
  const auto stop = [] {
    const bool has_failed = hasFailed();
    failRequest(0);
    return has_failed;
  };
  try {
    failRequest(nth, from_then_on, least);
    call();
    return stop() ? Outcome::done_without : Outcome::done;
  } catch (const std::bad_alloc&) {
    stop();
    return Outcome::no_memory;
  } catch (const std::exception& error) {
    stop();
    message.assign(error.what());
    const bool is_own = dynamic_cast<const InvalidInput*>(&error) != nullptr ||
                        dynamic_cast<const SolverFailure*>(&error) != nullptr ||
                        dynamic_cast<const IoError*>(&error) != nullptr;
    return is_own ? Outcome::own_error : Outcome::other_error;
  }
}

/// nlohmann's JSON takes some memory in destructors, which ends the process if there is none.
constexpr std::size_t larger_than_json = 2000;
/// Eigen's sparse matrices lose one block if the copy constructor finds no memory.
constexpr std::int64_t lost_by_eigen = 1;

/// Lets each request of a call fail in turn, alone and with all that follow.
/// @param step only each so many-th request fails, unless TUFTED_ATTACKS is set
void failEach(const std::string& name, const std::function<void()>& call, std::int64_t step = 1,
              std::int64_t may_lose = 0, std::size_t least = 0) {
  SCOPED_TRACE(name);
  if (std::getenv("TUFTED_ATTACKS") != nullptr) step = 1;
  for (int i = 0; i < 3; ++i) call();  // what is made once, such as threads and tables, stays
  std::string message(1000, ' ');      // its memory is taken now
  int failures = 0, done_without = 0;
  for (const bool from_then_on : {false, true}) {
    Outcome outcome = Outcome::no_memory;
    for (std::int64_t nth = 1; outcome != Outcome::done; nth += step) {
      std::int64_t lost = may_lose + 1;
      // What stays after the first failure, as a library makes it once, is not lost.
      for (int round = 0; round < 3 && lost > may_lose; ++round) {
        const std::int64_t before = liveBlocks();
        outcome = callWithFailure(call, nth, from_then_on, message, least);
        lost = liveBlocks() - before;
      }
      EXPECT_LE(lost, may_lose) << "blocks after request " << nth << ", outcome " << static_cast<int>(outcome);
      EXPECT_NE(outcome, Outcome::other_error) << "request " << nth << ": " << message;
      done_without += outcome == Outcome::done_without ? 1 : 0;
      failures += outcome == Outcome::done || outcome == Outcome::done_without ? 0 : 1;
      if (nth % 64 == 1) call();  // nothing is broken
    }
  }
  call();
  EXPECT_GT(failures, 0);
  std::printf("%s: %d failed, %d did without the memory\n", name.c_str(), failures, done_without);
  std::fflush(stdout);
}

TEST(Allocation, BuildsFailCleanly) {
  const Points sphere = shapes::sphere(60).points;
  const Points noisy = shapes::withNoise(shapes::sphere(400), 0.03).points;
  const shapes::Mesh mesh = shapes::icosphere(1);
  for (const int threads : {1, 2}) {
    CloudOptions options;
    MeshOptions of_mesh;
    options.threads = of_mesh.threads = threads;
    for (const Preset preset : {Preset::clean, Preset::scan}) {
      options.steps = cloudSteps(preset);
      failEach(
          "cloud", [&] { pointCloudLaplacian(sphere, options).cover(); }, 5);
    }
    failEach(
        "noisy cloud", [&] { pointCloudLaplacian(noisy, options).cover(); }, 40);
    failEach("mesh", [&] { meshLaplacian(mesh.points, mesh.triangles, of_mesh); });
    LaplacianBuilder builder;
    failEach(
        "builder",
        [&] {
          struct Release {
            LaplacianBuilder& used;
            ~Release() { used.release(); }
          } const at_end{builder};
          builder.pointCloud(sphere, options);
        },
        5);
  }
}

TEST(Allocation, ABuilderWithoutMemoryHasNoPoints) {
  const Points small = shapes::sphere(60).points, large = shapes::sphere(300).points;
  const CloudOptions options = {.threads = 1};
  for (std::int64_t nth = 1;; nth += 15) {
    LaplacianBuilder builder;
    const Laplacian& result = builder.pointCloud(small, options);
    std::string message;
    const auto build = [&] { builder.pointCloud(large, options); };
    if (callWithFailure(build, nth, true, message) == Outcome::done) break;
    ASSERT_TRUE(result.status.empty() && result.M.size() == 0 && result.L.rows() == 0 && result.positions.rows() == 0 &&
                !result.hasCover())
        << "request " << nth;
  }
}

TEST(Allocation, AlgorithmsFailCleanly) {
  const Points points = shapes::sphere(100).points;
  CloudOptions options = cloudOptions(Preset::clean);
  options.threads = 1;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  laplacian.cover();
  for (const support::Algorithm& algorithm : support::algorithms())
    failEach(
        algorithm.name, [&] { algorithm.run(laplacian, points); }, 151, lost_by_eigen);
}

TEST(Allocation, ReadingAndWritingFailCleanly) {
  const TemporaryDir dir;
  const shapes::Mesh mesh = shapes::icosphere(1);
  Geometry geometry;
  geometry.points = mesh.points;
  geometry.is_mesh = true;
  geometry.triangles = mesh.triangles;
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.threads = 1});
  const WriteOptions options = {.formats = {Format::npz, Format::mtx, Format::spmat, Format::petsc, Format::ply,
                                            Format::pcd, Format::cover, Format::triangles}};
  const auto write = [&] { writeLaplacian(dir.path(), laplacian, geometry, options); };
  failEach("write", write, 1, 0, larger_than_json);
  for (const fs::directory_entry& entry : fs::directory_iterator(dir.path()))
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry << " was left behind";
  failEach(
      "read a result", [&] { readLaplacian(dir.path()); }, 1, 0, larger_than_json);
  std::ofstream(dir.path() / "a.xyz") << "1 2 3\n4 5 6\n7 8 10\n";
  std::ofstream(dir.path() / "a.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  std::ofstream(dir.path() / "a.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::ofstream(dir.path() / "a.pcd") << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
                                         "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  for (const char* name : {"points.ply", "points.pcd", "measured_positions.npy", "a.xyz", "a.obj", "a.off", "a.pcd"}) {
    const Points expected = read(dir.path() / name).points;
    bool is_same = true;  // also if a library did without the memory
    failEach(name, [&] { is_same = is_same && read(dir.path() / name).points == expected; });
    EXPECT_TRUE(is_same) << name;
  }
}

TEST(Allocation, StagedFilesFailCleanly) {
  const TemporaryDir dir;
  failEach("staged files", [&] {
    io::StagedFiles files(dir / "a long name of a folder/and one more");
    for (const char* name : {"the first file of two", "the second file of two"})
      ::close(::open(files.stage(name).path.c_str(), O_WRONLY | O_CREAT, 0666));
    files.commit();
  });
  const fs::path folder = dir / "a long name of a folder/and one more";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2) << "something is left behind";
}

TEST(Allocation, PagesAndPicturesFailCleanly) {
  const TemporaryDir dir;
  const shapes::Mesh mesh = shapes::icosphere(1);
  Scene scene = {.title = "a sphere", .positions = mesh.points, .triangles = mesh.triangles};
  scene.fields = {{.name = "x", .values = mesh.points.col(0)}};
  const std::string expected = pageOf(scene);
  const auto page = [&] {
    writePage(dir.path() / "page.html", scene);
    if (pageOf(scene) != expected) throw std::logic_error("another page");
  };
  failEach("page", page, 1, 0, larger_than_json);
  const PictureOptions options = {.width = 64, .height = 64, .threads = 1};
  const std::vector<std::uint8_t> pixels = drawPicture(scene, options).pixels;
  const auto picture = [&] {
    writePicture(dir.path() / "x.png", scene, options);
    if (drawPicture(scene, options).pixels != pixels) throw std::logic_error("another picture");
  };
  failEach("picture", picture, 7);
  for (const fs::directory_entry& entry : fs::directory_iterator(dir.path()))
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry << " was left behind";
}

}  // namespace
}  // namespace tufted::attacks
