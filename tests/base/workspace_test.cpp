#include "base/workspace.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <thread>

#include "base/buffer.h"
#include "base/parallel.h"

namespace tufted::workspace_test {
namespace {

TEST(Workspace, BlocksAreUsedAgainForSizesLikeTheirs) {
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  Buffer<double>(1000);
  const std::size_t held = workspace.bytes();
  EXPECT_GE(held, 1000 * sizeof(double));
  for (const int size : {1000, 900, 1010}) Buffer<double> again(size);
  EXPECT_EQ(workspace.bytes(), held);
  Buffer<double>(100);  // a tenth of the block would be used
  EXPECT_GT(workspace.bytes(), held);
}

TEST(Workspace, BlocksHoldWhatWasAskedFor) {
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  std::vector<Buffer<std::uint8_t>> buffers;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t size = 1; size < 100'000; size += 1 + size / 7) {
      buffers.emplace_back(size, static_cast<std::uint8_t>(buffers.size()));
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffers.back().data()) % alignof(void*), 0);
    }
    for (std::size_t i = 0; i < buffers.size(); ++i)
      for (const std::uint8_t byte : buffers[i]) ASSERT_EQ(byte, static_cast<std::uint8_t>(i));
    buffers.clear();
  }
}

TEST(Workspace, WideTypesAreAligned) {
  struct alignas(64) Wide {
    int value = 0;
  };
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  for (int round = 0; round < 2; ++round) {
    std::vector<Buffer<Wide>> buffers;
    for (std::size_t size = 1; size < 20; ++size) {
      buffers.emplace_back(size).back().value = 7;
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffers.back().data()) % alignof(Wide), 0);
    }
  }
}

TEST(Workspace, OnlyScopesTakeFromIt) {
  Workspace workspace;
  Buffer<int>(1000);
  EXPECT_EQ(workspace.bytes(), 0);
  {
    const Workspace::Scope scope(&workspace);
    const Workspace::Scope inner(nullptr);
    Buffer<int>(1000);
  }
  EXPECT_EQ(workspace.bytes(), 0);
}

TEST(Workspace, BuffersOutliveScopeAndWorkspace) {
  std::optional<Workspace> workspace(std::in_place);
  std::optional<Workspace::Scope> scope(&*workspace);
  Buffer<int> kept(1000, 7), other(10, 7);
  scope.reset();
  workspace.reset();
  EXPECT_EQ(kept.back(), 7);
  std::thread([moved = std::move(kept)] { EXPECT_EQ(moved.front(), 7); }).join();
  kept.assign(10, 3);  // from the heap
}

TEST(Workspace, ReleaseKeepsWhatIsInUse) {
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  Buffer<int> used(1000, 7);
  const std::size_t held = workspace.bytes();
  Buffer<int>(3000);
  EXPECT_GT(workspace.bytes(), held);
  workspace.release();
  EXPECT_EQ(workspace.bytes(), held);
  EXPECT_EQ(used.back(), 7);
}

TEST(Workspace, TrimGivesBackWhatNobodyHasUsedSince) {
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  Buffer<int>(1000);
  const std::size_t small = workspace.bytes();
  Buffer<int>(3000);
  const std::size_t both = workspace.bytes();
  workspace.trim();
  EXPECT_EQ(workspace.bytes(), both) << "both have been used";
  Buffer<int>(1000);
  workspace.trim();
  EXPECT_EQ(workspace.bytes(), small);
  workspace.trim();
  EXPECT_EQ(workspace.bytes(), 0);
}

TEST(Workspace, AllThreadsOfABuildTakeFromIt) {
  Workspace workspace;
  const Workspace::Scope scope(&workspace);
  const Progress silent;
  Workers(4, silent).forBlocks("test", 64, 1,
                               [&](std::int64_t, std::int64_t, int) { EXPECT_EQ(Workspace::current(), &workspace); });
}

}  // namespace
}  // namespace tufted::workspace_test
