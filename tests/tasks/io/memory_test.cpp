#include "tasks/io/memory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

void limit(const std::filesystem::path& group, const std::string& most, const std::string& used,
           const std::string& limit_name = "memory.max", const std::string& usage_name = "memory.current") {
  std::filesystem::create_directories(group);
  test::write_text(group / limit_name, most + "\n");
  test::write_text(group / usage_name, used + "\n");
}

TEST(Memory, IsLimitedByEachEnclosingControlGroup) {
  const test::TemporaryDirectory root;
  const std::string groups = "0::/slurm/job_7/step_0\n";
  EXPECT_TRUE(std::isinf(available_in_groups(groups, root.path())));
  limit(root / "slurm" / "job_7" / "step_0", "max", "100");
  EXPECT_TRUE(std::isinf(available_in_groups(groups, root.path())));
  limit(root / "slurm" / "job_7", "5000", "1000");
  EXPECT_EQ(available_in_groups(groups, root.path()), 4000);
  limit(root / "slurm", "3000", "500");
  EXPECT_EQ(available_in_groups(groups, root.path()), 2500);
  limit(root.path(), "600", "500");
  EXPECT_EQ(available_in_groups(groups, root.path()), 100);
  limit(root / "slurm" / "job_7" / "step_0", "50", "100");
  EXPECT_EQ(available_in_groups(groups, root.path()), -50);
  EXPECT_EQ(available_in_groups("0::/\n", root.path()), 100) << "a container sees its own group as the root";
}

TEST(Memory, IsLimitedByControlGroupsOfVersion1) {
  const test::TemporaryDirectory root;
  const std::string groups = "9:name=systemd:/\n4:cpu,memory:/job\n0::/\nnot a group\n";
  EXPECT_TRUE(std::isinf(available_in_groups(groups, root.path())));
  limit(root / "memory" / "job", "7000", "1000", "memory.limit_in_bytes", "memory.usage_in_bytes");
  EXPECT_EQ(available_in_groups(groups, root.path()), 6000);
  limit(root / "unified", "2000", "1000");
  EXPECT_EQ(available_in_groups(groups, root.path()), 1000);
  EXPECT_TRUE(std::isinf(available_in_groups("", root.path())));
}

}  // namespace
}  // namespace isojam
