// The files of a result appear together or not at all.
#include "io/staged_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <thread>
#include <vector>

#include "../support/refusal.h"
#include "folder_content.h"
#include "sample_laplacian.h"
#include "small_disk.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/write.h"

namespace staged_files_test {
namespace {

namespace fs = std::filesystem;
using tufted::io::OutputFile;
using tufted::io::StagedFiles;
using Content = std::map<std::string, std::string>;

void write(StagedFiles& files, const std::string& name, std::string_view bytes) {
  OutputFile file(files.stage(name));
  file.write(bytes);
  file.close();
}

std::string ioError(const std::function<void()>& work) {
  return tufted::support::refusal<tufted::IoError>(work);
}

TEST(StagedFiles, AppearTogetherAndLeaveOthersAlone) {
  const TemporaryDir dir;
  dir.write("a", "old");
  dir.write("other", "stays");
  {
    StagedFiles files(dir.path());
    write(files, "a", "new");
    write(files, "b", "new too");
    const Content before = contentOf(dir.path());
    ASSERT_EQ(before.size(), 3u);
    EXPECT_EQ(before.at("a"), "old");
    const std::string hidden = before.begin()->first;
    EXPECT_TRUE(hidden.starts_with(".tufted-")) << hidden;
    EXPECT_EQ(fs::status(dir / hidden).permissions(), fs::perms::owner_all);
    files.commit();
  }
  EXPECT_EQ(contentOf(dir.path()), (Content{{"a", "new"}, {"b", "new too"}, {"other", "stays"}}));
}

TEST(StagedFiles, PutBackWhatWasThereWhenARenameFails) {
  const TemporaryDir dir;
  dir.write("a", "old");
  dir.write("other", "stays");
  const Content before = contentOf(dir.path());
  {
    StagedFiles files(dir.path());
    write(files, "a", "new");
    write(files, "b", "new too");
    // Below a directory that is there while it is written, and not where it is renamed to.
    fs::create_directory(files.stage("gone/c").path.parent_path());
    { std::ofstream(files.stage("gone/c").path) << "never"; }
    EXPECT_EQ(ioError([&] { files.commit(); }),
              (dir / "gone/c").string() + ": cannot write: No such file or directory");
    EXPECT_EQ(readAll(dir / "a"), "old");
    EXPECT_FALSE(fs::exists(dir / "b"));
    for (const auto& entry : fs::directory_iterator(dir.path()))
      if (entry.path().filename().string().starts_with(".tufted-")) fs::remove_all(entry.path() / "gone");
  }
  EXPECT_EQ(contentOf(dir.path()), before);
}

TEST(StagedFiles, NeverReplaceADirectory) {
  const TemporaryDir dir;
  dir.write("a", "old");
  fs::create_directory(dir / "b");
  fs::create_directory_symlink(dir / "b", dir / "c");
  for (const char* name : {"b", "c"}) {
    StagedFiles files(dir.path());
    EXPECT_EQ(ioError([&] { files.stage(name); }), (dir / name).string() + ": cannot write: is a directory");
  }
  {
    StagedFiles files(dir.path());
    write(files, "a", "new");
    write(files, "d", "new");
    fs::create_directories(dir / "d");  // meanwhile
    dir.write("d/inside", "stays");
    EXPECT_EQ(ioError([&] { files.commit(); }), (dir / "d").string() + ": cannot write: is a directory");
  }
  EXPECT_EQ(contentOf(dir.path()), (Content{{"a", "old"}, {"b", "directory"}, {"c", "directory"}, {"d", "directory"}}));
  EXPECT_EQ(readAll(dir / "d/inside"), "stays");
}

TEST(StagedFiles, NeverReplaceALinkOrAPipe) {
  const TemporaryDir dir;
  const auto elsewhere = dir.write("elsewhere", "stays");
  const auto makeLink = [&] { fs::create_symlink(elsewhere, dir / "out/a"); };
  const auto makeDangling = [&] { fs::create_symlink(dir / "nowhere", dir / "out/a"); };
  const auto makePipe = [&] { ASSERT_EQ(mkfifo((dir / "out/a").c_str(), 0600), 0); };
  const std::string name = (dir / "out/a").string();
  const std::string link = name + ": cannot write: is a link, must be a file or missing";
  const std::vector<std::pair<std::function<void()>, std::string>> kinds = {
      {makeLink, link}, {makeDangling, link}, {makePipe, name + ": cannot write: is no regular file"}};
  for (const auto& [make, message] : kinds) {
    for (const bool meanwhile : {false, true}) {  // made before, or while the files are written
      fs::create_directory(dir / "out");
      if (!meanwhile) make();
      {
        StagedFiles files(dir / "out");
        if (meanwhile) {
          write(files, "a", "new");
          make();
          EXPECT_EQ(ioError([&] { files.commit(); }), message);
        } else {
          EXPECT_EQ(ioError([&] { files.stage("a"); }), message);
        }
      }
      EXPECT_FALSE(fs::is_regular_file(fs::symlink_status(name)));
      fs::remove_all(dir / "out");
    }
  }
  EXPECT_EQ(readAll(elsewhere), "stays");
  EXPECT_FALSE(fs::exists(dir / "nowhere"));
}

TEST(StagedFiles, AreNeverWrittenOverAFileOrThroughALink) {
  const TemporaryDir dir;
  const auto file = dir.write("file", "stays");
  fs::create_symlink(file, dir / "link");
  fs::create_symlink(dir / "nowhere", dir / "dangling");
  for (const char* name : {"file", "link", "dangling"})
    EXPECT_EQ(ioError([&] {
                OutputFile({dir / name, dir / name});
              }),
              (dir / name).string() + ": cannot write: File exists");
  EXPECT_EQ(readAll(file), "stays");
  EXPECT_FALSE(fs::exists(dir / "nowhere"));
}

TEST(StagedFiles, OfSeveralThatWriteAtOnceAllAreOfOne) {
  const TemporaryDir dir;
  constexpr int writers = 4, rounds = 100;
  std::vector<std::thread> threads;
  for (int writer = 0; writer < writers; ++writer) {
    threads.emplace_back([&, writer] {
      for (int round = 0; round < rounds; ++round) {
        StagedFiles files(dir / "deep/out");
        for (const char* name : {"a", "b", "c"}) write(files, name, std::to_string(writer));
        if (round >= rounds / 2) files.commit();  // all before are given up, and the directories vanish
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const Content content = contentOf(dir / "deep/out");
  ASSERT_EQ(content.size(), 3u);
  EXPECT_EQ(content.at("a"), content.at("b"));
  EXPECT_EQ(content.at("a"), content.at("c"));
}

TEST(WriteLaplacian, AFullDiskLeavesWhatWasThere) {
  const SmallDisk disk("200k");
  if (!disk.isMounted()) GTEST_SKIP() << "may not mount a small disk";
  const auto laplacian = sampleLaplacian();
  tufted::writeLaplacian(disk / "out", laplacian, sampleGeometry());
  const Content before = contentOf(disk / "out");
  // All but so many bytes of the disk are taken, so that it is full at one file or another.
  for (const std::uintmax_t left : {0u, 4u << 10, 8u << 10, 16u << 10, 24u << 10, 32u << 10, 40u << 10}) {
    const auto available = fs::space(disk.path()).available;
    ASSERT_GE(available, left);
    std::ofstream(disk / "filler") << std::string(available - left, 'x');
    const std::string error = ioError([&] { tufted::writeLaplacian(disk / "out", laplacian, sampleGeometry()); });
    EXPECT_TRUE(error.ends_with("No space left on device") || (left > 0 && error == "accepted")) << error;
    const Content after = contentOf(disk / "out");
    EXPECT_EQ(after.size(), before.size()) << left << ' ' << error;
    EXPECT_TRUE(after == before) << left << ' ' << error;  // the same input gives the same bytes
    fs::remove(disk / "filler");
  }
}

TEST(CheckWritable, RefusesWhatCannotBeWrittenAndLeavesNothing) {
  const TemporaryDir dir;
  const auto file = dir.write("file", "stays");
  fs::create_directories(dir / "out/M.npy");
  const Content before = contentOf(dir.path());
  const auto check = [&](const fs::path& path) {
    return ioError([&] { tufted::checkWritable(path, {"L.npz", "M.npy"}); });
  };
  EXPECT_EQ(check(file), file.string() + ": cannot make the directory: Not a directory");
  EXPECT_EQ(check(file / "below"), (file / "below").string() + ": cannot make the directory: Not a directory");
  EXPECT_EQ(check(dir / "out"), (dir / "out/M.npy").string() + ": cannot write: is a directory");
  EXPECT_EQ(check(dir / "new/and/deep"), "accepted");
  EXPECT_EQ(check("/proc/out").substr(0, 38), "/proc/out: cannot make the directory: ");
  EXPECT_EQ(contentOf(dir.path()), before);
}

}  // namespace
}  // namespace staged_files_test
