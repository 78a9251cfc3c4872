#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <Eigen/Cholesky>
#include <limits>
#include <thread>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/ordering.hpp"
#include "tests/engine/solve/scattered_blocks.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr int dissected = 700;

Eigen::VectorXd right_side(int n) {
  RandomStream random{77};
  return normal_vector(6 * n, random);
}

/// Runs work with a given number of threads, even if the machine has fewer cores.
class Team {
 public:
  explicit Team(std::size_t threads)
      : limit_(tbb::global_control::max_allowed_parallelism, threads), arena_(static_cast<int>(threads)) {}

  /// (matrix + safe_shift)⁻¹ b; empty if the matrix is rejected.
  Eigen::VectorXd solution(const BlockMatrix& matrix, BlockCholesky& factor) {
    bool done = false;
    arena_.execute([&] { done = factor.factorise(matrix, safe_shift); });
    return done ? factor.solve(right_side(matrix.size())) : Eigen::VectorXd();
  }
  Eigen::VectorXd solution(const BlockMatrix& matrix) {
    BlockCholesky factor;
    return solution(matrix, factor);
  }

 private:
  tbb::global_control limit_;
  tbb::task_arena arena_;
};

TEST(FactorThreads, SolveAsTheDenseFactorDoes) {
  const BlockMatrix matrix = scattered_blocks(400, 1);
  ASSERT_GT(plan_fronts(matrix).ranges.size(), 4U);
  const Eigen::MatrixXd full = dense(matrix) + safe_shift * Eigen::MatrixXd::Identity(2400, 2400);
  const Eigen::VectorXd expected = full.llt().solve(right_side(400));
  EXPECT_LE((Team(2).solution(matrix) - expected).norm(), 1e-12 * expected.norm());
}

TEST(FactorThreads, TheNumberOfThreadsChangesNothing) {
  for (const int n : {350, dissected}) {
    const BlockMatrix matrix = scattered_blocks(n, 2);
    const Eigen::VectorXd one = Team(1).solution(matrix);
    ASSERT_EQ(one.size(), 6 * n);
    for (const std::size_t threads : {2, 3, 6}) {
      Team team(threads);
      BlockCholesky used;
      for (int again = 0; again < 10; ++again) {
        EXPECT_TRUE(team.solution(matrix) == one) << threads;
        EXPECT_TRUE(team.solution(matrix, used) == one) << threads;
      }
    }
  }
}

TEST(FactorThreads, SeveralFactorsAtOnceChangeNothing) {
  const BlockMatrix matrix = scattered_blocks(350, 3);
  const Eigen::VectorXd alone = Team(1).solution(matrix);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::parallel_for(
        0, 12,
        [&](int) {
          BlockCholesky factor;
          ASSERT_TRUE(factor.factorise(matrix, safe_shift));
          EXPECT_TRUE(factor.solve(right_side(350)) == alone);
        },
        tbb::simple_partitioner());
  });
}

TEST(FactorThreads, AFailedPivotIsAlwaysReported) {
  const BlockMatrix good = scattered_blocks(dissected, 4);
  const FrontPlan plan = plan_fronts(good);
  const Eigen::VectorXd expected = Team(1).solution(good);
  const int last = static_cast<int>(plan.node_of.size()) - 1;
  const std::vector<std::vector<int>> places{{0}, {last}, {last / 2}, {0, last / 3, last / 2}, {last - 30}};
  for (const double pivot : {-1e6, std::numeric_limits<double>::quiet_NaN()}) {
    for (const std::vector<int>& bad : places) {
      BlockMatrix matrix = good;
      for (const int place : bad) matrix.diagonal[plan.node_of[place]](2, 2) = pivot;
      for (const std::size_t threads : {1, 2, 6}) {
        Team team(threads);
        BlockCholesky factor;
        for (int again = 0; again < 3; ++again)
          EXPECT_EQ(team.solution(matrix, factor).size(), 0) << "place " << bad.front();
        EXPECT_TRUE(team.solution(good, factor) == expected) << "place " << bad.front();
      }
    }
  }
}

