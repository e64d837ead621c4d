// What memory there is, told from files as Linux keeps them.
#include "algorithms/memory_limit.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace tufted::memory_limit_test {
namespace {

namespace fs = std::filesystem;

/// A file system of a few files, gone with the test.
class MemoryLimit : public testing::Test {
 protected:
  ~MemoryLimit() override { fs::remove_all(root_); }

  void write(const fs::path& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  std::size_t available() const { return availableMemory(root_); }

  const fs::path root_ = fs::temp_directory_path() / ("tufted_memory_" + std::to_string(getpid()) + "_" +
                                                      testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(MemoryLimit, IsTheMachinesWhereNothingIsTold) {
  EXPECT_EQ(available(), static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE));
}

TEST_F(MemoryLimit, IsWhatIsAvailableAndNotWhatIsFree) {
  write("proc/meminfo", "MemTotal: 900 kB\nMemFree: 100 kB\nMemAvailable: 300 kB\n");
  EXPECT_EQ(available(), 300 * 1024U);
}

TEST_F(MemoryLimit, IsThatOfTheTightestGroupAroundTheProcess) {
  write("proc/meminfo", "MemAvailable: 300 kB\n");
  write("proc/self/cgroup", "0::/system/job\n");
  write("sys/fs/cgroup/system/job/memory.max", "max\n");
  EXPECT_EQ(available(), 300 * 1024U);
  write("sys/fs/cgroup/system/memory.max", "200000\n");
  EXPECT_EQ(available(), 200000U);
  write("sys/fs/cgroup/system/job/memory.max", "150000\n");
  EXPECT_EQ(available(), 150000U);
  write("sys/fs/cgroup/memory.max", "120000\n");  // of a container, which sees its own group as the top
  EXPECT_EQ(available(), 120000U);
}

TEST_F(MemoryLimit, KnowsGroupsOfTheFirstVersion) {
  write("proc/meminfo", "MemAvailable: 300 kB\n");
  write("proc/self/cgroup", "5:cpu,cpuacct:/small\n4:memory:/docker/box\n0::/\n");
  write("sys/fs/cgroup/memory/docker/box/memory.limit_in_bytes", "9223372036854771712\n");
  write("sys/fs/cgroup/memory/small/memory.limit_in_bytes", "1000\n");  // another controller's group
  EXPECT_EQ(available(), 300 * 1024U);
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "100000\n");
  EXPECT_EQ(available(), 100000U);
}

TEST(MemoryLimitOption, IsHalfOfWhatIsAvailableUnlessStated) {
  EXPECT_EQ(memoryLimit(77), 77U);
  EXPECT_GT(memoryLimit(0), 0U);
  EXPECT_LE(memoryLimit(0), static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) / 2 * sysconf(_SC_PAGESIZE));
}

}  // namespace
}  // namespace tufted::memory_limit_test
