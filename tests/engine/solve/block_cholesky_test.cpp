// References: dense LLT and sparse SimplicialLDLT of Eigen, within the error that the condition number allows.

#include "engine/solve/factor/block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <limits>

#include "engine/solve/factor/dense.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct System {
  std::string name;
  BlockMatrix matrix;
  Eigen::MatrixXd full;
  double lowest = 0, highest = 0;  ///< eigenvalues
};

System system_of(const std::string& name, const BlockMatrix& matrix) {
  System system{name, matrix, dense(matrix)};
  const Eigen::VectorXd lambda = symmetric_eigenvalues(system.full);
  system.lowest = lambda.minCoeff();
  system.highest = lambda.maxCoeff();
  return system;
}

BlockMatrix hessian_of(const Packing& packing) {
  PackingEnergy energy;
  return energy.hessian(packing);
}

Packing sized_packing(SolidKind kind, int n, double density, std::uint64_t seed) {
  RandomStream random{seed, static_cast<std::uint64_t>(n)};
  return random_packing(platonic(kind), n, density, random);
}

/// Two touching particles.
Packing pair_packing(SolidKind kind) {
  Packing packing = sized_packing(kind, 2, 0.02, 7);
  packing.poses[1].position =
      packing.poses[0].position + Eigen::Vector3d(0.3, 0.4, 1.1) * packing.solids.only().inradius();
  return packing;
}

/// A symmetric matrix of random blocks. Block (i, j) with i < j is nonzero if coupled(i, j) is true.
template <class Coupled>
BlockMatrix random_blocks(int n, const Coupled& coupled) {
  RandomStream random{21, static_cast<std::uint64_t>(n)};
  const auto block = [&random] {
    Matrix6d value;
    for (double& entry : value.reshaped()) entry = random.normal();
    return value;
  };
  BlockMatrix matrix;
  for (int i = 0; i < n; ++i) {
    const Matrix6d half = block();
    matrix.diagonal.push_back(half + half.transpose());
    for (int j = i + 1; j < n; ++j) {
      if (coupled(i, j)) matrix.off_diagonal.push_back({i, j, block()});
    }
  }
  return matrix;
}

std::vector<System> systems() {
  std::vector<System> list;
  BlockMatrix alone;
  alone.diagonal.assign(1, Matrix6d::Identity() * 3);
  alone.diagonal[0](4, 1) = alone.diagonal[0](1, 4) = 1;
  list.push_back(system_of("N=1", alone));
  list.push_back(system_of("N=1 without contacts", hessian_of(sized_packing(SolidKind::cube, 1, 0.01, 1))));
  list.push_back(system_of("N=2", hessian_of(pair_packing(SolidKind::octahedron))));
  list.push_back(system_of("N=20 dilute", hessian_of(sized_packing(SolidKind::icosahedron, 20, 0.1, 2))));
  list.push_back(system_of("N=20 dense", hessian_of(sized_packing(SolidKind::dodecahedron, 20, 0.75, 3))));
  list.push_back(system_of("N=64 dilute", hessian_of(sized_packing(SolidKind::tetrahedron, 64, 0.15, 4))));
  list.push_back(system_of("N=64 dense", hessian_of(sized_packing(SolidKind::tetrahedron, 64, 0.75, 5))));
  list.push_back(system_of("N=200 dense", hessian_of(sized_packing(SolidKind::octahedron, 200, 0.7, 6))));
  list.push_back(system_of("chain", random_blocks(30, [](int i, int j) { return j == i + 1; })));
  list.push_back(system_of("star", random_blocks(25, [](int i, int j) { return i == 12 || j == 12; })));
  // The fronts are wider than the number of columns that are processed in one pass, and there are rows below them.
  const auto cluster = [](int i) { return i / 30; };
  list.push_back(system_of("two clusters", random_blocks(65, [&](int i, int j) {
                             return cluster(i) == cluster(j) || std::max(cluster(i), cluster(j)) == 2;
                           })));
  list.push_back(system_of("everything coupled", random_blocks(61, [](int, int) { return true; })));
  return list;
}

/// A scale for shifts, which is nonzero even if the Hessian is zero.
double stiffness(const System& system) { return system.highest > 0 ? system.highest : 1.0; }

/// ‖A x − b‖ / (‖A‖‖x‖ + ‖b‖).
double backward_error(const Eigen::MatrixXd& a, double norm, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  return (a * x - b).norm() / (norm * x.norm() + b.norm());
}