/// The parent of every front; −1 if it has none.
std::vector<int> parents_of(const FrontPlan& plan) {
  std::vector<int> parents(plan.fronts.size(), -1);
  for (std::size_t f = 0; f < plan.fronts.size(); ++f) {
    for (const int child : plan.fronts[f].node.children) parents[child] = static_cast<int>(f);
  }
  return parents;
}

bool is_below(int k, int ancestor, const std::vector<int>& parents) {
  while (k >= 0 && k < ancestor) k = parents[k];
  return k == ancestor;
}

TEST(FactorThreads, UpdatesNeededAtTheSameTimeDoNotOverlap) {
  for (const int n : {100, 350, dissected}) {
    const FrontPlan plan = plan_fronts(scattered_blocks(n, 5));
    const std::vector<int> parents = parents_of(plan);
    std::vector<int> range_of(plan.fronts.size(), -1);
    int next = 0;
    for (std::size_t r = 0; r < plan.ranges.size(); ++r) {
      EXPECT_EQ(plan.ranges[r].first, next);
      next = plan.ranges[r].last;
      for (int f = plan.ranges[r].first; f < next; ++f) range_of[f] = static_cast<int>(r);
    }
    ASSERT_EQ(next, static_cast<int>(plan.fronts.size()));
    EXPECT_EQ(plan.ranges.size() > 8, n > 300) << "a small one is left to one thread";
    for (int g = 0; g < next; ++g) {
      const Front& late = plan.fronts[g];
      EXPECT_LE(late.update_size() > 0 ? late.update + late.update_size() : 0, plan.updates_size);
      for (int f = 0; f < g; ++f) {
        const Front& early = plan.fronts[f];
        if (early.update_size() == 0 || late.update_size() == 0) continue;
        // The update was used before the later front begins: by a front below it, or by an earlier front of the same
        // thread.
        const bool gone = parents[f] < g && (is_below(parents[f], g, parents) || range_of[parents[f]] == range_of[g]);
        const bool apart =
            early.update + early.update_size() <= late.update || late.update + late.update_size() <= early.update;
        EXPECT_TRUE(gone || apart) << "updates of " << f << " and " << g << " of N " << n;
      }
    }
  }
}

double work_of(const BlockMatrix& matrix, const std::vector<int>& order) {
  double work = 0;
  for (const Supernode& node : plan_elimination(matrix, order).supernodes) {
    Front front;
    front.node = node;
    work += front.work();
  }
  return work;
}

TEST(FactorThreads, DissectionHasLessFillIn) {
  for (const int n : {350, 700, 1400}) {
    const BlockMatrix matrix = scattered_blocks(n, 6);
    const std::vector<int> order = fill_reducing_order(matrix);
    EXPECT_EQ(order, dissection_order(matrix));
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (int k = 0; k < n; ++k) ASSERT_EQ(sorted[k], k);
    const double gain = work_of(matrix, minimum_degree_order(matrix)) / work_of(matrix, order);
    std::printf("N %4d: minimum degree takes %.2f times the operations of dissection\n", n, gain);
    EXPECT_GT(gain, 1.05);
  }
  EXPECT_EQ(fill_reducing_order(scattered_blocks(100, 6)), minimum_degree_order(scattered_blocks(100, 6)));
}

TEST(FactorThreads, SimultaneousDissectionsChangeNothing) {
  const BlockMatrix matrix = scattered_blocks(dissected, 7);
  const std::vector<int> alone = dissection_order(matrix);
  std::vector<char> same(8, 0);
  std::vector<std::thread> threads;
  for (char& result : same) {
    threads.emplace_back([&] {
      bool all = true;
      for (int again = 0; again < 5; ++again) all = dissection_order(matrix) == alone && all;
      result = all;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const char result : same) EXPECT_TRUE(result);
}

TEST(FactorThreads, GraphsWithoutEdgesAreDissected) {
  BlockMatrix matrix = scattered_blocks(400, 8);
  std::erase_if(matrix.off_diagonal, [](const BlockMatrix::Block& block) { return block.column % 3 == 0; });
  EXPECT_EQ(Team(2).solution(matrix).size(), 2400);
  matrix.off_diagonal.clear();
  EXPECT_EQ(Team(2).solution(matrix).size(), 2400);
}

}  // namespace
}  // namespace isojam
