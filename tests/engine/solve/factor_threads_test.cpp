#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <Eigen/Cholesky>
#include <limits>

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

TEST(FactorThreads, GraphsWithoutEdgesAreDissected) {
  BlockMatrix matrix = scattered_blocks(400, 8);
  std::erase_if(matrix.off_diagonal, [](const BlockMatrix::Block& block) { return block.column % 3 == 0; });
  EXPECT_EQ(Team(2).solution(matrix).size(), 2400);
  matrix.off_diagonal.clear();
  EXPECT_EQ(Team(2).solution(matrix).size(), 2400);
}

}  // namespace
}  // namespace isojam
