#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "../support/refusal.h"
#include "malformed_files.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

void PrintTo(const Malformed& file, std::ostream* stream) {
  *stream << file.name;
}

namespace malformed_test {
namespace {

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithItsPathAndAReason) {
  const TemporaryDir dir;
  const auto path = dir.write(GetParam().name, GetParam().bytes);
  try {
    tufted::read(path);
    FAIL() << "was read";
  } catch (const tufted::IoError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
    EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
    EXPECT_TRUE(message.find(": line ") != std::string::npos || message.find(": byte ") != std::string::npos ||
                message.ends_with(": is empty"))
        << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MalformedFile, testing::ValuesIn(malformedFiles()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

std::string refusal(const std::filesystem::path& path, tufted::ReadAs as = tufted::ReadAs::automatic) {
  return tufted::support::refusal<tufted::IoError>([&] { tufted::read(path, as); });
}

TEST(Read, WhatIsNoRegularFileIsRefused) {
  const TemporaryDir dir;
  EXPECT_NE(refusal(dir / "missing.ply").find("missing.ply: no such file"), std::string::npos);
  std::filesystem::create_directory(dir / "folder.ply");
  EXPECT_NE(refusal(dir / "folder.ply").find("is a directory"), std::string::npos);
  ASSERT_EQ(mkfifo((dir / "pipe.ply").c_str(), 0600), 0);
  EXPECT_NE(refusal(dir / "pipe.ply").find("not a regular file"), std::string::npos);
}

TEST(Read, ACloudIsNoMesh) {
  const TemporaryDir dir;
  EXPECT_NE(refusal(dir.write("a.xyz", "1 2 3\n"), tufted::ReadAs::mesh).find("has no faces"), std::string::npos);
}

TEST(Read, EveryBeginningOfAFileIsRefusedAndTheWholeIsRead) {
  const auto refusedAt = [](const WellFormed& file, std::size_t length) {
    try {
      tufted::parse(std::string_view(file.bytes).substr(0, length), file.name);
    } catch (const tufted::IoError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const WellFormed& file : wellFormedFiles()) {
    EXPECT_EQ(refusedAt(file, file.bytes.size()), "") << file.name;
    // The last bytes of a text may be spaces, or the word that ends a solid.
    const std::size_t optional = file.name == "ascii.stl" ? 9 : file.bytes.back() == '\n' ? 1 : 0;
    for (std::size_t length = 1; length + optional < file.bytes.size(); ++length) {
      const std::string message = refusedAt(file, length);
      EXPECT_NE(message, "") << file.name << ' ' << length;
      EXPECT_TRUE(message.find(": line ") != std::string::npos || message.find(": byte ") != std::string::npos)
          << message;
    }
  }
}

TEST(Read, TheContentTellsTheFormatWhereTheNameDoesNot) {
  for (const WellFormed& file : wellFormedFiles()) {
    const auto named = tufted::parse(file.bytes, file.name), nameless = tufted::parse(file.bytes, "scan.bin");
    EXPECT_EQ(named.format, nameless.format);
    EXPECT_EQ(named.points, nameless.points) << file.name;
    EXPECT_EQ(named.triangles, nameless.triangles) << file.name;
  }
  EXPECT_EQ(tufted::parse("v 1 2 3\n", "scan").format, "OBJ");
  EXPECT_EQ(tufted::parse("# a comment\n1 2 3\n", "scan").format, "text in columns");
  EXPECT_EQ(tufted::parse("X;Y;Z\n1;2;3\n", "scan").format, "text in columns");
}

TEST(Read, AFormatThatIsNamedWinsOverTheExtension) {
  EXPECT_EQ(tufted::parse("1 2 3\n", "a.ply", tufted::ReadAs::automatic, tufted::FileFormat::xyz).points.rows(), 1);
}

TEST(Read, AStreamGivesWhatTheFileGives) {
  const TemporaryDir dir;
  for (const WellFormed& file : wellFormedFiles()) {
    std::istringstream stream(file.bytes);
    EXPECT_EQ(tufted::read(stream, "standard input").points, tufted::read(dir.write(file.name, file.bytes)).points)
        << file.name;
  }
  std::istringstream nothing;
  EXPECT_THROW(tufted::read(nothing, "standard input"), tufted::IoError);
}

}  // namespace
}  // namespace malformed_test
