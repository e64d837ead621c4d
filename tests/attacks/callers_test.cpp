// What callers do to a library: forks, exceptions from callbacks, several threads, other locales and masks, odd names.
#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <filesystem>
#include <fstream>
#include <locale>
#include <thread>

#include "attacks/odd_inputs.h"
#include "io/temporary_dir.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"
#include "tufted/io/write.h"
#include "tufted/laplacian_builder.h"
#include "tufted/spectrum.h"
#include "tufted/view/page.h"
#include "tufted/view/picture.h"

namespace tufted::attacks {
namespace {

namespace fs = std::filesystem;

Geometry geometryOf(const Points& points) {
  Geometry geometry;
  geometry.points = points;
  return geometry;
}

Scene sceneOf(const Points& points) {
  Scene scene;
  scene.positions = points;
  return scene;
}

void expectSameBits(const Laplacian& a, const Laplacian& b) {
  EXPECT_TRUE(support::sameBits(a.L, b.L));
  EXPECT_TRUE(support::sameBits(a.M, b.M));
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.boundary, b.boundary);
  ASSERT_EQ(a.frames.normals.rows(), b.frames.normals.rows());
  const auto count = static_cast<std::size_t>(a.frames.normals.size());
  EXPECT_TRUE(support::sameBits(a.frames.normals.data(), b.frames.normals.data(), count));
  EXPECT_TRUE(support::sameBits(a.frames.tangents.data(), b.frames.tangents.data(), count));
}

TEST(Threads, OfAnyNumberGiveTheSameBitsOnOddClouds) {
  for (int i = 0; i < rounds(10); ++i) {
    SCOPED_TRACE("seed " + std::to_string(101 + i));
    const Points points = oddCloud(static_cast<std::uint64_t>(101 + i), 9000);
    CloudOptions options = cloudOptions(i % 2 == 0 ? Preset::scan : Preset::clean);
    options.threads = 1;
    const Laplacian one = pointCloudLaplacian(points, options);
    for (const int threads : {2, 7}) {
      options.threads = threads;
      expectSameBits(one, pointCloudLaplacian(points, options));
    }
    if (HasFailure()) break;
  }
}

TEST(Threads, OfAnyNumberGiveTheSameBitsOnOddMeshes) {
  for (int i = 0; i < rounds(10); ++i) {
    SCOPED_TRACE("seed " + std::to_string(101 + i));
    Soup soup = oddSoup(static_cast<std::uint64_t>(101 + i));
    const int copies = 200;  // enough for several blocks, joined at the vertices of the first
    const int n = static_cast<int>(soup.points.rows()), faces = static_cast<int>(soup.triangles.rows());
    const Points points = soup.points.replicate(copies, 1);
    Triangles triangles(faces * copies, 3);
    for (int f = 0; f < triangles.rows(); ++f)
      for (int s = 0; s < 3; ++s)
        triangles(f, s) = soup.triangles(f % faces, s) + (s == 0 && f % 5 == 0 ? 0 : n * (f / faces));
    MeshOptions options;
    options.threads = 1;
    const Laplacian one = meshLaplacian(points, triangles, options);
    for (const int threads : {2, 7}) {
      options.threads = threads;
      expectSameBits(one, meshLaplacian(points, triangles, options));
    }
    if (HasFailure()) break;
  }
}

TEST(Threads, BuildSideBySide) {
  const Points points = shapes::withNoise(shapes::sphere(3000), 0.01).points;
  const Laplacian alone = pointCloudLaplacian(points);
  std::vector<Laplacian> results(8);
  std::vector<std::thread> threads;
  for (Laplacian& result : results) threads.emplace_back([&] { result = pointCloudLaplacian(points, {.threads = 2}); });
  for (std::thread& thread : threads) thread.join();
  for (const Laplacian& result : results) expectSameBits(alone, result);
}

#ifndef TUFTED_SANITIZED  // ThreadSanitizer allows no threads after a fork
/// Runs a test in a child; what it says and whether it ended by itself is the result.
template <class Test>
void inChild(const Test& test) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(120);  // instead of waiting for ever for a lock
    bool is_right = false;
    try {
      is_right = test();
    } catch (...) {
    }
    _exit(is_right ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Fork, ChildrenBuildSolveAndDraw) {
  const Points points = shapes::withNoise(shapes::sphere(3000), 0.01).points;
  const auto work = [&] {
    const Laplacian laplacian = pointCloudLaplacian(points, {.threads = 2});
    const VectorXd heat = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({0});
    const VectorXd values = spectrum(laplacian, 12).values;
    const Scene scene = sceneOf(points);
    const std::vector<std::uint8_t> pixels = drawPicture(scene, {.width = 64, .height = 64, .field = -1}).pixels;
    VectorXd all(heat.size() + values.size() + 1);
    all << heat, values, std::accumulate(pixels.begin(), pixels.end(), 0.0);
    return all;
  };
  const VectorXd expected = work();
  for (int i = 0; i < 3; ++i) inChild([&] { return support::sameBits(work(), expected); });
  inChild([&] {  // a grandchild
    bool is_right = false;
    inChild([&] { return support::sameBits(work(), expected); });
    is_right = !testing::Test::HasFailure();
    return is_right;
  });
}

#endif

struct Stop {
  int call;
};

/// Throws at the n-th call, for each n until the work ends by itself. Returns how often.
template <class Work>
int throwAtEachCall(const Work& work, int step) {
  int thrown = 0;
  for (int nth = 1;; nth += step) {
    int calls = 0;
    const Progress progress = [&](std::string_view, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1);
      if (++calls == nth) throw Stop{nth};
      return true;
    };
    try {
      work(progress);
      return thrown;
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.call, nth);
      ++thrown;
    }
  }
}

