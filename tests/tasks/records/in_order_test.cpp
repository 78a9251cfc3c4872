#include "tasks/records/in_order.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>

namespace isojam {
namespace {

/// Within a small range, later indices are ready sooner.
std::size_t slow(std::size_t index) {
  std::this_thread::sleep_for(std::chrono::microseconds(100 * (7 - index % 8)));
  return index;
}

TEST(InOrder, UsesEveryValueInItsTurn) {
  for (const std::size_t count : {0U, 1U, 2U, 7U, 200U}) {
    std::vector<std::size_t> used;
    const auto caller = std::this_thread::get_id();
    in_order(count, slow, [&](std::size_t value) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      used.push_back(value);
    });
    ASSERT_EQ(used.size(), count);
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(used[k], k);
  }
}

TEST(InOrder, KeepsFewInMemory) {
  const std::size_t most = 4 * std::max(1U, std::thread::hardware_concurrency());
  std::atomic<std::size_t> made{0};
  std::size_t used = 0, greatest = 0;
  in_order(
      500, [&](std::size_t) { return made++; },
      [&](std::size_t) {
        std::this_thread::sleep_for(std::chrono::microseconds(50));
        greatest = std::max(greatest, made - used++);
      });
  EXPECT_LE(greatest, most + 1) << "one is in use, the others wait";
  EXPECT_EQ(made, 500U);
}

TEST(InOrder, ThrowsTheFirstFailure) {
  for (const std::size_t first : {0U, 3U, 50U}) {
    std::vector<std::size_t> used;
    const auto make = [&](std::size_t index) {
      if (index >= first) throw std::runtime_error(std::to_string(index));
      return slow(index);
    };
    try {
      in_order(100, make, [&](std::size_t value) { used.push_back(value); });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::to_string(first));
    }
    EXPECT_EQ(used.size(), first);
  }
}

TEST(InOrder, EndsWhereUseThrows) {
  std::size_t used = 0;
  const auto use = [&](std::size_t value) {
    ++used;
    if (value == 5) throw std::runtime_error("full");
  };
  EXPECT_THROW(in_order(1000, slow, use), std::runtime_error);
  EXPECT_EQ(used, 6U);
}

}  // namespace
}  // namespace isojam