TEST(BlockCholesky, SolvesAsTheDenseAndSparseFactorsDo) {
  RandomStream random{11};
  for (const System& system : systems()) {
    const Eigen::Index n = system.full.rows();
    double worst_backward = 0, worst_forward = 0;
    for (const double above : {1.0, 1e-3, 1e-6, 1e-9}) {
      const double shift = std::max(0.0, -system.lowest) + above * stiffness(system);
      const Eigen::MatrixXd a = system.full + shift * Eigen::MatrixXd::Identity(n, n);
      const double norm = std::max(system.highest, 0.0) + shift, condition = norm / (system.lowest + shift);
      const Eigen::VectorXd b = normal_vector(n, random);
      BlockCholesky factor;
      ASSERT_TRUE(factor.factorise(system.matrix, shift)) << system.name << " shift " << shift;
      const Eigen::VectorXd x = factor.solve(b);
      const double backward = backward_error(a, norm, x, b);
      const double allowed = 4 * eps * std::sqrt(static_cast<double>(n));
      EXPECT_LE(backward, allowed) << system.name << " shift " << shift;
      const Eigen::VectorXd dense_x = a.llt().solve(b);
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> sparse(a.sparseView());
      const Eigen::VectorXd sparse_x = sparse.solve(b);
      // Each solution has its own backward error, which the condition number amplifies.
      EXPECT_LE((x - dense_x).norm(), 4 * allowed * condition * x.norm()) << system.name << " shift " << shift;
      EXPECT_LE((x - sparse_x).norm(), 4 * allowed * condition * x.norm()) << system.name << " shift " << shift;
      worst_backward = std::max(worst_backward, backward / eps);
      worst_forward = std::max(worst_forward, (x - dense_x).norm() / x.norm() / (eps * condition));
    }
    std::printf("%-21s %5zu blocks, eigenvalues %9.2e … %.2e: backward error %.2f eps, from LLT %.2f eps·cond\n",
                system.name.c_str(), system.matrix.off_diagonal.size(), system.lowest, system.highest, worst_backward,
                worst_forward);
  }
}

TEST(BlockCholesky, RejectsMatricesThatAreNotPositiveDefinite) {
  int indefinite = 0;
  for (const System& system : systems()) {
    const double margin = 1e-6 * stiffness(system);
    BlockCholesky factor;
    EXPECT_TRUE(factor.factorise(system.matrix, -system.lowest + margin)) << system.name;
    EXPECT_FALSE(factor.factorise(system.matrix, -system.lowest - margin)) << system.name;
    EXPECT_FALSE(factor.factorise(system.matrix, -2 * stiffness(system))) << system.name;
    if (system.lowest < -margin) {
      ++indefinite;
      EXPECT_FALSE(factor.factorise(system.matrix, 0)) << system.name;
    }
  }
  EXPECT_GE(indefinite, 3) << "Hessians of random packings should be indefinite";
  BlockMatrix zero;
  zero.diagonal.assign(3, Matrix6d::Zero());
  EXPECT_FALSE(BlockCholesky().factorise(zero, 0));
}

TEST(BlockCholesky, RejectsNaN) {
  BlockMatrix matrix = hessian_of(sized_packing(SolidKind::dodecahedron, 20, 0.75, 3));
  const double shift = 10 * dense(matrix).cwiseAbs().rowwise().sum().maxCoeff();
  ASSERT_TRUE(BlockCholesky().factorise(matrix, shift));
  matrix.diagonal[7](3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(BlockCholesky().factorise(matrix, shift));
}

TEST(BlockCholesky, ReuseGivesTheBitsOfANewFactor) {
  RandomStream random{13};
  const std::vector<System> list = systems();
  BlockCholesky used;
  for (int round = 0; round < 30; ++round) {
    const System& system = list[random.bits() % list.size()];
    const double high = 2 * (std::max(0.0, -system.lowest) + stiffness(system));
    // The same pattern twice with different values. In some cases a matrix is rejected in between.
    for (const double factor : {1.0, 0.7}) {
      if (random.uniform() < 0.3) {
        ASSERT_FALSE(used.factorise(system.matrix, -high)) << system.name;
      }
      BlockCholesky fresh;
      ASSERT_TRUE(used.factorise(system.matrix, factor * high)) << system.name;
      ASSERT_TRUE(fresh.factorise(system.matrix, factor * high)) << system.name;
      const Eigen::VectorXd b = normal_vector(system.full.rows(), random);
      EXPECT_TRUE(used.solve(b) == fresh.solve(b)) << system.name << " in round " << round;
    }
  }
}

}  // namespace
}  // namespace isojam