TEST(Callback, ExceptionsArriveAndTheNextCallWorks) {
  const Points points = shapes::withNoise(shapes::sphere(3000), 0.01).points;
  const shapes::Mesh mesh = shapes::icosphere(3);
  const Laplacian expected = pointCloudLaplacian(points);
  LaplacianBuilder builder;
  for (const int threads : {1, 2}) {
    const auto build = [&](const Progress& progress) {
      builder.pointCloud(points, {.threads = threads, .progress = progress});
    };
    EXPECT_GT(throwAtEachCall(build, 5), 5);
    expectSameBits(expected, builder.pointCloud(points));
    EXPECT_GT(throwAtEachCall(
                  [&](const Progress& progress) {
                    builder.mesh(mesh.points, mesh.triangles, {.threads = threads, .progress = progress});
                  },
                  1),
              5);
  }
  const auto findPairs = [&](const Progress& progress) { spectrum(expected, 8, {.progress = progress}); };
  EXPECT_GT(throwAtEachCall(findPairs, 3), 1);
  const DistanceSolver solver(expected, {.method = DistanceMethod::heat});
  EXPECT_GE(throwAtEachCall([&](const Progress& progress) { solver.query({0}, nullptr, progress); }, 1), 1);
}

TEST(Callback, AnExceptionWhileFilesAreWrittenLeavesNone) {
  const TemporaryDir dir;
  const Geometry geometry = geometryOf(shapes::sphere(100).points);
  const Laplacian laplacian = pointCloudLaplacian(geometry.points);
  int failed = 0;
  const int thrown = throwAtEachCall(
      [&](const Progress& progress) {
        failed += fs::exists(dir / "out") ? 1 : 0;
        writeLaplacian(dir / "out", laplacian, geometry, {.progress = progress});
      },
      1);
  EXPECT_GT(thrown, 3);
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(support::sameBits(readLaplacian(dir / "out").L, laplacian.L), true);
}

/// A decimal comma, and points between thousands.
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Locale, ChangesNoFile) {
  const Geometry geometry = geometryOf(shapes::sphere(1500).points * 12345.678);
  const Laplacian laplacian = pointCloudLaplacian(geometry.points);
  const WriteOptions options = {.formats = {Format::npz, Format::mtx, Format::spmat, Format::ply, Format::pcd}};
  Scene scene = sceneOf(geometry.points);
  scene.fields = {{.name = "M", .values = laplacian.M}};
  const TemporaryDir usual, other;
  const auto writeAll = [&](const TemporaryDir& dir) {
    writeLaplacian(dir / "out", laplacian, geometry, options);
    writePage(dir / "out/page.html", scene);
    writePicture(dir / "out/picture.png", scene, {.width = 200, .height = 150});
  };
  writeAll(usual);
  const fs::path text = usual.write("a.xyz", "1.5 2.25 3\n1e3 5 1234567.5\n7 8 9\n");
  const fs::path object = usual.write("a.obj", "v 1.5 2.25 3\nv 0 1 1234567.5\nv 1 1 0.125\nf 1 2 3\n");
  const Points before = read(text).points, corners = read(object).points;
  const std::locale previous = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string c_locale = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  writeAll(other);
  EXPECT_EQ(read(text).points, before);
  EXPECT_EQ(read(object).points, corners);
  EXPECT_TRUE(support::sameBits(readLaplacian(usual / "out").L, laplacian.L));
  std::setlocale(LC_ALL, c_locale.c_str());
  std::locale::global(previous);
  for (const fs::directory_entry& entry : fs::directory_iterator(usual / "out"))
    EXPECT_TRUE(readAll(entry) == readAll(other / "out" / entry.path().filename())) << entry.path().filename();
}

