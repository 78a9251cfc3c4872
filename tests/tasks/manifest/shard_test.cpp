#include "tasks/manifest/shard.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <stdexcept>
#include <vector>

namespace isojam {
namespace {

TEST(Shard, ReadsIOfN) {
  const auto third = parse_shard("3/12");
  ASSERT_TRUE(third);
  EXPECT_EQ(third->index, 2);
  EXPECT_EQ(third->count, 12);
  EXPECT_TRUE(parse_shard("1/1")->whole());
  for (const char* wrong : {"", "1", "/", "1/", "/2", "0/2", "3/2", "-1/2", "1/0", "1/2/3", "a/b", "1 /2", "1/2 ",
                            "+1/2", "1/100001", "99999999999/99999999999", "1.0/2"})
    EXPECT_FALSE(parse_shard(wrong)) << wrong;
}

class Environment {
 public:
  explicit Environment(const std::map<std::string, std::string>& values) : values_(values) {
    for (const auto& [name, value] : values_) setenv(name.c_str(), value.c_str(), 1);
  }
  ~Environment() {
    for (const auto& [name, value] : values_) unsetenv(name.c_str());
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::map<std::string, std::string> values_;
};

TEST(Shard, ASlurmTaskFindsItsShard) {
  EXPECT_TRUE(shard_of_environment().whole());
  // array=5-20:5
  for (const auto& [task, index] : std::map<int, int>{{5, 0}, {10, 1}, {20, 3}}) {
    const Environment slurm({{"SLURM_ARRAY_TASK_ID", std::to_string(task)},
                             {"SLURM_ARRAY_TASK_COUNT", "4"},
                             {"SLURM_ARRAY_TASK_MIN", "5"},
                             {"SLURM_ARRAY_TASK_MAX", "20"},
                             {"SLURM_ARRAY_TASK_STEP", "5"}});
    EXPECT_EQ(shard_of_environment().index, index);
    EXPECT_EQ(shard_of_environment().count, 4);
  }
  const Environment zero(
      {{"SLURM_ARRAY_TASK_ID", "0"}, {"SLURM_ARRAY_TASK_COUNT", "2"}, {"SLURM_ARRAY_TASK_MIN", "0"}});
  EXPECT_EQ(shard_of_environment().index, 0);
}

TEST(Shard, ContradictionsAreRejected) {
  const std::vector<std::map<std::string, std::string>> wrong{
      {{"SLURM_ARRAY_TASK_ID", "1"}},
      {{"SLURM_ARRAY_TASK_COUNT", "4"}},
      {{"SLURM_ARRAY_TASK_ID", "x"}, {"SLURM_ARRAY_TASK_COUNT", "4"}},
      {{"SLURM_ARRAY_TASK_ID", "9"}, {"SLURM_ARRAY_TASK_COUNT", "4"}},
      {{"SLURM_ARRAY_TASK_ID", "0"}, {"SLURM_ARRAY_TASK_COUNT", "4"}},
      {{"SLURM_ARRAY_TASK_ID", "2"}, {"SLURM_ARRAY_TASK_COUNT", "4"}, {"SLURM_ARRAY_TASK_STEP", "2"}},
      {{"SLURM_ARRAY_TASK_ID", "2"}, {"SLURM_ARRAY_TASK_COUNT", "0"}},
      // array=2,5: a gap
      {{"SLURM_ARRAY_TASK_ID", "2"},
       {"SLURM_ARRAY_TASK_COUNT", "2"},
       {"SLURM_ARRAY_TASK_MIN", "2"},
       {"SLURM_ARRAY_TASK_MAX", "5"}},
  };
  for (const auto& values : wrong) {
    const Environment slurm(values);
    EXPECT_THROW(shard_of_environment(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace isojam
