#include "engine/parallel/parallel.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

class OnThreads : public testing::TestWithParam<std::size_t> {
 protected:
  // Without an arena, TBB uses at most as many threads as the machine has cores.
  template <class Work>
  static void with_threads(const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, GetParam());
    tbb::task_arena arena(static_cast<int>(GetParam()));
    arena.execute(work);
  }
};

INSTANTIATE_TEST_SUITE_P(Parallel, OnThreads, testing::Values(1, 2, 5));

/// A random forest: the parent of each node, which has a larger index.
std::vector<int> random_forest(int n, RandomStream& random) {
  std::vector<int> parents(static_cast<std::size_t>(n), -1);
  for (int k = 0; k + 1 < n; ++k) {
    const double reach = random.uniform() < 0.2 ? n - k : 4;
    const int parent = k + 1 + static_cast<int>(reach * random.uniform());
    if (parent < n && random.uniform() < 0.97) parents[k] = parent;
  }
  return parents;
}

std::vector<int> chain(int n) {
  std::vector<int> parents(static_cast<std::size_t>(n));
  std::iota(parents.begin(), parents.end(), 1);
  parents.back() = -1;
  return parents;
}

bool is_above(int ancestor, int k, const std::vector<int>& parents) {
  while (k >= 0 && k != ancestor) k = parents[k];
  return k == ancestor;
}

void work_for(std::chrono::microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
  }
}

TEST_P(OnThreads, ALoopCallsEveryIndexOnce) {
  with_threads([] {
    for (const std::size_t count : {0, 1, 2, 7, 1000}) {
      std::vector<std::atomic<int>> calls(count);
      for_each_index(count, [&](std::size_t k) { ++calls[k]; });
      for (const auto& call : calls) ASSERT_EQ(call, 1);
    }
  });
}

TEST_P(OnThreads, AForestCallsChildrenFirst) {
  RandomStream random{3};
  with_threads([&random] {
    std::vector<std::vector<int>> forests{{}, {-1}, {-1, -1}, chain(100)};
    for (int round = 0; round < 40; ++round) forests.push_back(random_forest(1 + 10 * round, random));
    for (const std::vector<int>& parents : forests) {
      // The sums are not atomic, because a parent must see what its children wrote.
      std::vector<long> subtree(parents.size(), 0), needed(parents.size(), 1);
      for (std::size_t k = 0; k < parents.size(); ++k) {
        if (parents[k] >= 0) needed[parents[k]] += needed[k];
      }
      EXPECT_TRUE(for_each_in_forest(parents, [&](int k) {
        subtree[k] += 1;
        for (int child = 0; child < k; ++child) {
          if (parents[child] == k) subtree[k] += subtree[child];
        }
        return true;
      }));
      EXPECT_EQ(subtree, needed);
    }
  });
}

TEST_P(OnThreads, AFailedNodeSkipsItsAncestors) {
  RandomStream random{4};
  with_threads([&random] {
    for (int round = 0; round < 100; ++round) {
      const std::vector<int> parents = random_forest(200, random);
      const int bad = static_cast<int>(random.bits() % 200);
      std::vector<std::atomic<int>> calls(parents.size());
      EXPECT_FALSE(for_each_in_forest(parents, [&](int k) {
        ++calls[k];
        return k != bad;
      }));
      EXPECT_EQ(calls[bad], 1);
      for (int k = 0; k < 200; ++k) {
        EXPECT_LE(calls[k], 1);
        if (k != bad && is_above(k, bad, parents)) {
          EXPECT_EQ(calls[k], 0) << k << " above " << bad;
        }
      }
    }
  });
}

TEST_P(OnThreads, ExceptionsReachTheCaller) {
  RandomStream random{5};
  with_threads([&random] {
    std::atomic<int> under_way = 0;
    const auto call = [&under_way](bool bad) {
      ++under_way;
      work_for(std::chrono::microseconds(2));
      --under_way;
      if (bad) throw std::runtime_error("bad");
    };
    for (int round = 0; round < 8; ++round) {
      const auto bad = random.bits() % 200;
      EXPECT_THROW(for_each_index(200, [&](std::size_t k) { call(k == bad); }), std::runtime_error);
      EXPECT_EQ(under_way, 0);
      const std::vector<int> parents = random_forest(200, random);
      const auto in_forest = [&](bool within) {
        for_each_in_forest(parents, [&](int k) {
          EXPECT_FALSE(k != static_cast<int>(bad) && is_above(k, static_cast<int>(bad), parents));
          if (within) {
            for_each_index_within(20, [&](std::size_t i) { call(k == static_cast<int>(bad) && i == 13); });
          } else {
            call(k == static_cast<int>(bad));
          }
          return true;
        });
      };
      for (const bool within : {false, true}) {
        EXPECT_THROW(in_forest(within), std::runtime_error);
        EXPECT_EQ(under_way, 0);
      }
    }
  });
}

/// Number of times that a thread, while it was inside `call`, began another call of an enclosing loop.
template <class Call>
int begun_while_waiting(const Call& call) {
  static thread_local bool inside = false;
  std::atomic<int> nested = 0;
  for (int round = 0; round < 25; ++round) {
    tbb::parallel_for(
        0, 12,
        [&](int) {
          if (inside) ++nested;
          inside = true;
          call();
          inside = false;
        },
        tbb::simple_partitioner());
  }
  return nested;
}

TEST_P(OnThreads, WaitingThreadsDoNotStartOuterCalls) {
  if (GetParam() == 1) return;  // a single thread never waits
  with_threads([] {
    // Each call sleeps, so that other threads take some of the calls and the first thread has to wait for them.
    const auto part = [](std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(200)); };
    EXPECT_EQ(begun_while_waiting([&] { for_each_index(6, part); }), 0);
    EXPECT_EQ(begun_while_waiting([&] {
                for_each_in_forest(std::vector<int>(6, -1), [&](int k) {
                  part(static_cast<std::size_t>(k));
                  return true;
                });
              }),
              0);
    EXPECT_EQ(begun_while_waiting([&] {
                for_each_in_forest(std::vector<int>{-1}, [&](int) {
                  for_each_index_within(6, part);
                  return true;
                });
              }),
              0);
  });
}

TEST_P(OnThreads, ACancelledTaskSkipsNothing) {
  with_threads([] {
    tbb::task_group group;
    std::atomic<int> calls = 0;
    group.run([&] {
      group.cancel();
      for_each_index(100, [&](std::size_t) { ++calls; });
      for_each_in_forest(std::vector<int>(100, -1), [&](int) {
        for_each_index_within(3, [&](std::size_t) { ++calls; });
        return true;
      });
    });
    group.wait();
    EXPECT_EQ(calls, 400);
  });
}

}  // namespace
}  // namespace isojam