TEST(Mask, DecidesWhoMayReadResults) {
  const Geometry geometry = geometryOf(shapes::sphere(100).points);
  const Laplacian laplacian = pointCloudLaplacian(geometry.points);
  const Scene scene = sceneOf(geometry.points);
  for (const mode_t mask : {077U, 000U, 022U}) {
    const TemporaryDir dir;
    const mode_t before = umask(mask);
    writeLaplacian(dir / "out", laplacian, geometry);
    writePage(dir / "out/page.html", scene);
    umask(before);
    const auto modeOf = [](const fs::path& path) {
      struct stat found = {};
      EXPECT_EQ(stat(path.c_str(), &found), 0);
      return found.st_mode & 0777U;
    };
    EXPECT_EQ(modeOf(dir / "out"), 0777U & ~mask);
    for (const fs::directory_entry& entry : fs::directory_iterator(dir / "out"))
      EXPECT_EQ(modeOf(entry), 0666U & ~mask) << entry.path().filename();
  }
}

TEST(Names, MayHoldAnyByte) {
  const TemporaryDir dir;
  const Geometry geometry = geometryOf(shapes::sphere(20).points);
  const Laplacian laplacian = pointCloudLaplacian(geometry.points);
  const Scene scene = sceneOf(geometry.points);
  std::vector<std::string> names = {"-x", "--", "~", "..x", "a b", "a\nb", "%s%n", "$HOME", "*", "a\\", "\xc3\xa4\xff"};
  // All of them take half a minute, because every file is flushed to disk.
  const int step = std::getenv("TUFTED_ATTACKS") == nullptr ? 23 : 1;
  for (int byte = 1; byte < 256; byte += step)
    if (byte != '/') names.push_back("a" + std::string(1, static_cast<char>(byte)) + "b");
  for (const std::string& name : names) {
    SCOPED_TRACE(testing::PrintToString(name));
    const fs::path folder = dir / name;
    writeLaplacian(folder, laplacian, geometry, {.source = name});
    EXPECT_TRUE(support::sameBits(readLaplacian(folder).M, laplacian.M));
    writePage(folder / (name + ".html"), scene);
    EXPECT_TRUE(fs::is_regular_file(folder / (name + ".html")));
    std::ofstream(folder / (name + ".xyz")) << "1 2 3\n4 5 6\n7 8 10\n";
    EXPECT_EQ(read(folder / (name + ".xyz")).points.rows(), 3);
    std::ofstream(folder / (name + ".ply")) << "ply\nformat nothing\n";
    EXPECT_THROW(read(folder / (name + ".ply")), IoError);
  }
}

#ifndef TUFTED_SANITIZED  // sanitizers keep freed memory
/// The files that this process has open.
int openFiles() {
  int count = 0;
  DIR* const dir = opendir("/proc/self/fd");
  while (readdir(dir) != nullptr) ++count;
  closedir(dir);
  return count;
}

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST(Soak, FramesOfAnyKindTakeNoMoreMemoryAndFiles) {
  constexpr double most_growth = 16;  // MB; over 5,000 frames this allows 3 kB per frame
  const TemporaryDir dir;
  LaplacianBuilder builder;
  const int frames = rounds(50), warm_up = std::min(frames / 2, 200), files = openFiles();
  double after_warm_up = 0;
  for (int i = 0; i < frames; ++i) {
    const auto seed = static_cast<std::uint64_t>(101 + i % 200);
    CloudOptions options = cloudOptions(static_cast<Preset>(i % 3));
    options.keep_cover = i % 5 != 0;
    const Points points = oddCloud(seed, 1500);
    const Laplacian& result = builder.pointCloud(points, options);
    if (i % 7 == 0 && result.hasCover()) result.cover();
    if (i % 11 == 0) {
      const Soup soup = oddSoup(seed);
      builder.mesh(soup.points, soup.triangles);
    }
    if (i % 50 == 0) writeLaplacian(dir / "out", pointCloudLaplacian(points), geometryOf(points));
    if (i == warm_up - 1) after_warm_up = residentMegabytes();
  }
  EXPECT_LE(residentMegabytes(), after_warm_up + most_growth);
  EXPECT_EQ(openFiles(), files);
  std::printf("%d frames: %.1f MB after the first %d, %.1f MB in the end\n", frames, after_warm_up, warm_up,
              residentMegabytes());
}

#endif

}  // namespace
}  // namespace tufted::attacks
