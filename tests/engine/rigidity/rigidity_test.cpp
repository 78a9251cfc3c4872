#include "engine/rigidity/rigidity.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/solve/factor/dense.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A state, and numbers that follow from its contacts.
struct Known {
  explicit Known(const Packing& packing) : state(packing) {
    PackingEnergy energy;
    gradient = energy.evaluate(state).gradient;
    contacts = energy.contacts(state);
    angles = alignments(state.solids.only(), contacts);
    analysis = analyse_contacts(state.solids.only(), state.size(), angles);
  }
  RigidityMatrix normals() const { return normal_constraints(state, contacts); }
  RigidityMatrix by_class() const { return class_constraints(state, contacts, angles, analysis.classes); }
  /// Number of constraints: 3, 2 and 1 for every face-face, edge-face and lower-order contact.
  int by_counting() const {
    int sum = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const bool face_face = angles[k].face_face < analysis.face_face.cutoff;
      const bool edge_face = angles[k].edge_face < analysis.edge_face.cutoff;
      sum += face_face ? 3 : edge_face ? 2 : 1;
    }
    return sum;
  }

  const Packing& state;
  VectorXd gradient;
  std::vector<Contact> contacts;
  std::vector<Alignment> angles;
  ContactAnalysis analysis;
};

TEST(RigidityMatrixTest, RowsAreUnitAndForcesGiveTheGradient) {
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, 0.7, 91);
    const Known known(packing);
    for (const RigidityMatrix& matrix : {known.normals(), known.by_class()}) {
      const MatrixXd rows = matrix.rows;
      EXPECT_LE((rows.rowwise().norm().array() - 1).abs().maxCoeff(), 16 * eps);
      const VectorXd gradient = rows.transpose() * matrix.forces;
      EXPECT_LE((gradient - known.gradient).norm(), 1e-10 * known.gradient.norm()) << to_string(kind);
      EXPECT_NEAR(matrix.imbalance, gradient.norm() / matrix.forces.norm(), 16 * eps);
      for (int c = 0; c < 3; ++c) {
        VectorXd shift = VectorXd::Zero(rows.cols());
        for (int i = 0; i < packing.size(); ++i) shift[6 * i + c] = 1;
        EXPECT_LE((rows * shift).cwiseAbs().maxCoeff(), 16 * eps);
      }
    }
    EXPECT_NEAR(known.analysis.numbers.C * packing.size() / 2, static_cast<double>(known.by_class().rows.rows()), 1e-9);
  }
}

/// Checks the numbers of constraints, states of self-stress and floppy motions with contacts and singular values.
void expect_counts(const Rigidity& rigidity, const RigidityMatrix& matrix, int constraints, int particles) {
  const VectorXd sigma = singular_values_of(MatrixXd(matrix.rows));
  const int rank = static_cast<int>((sigma.array() > rigidity.tolerance).count());
  EXPECT_EQ(rigidity.constraints, constraints);
  EXPECT_EQ(rigidity.rank, rank);
  EXPECT_EQ(rigidity.self_stress, constraints - rank);
  EXPECT_EQ(rigidity.floppy, 6 * particles - rank);
  EXPECT_LE(rank, 6 * particles - 3) << "translations are opposed";
  EXPECT_GT(rigidity.least_kept, 1e3 * std::max(rigidity.tolerance, rigidity.largest_dropped))
      << "the rank is a matter of opinion";
  ASSERT_GT(rank, 0);
  EXPECT_GE(rigidity.least_kept, sigma[rank - 1] * (1 - 1e-9));
  EXPECT_LE(rigidity.least_kept, 1.2 * sigma[rank - 1]);
}

void expect_stresses(const Rigidity& rigidity, const RigidityMatrix& matrix) {
  ASSERT_EQ(rigidity.stresses.rows(), rigidity.constraints);
  ASSERT_EQ(rigidity.stresses.cols(), rigidity.self_stress);
  const MatrixXd& basis = rigidity.stresses;
  EXPECT_LE((basis.transpose() * basis - MatrixXd::Identity(basis.cols(), basis.cols())).norm(), 1e4 * eps);
  EXPECT_LE((matrix.rows.transpose() * basis).norm(), rigidity.self_stress * rigidity.tolerance);
}

struct System {
  SolidKind kind;
  int n;
  double final_distance;
};

