// Reference: elimination of a dense pattern, one particle after the other.

#include "engine/solve/factor/elimination.hpp"

#include <algorithm>
#include <set>

#include "engine/solve/factor/ordering.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

BlockMatrix random_graph(int n, double density, RandomStream& random) {
  BlockMatrix matrix;
  matrix.diagonal.assign(static_cast<std::size_t>(n), Matrix6d::Identity());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      if (random.uniform() < density) matrix.off_diagonal.push_back({i, j, Matrix6d::Zero()});
    }
  }
  return matrix;
}

std::vector<BlockMatrix> graphs() {
  RandomStream random{31};
  std::vector<BlockMatrix> list;
  for (const int n : {0, 1, 2, 7, 30, 120}) {
    for (const double density : {0.0, 0.02, 0.1, 0.5, 1.0}) list.push_back(random_graph(n, density, random));
  }
  for (const SolidKind kind : all_solids) list.push_back(PackingEnergy().hessian(small_packing(kind, 0.6, 3, 80)));
  return list;
}

/// For each position of the elimination, the later positions that are coupled to it when the earlier ones have been
/// eliminated.
std::vector<std::set<int>> filled_in(const BlockMatrix& matrix, const std::vector<int>& node_of) {
  std::vector<int> place_of(node_of.size());
  for (std::size_t k = 0; k < node_of.size(); ++k) place_of[node_of[k]] = static_cast<int>(k);
  std::vector<std::set<int>> later(node_of.size());
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    const auto [low, high] = std::minmax(place_of[block.row], place_of[block.column]);
    later[low].insert(high);
  }
  for (std::set<int>& rows : later) {
    for (const int low : rows) {
      for (const int high : rows) {
        if (low < high) later[low].insert(high);
      }
    }
  }
  return later;
}

TEST(Elimination, EliminatesEveryParticleOnce) {
  for (const BlockMatrix& matrix : graphs()) {
    const Elimination plan = plan_elimination(matrix, fill_reducing_order(matrix));
    std::vector<int> sorted = plan.node_of;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), matrix.diagonal.size());
    for (int k = 0; k < matrix.size(); ++k) ASSERT_EQ(sorted[k], k);
    int next = 0;
    std::vector<int> parents(plan.supernodes.size(), 0);
    for (std::size_t s = 0; s < plan.supernodes.size(); ++s) {
      const Supernode& node = plan.supernodes[s];
      EXPECT_EQ(node.first, next);
      EXPECT_GT(node.columns, 0);
      next += node.columns;
      for (const int child : node.children) {
        ASSERT_LT(child, static_cast<int>(s));
        ++parents[child];
      }
    }
    EXPECT_EQ(next, matrix.size());
    for (std::size_t s = 0; s < plan.supernodes.size(); ++s)
      EXPECT_EQ(parents[s], plan.supernodes[s].rows.empty() ? 0 : 1) << "supernode " << s << " of N " << matrix.size();
  }
}

TEST(Elimination, SupernodesContainTheFillIn) {
  for (const BlockMatrix& matrix : graphs()) {
    const Elimination plan = plan_elimination(matrix, fill_reducing_order(matrix));
    const std::vector<std::set<int>> later = filled_in(matrix, plan.node_of);
    for (const Supernode& node : plan.supernodes) {
      EXPECT_TRUE(std::is_sorted(node.rows.begin(), node.rows.end()));
      const int end = node.first + node.columns;
      for (int k = node.first; k < end; ++k) {
        for (const int row : later[k])
          EXPECT_TRUE(row < end || std::binary_search(node.rows.begin(), node.rows.end(), row))
              << "places " << k << " and " << row << " of N " << matrix.size();
      }
      EXPECT_TRUE(node.rows.empty() || node.rows.front() >= end);
      // A child passes its update matrix to its parent, so the parent must contain all its rows.
      for (const int child : node.children) {
        for (const int row : plan.supernodes[child].rows)
          EXPECT_TRUE(row < end || std::binary_search(node.rows.begin(), node.rows.end(), row));
      }
    }
  }
}

TEST(Elimination, SupernodesContainFewZeros) {
  for (const SolidKind kind : all_solids) {
    const BlockMatrix matrix = PackingEnergy().hessian(small_packing(kind, 0.6, 3, 150));
    const Elimination plan = plan_elimination(matrix, fill_reducing_order(matrix));
    std::size_t needed = 0, held = 0;
    for (const std::set<int>& rows : filled_in(matrix, plan.node_of)) needed += rows.size();
    for (const Supernode& node : plan.supernodes)
      held += node.columns * node.rows.size() + node.columns * (node.columns - 1) / 2;
    EXPECT_GE(held, needed);
    EXPECT_LT(held, 1.5 * static_cast<double>(needed)) << platonic(kind).name();
    EXPECT_LT(plan.supernodes.size(), matrix.diagonal.size() / 2) << platonic(kind).name() << ": nothing was merged";
  }
}

TEST(Elimination, DependsOnlyOnThePattern) {
  for (BlockMatrix matrix : graphs()) {
    const Elimination plan = plan_elimination(matrix, fill_reducing_order(matrix));
    for (BlockMatrix::Block& block : matrix.off_diagonal) block.value.setConstant(3);
    EXPECT_EQ(plan_elimination(matrix, fill_reducing_order(matrix)).node_of, plan.node_of);
  }
}

}  // namespace
}  // namespace isojam