/// States of a system. Cubes crystallise instead of jamming, so they have only one compressed state.
std::vector<Packing> states_of(const System& system) {
  if (system.kind != SolidKind::cube) return jammed(system.kind, system.n, system.final_distance).states;
  Packing packing = small_packing(system.kind, over_compressed(system.kind), 96, system.n);
  PackingEnergy energy;
  EXPECT_TRUE(is_equilibrium(minimise(packing, energy, {})));
  return {packing};
}

class RigidityOf : public testing::TestWithParam<System> {};

INSTANTIATE_TEST_SUITE_P(Systems, RigidityOf,
                         testing::Values(System{SolidKind::octahedron, 48, .01},
                                         System{SolidKind::tetrahedron, 64, .02},
                                         System{SolidKind::icosahedron, 32, .01}, System{SolidKind::cube, 48, 0}),
                         [](const auto& test) { return std::string(to_string(test.param.kind)); });

TEST_P(RigidityOf, EveryState) {
  const int n = GetParam().n;
  const std::vector<Packing> states = states_of(GetParam());
  ASSERT_FALSE(states.empty());
  RigidityOptions options;
  options.stresses = true;
  for (const Packing& state : states) {
    const Known known(state);
    const RigidityMatrix normals = known.normals(), by_class = known.by_class();
    const Rigidity of_normals = analyse_rigidity(normals, options), of_classes = analyse_rigidity(by_class, options);
    std::printf(
        "φ %.4f Z %.2f C %.2f: %d normals, %d states of self-stress; %d rows, rank %d of %d, %d states; "
        "singular values %.0e | %.0e\n",
        state.density(), known.analysis.numbers.Z, known.analysis.numbers.C, of_normals.constraints,
        of_normals.self_stress, of_classes.constraints, of_classes.rank, 6 * n - 3, of_classes.self_stress,
        of_normals.least_kept, of_normals.largest_dropped);
    expect_counts(of_normals, normals, static_cast<int>(known.contacts.size()), n);
    expect_counts(of_classes, by_class, known.by_counting(), n);
    expect_stresses(of_normals, normals);
    expect_stresses(of_classes, by_class);
    EXPECT_GE(of_classes.rank, of_normals.rank);
    EXPECT_GE(of_normals.self_stress, 1) << "an equilibrium is a state of self-stress";
    // The contact forces are a state of self-stress, so nothing remains if their projection on these states is
    // subtracted.
    const VectorXd forces = normals.forces.normalized();
    const VectorXd rest = forces - of_normals.stresses * (of_normals.stresses.transpose() * forces);
    EXPECT_LE(rest.norm(), normals.imbalance / of_normals.least_kept * 100);
  }
}

/// A matrix with more rows than its rank; each row is a combination of a basis.
RigidityMatrix combinations(int rank, int redundant, RandomStream& random) {
  MatrixXd basis(rank, 18), mixture(rank + redundant, rank);
  for (double& entry : basis.reshaped()) entry = random.normal();
  for (double& entry : mixture.reshaped()) entry = random.normal();
  RigidityMatrix matrix;
  matrix.rows = (mixture * basis).rowwise().normalized().sparseView();
  matrix.forces = VectorXd::Zero(rank + redundant);
  return matrix;
}

TEST(RigidityTest, KnownRanks) {
  RigidityMatrix none;
  none.rows.resize(0, 18);
  const Rigidity free = analyse_rigidity(none);
  EXPECT_EQ(free.floppy, 18);
  EXPECT_EQ(free.rank, 0);
  EXPECT_EQ(free.self_stress, 0);

  RandomStream random{95};
  for (int rank = 1; rank < 15; ++rank) {
    // With 60 redundant rows, the rank comes from all singular values, unless a basis is requested.
    for (const int redundant : {4, 60}) {
      const RigidityMatrix matrix = combinations(rank, redundant, random);
      const Rigidity rigidity = analyse_rigidity(matrix);
      EXPECT_EQ(rigidity.rank, rank);
      EXPECT_EQ(rigidity.self_stress, redundant);
      EXPECT_LE(rigidity.tolerance, 2.0 * (18 + redundant) * eps * singular_values_of(MatrixXd(matrix.rows))[0]);
      EXPECT_EQ(rigidity.floppy, 18 - rank);
      RigidityOptions options;
      options.stresses = true;
      const Rigidity with_basis = analyse_rigidity(matrix, options);
      EXPECT_EQ(with_basis.rank, rank);
      EXPECT_EQ(with_basis.stresses.cols(), redundant);
      EXPECT_NEAR(with_basis.least_kept, rigidity.least_kept, 0.05 * rigidity.least_kept) << "an upper limit";
    }
  }
}

}  // namespace
}  // namespace isojam
