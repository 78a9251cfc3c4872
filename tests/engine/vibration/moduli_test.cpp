#include "engine/vibration/moduli.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "engine/vibration/dynamical_matrix.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Measured {
  explicit Measured(const Packing& packing) : state(packing) {
    PackingEnergy energy;
    evaluation = energy.evaluate(state, Precision::double_double);
    hessian = energy.hessian(state, Precision::double_double);
    contacts = energy.contacts(state);
  }
  std::optional<ElasticTensor> tensor() const { return elastic_tensor(state, hessian, contacts, evaluation); }

  Packing state;
  Evaluation evaluation;
  BlockMatrix hessian;
  std::vector<Contact> contacts;
};

struct System {
  SolidKind kind;
  int n;
  double final_distance;
};

class Moduli : public testing::TestWithParam<System> {
 protected:
  const JamResult& result = jammed(GetParam().kind, GetParam().n, GetParam().final_distance);
};

INSTANTIATE_TEST_SUITE_P(Systems, Moduli,
                         testing::Values(System{SolidKind::octahedron, 48, .01},
                                         System{SolidKind::tetrahedron, 64, .02}),
                         [](const auto& test) { return std::string(to_string(test.param.kind)); });

TEST_P(Moduli, BulkModulusIsThePressuresSlope) {
  for (const Packing& state : result.states) {
    const Measured measured(state);
    const auto tensor = measured.tensor();
    const auto slope = pressure_slope(state);
    ASSERT_TRUE(tensor && slope);
    const auto shear = tensor->shear_moduli();
    std::printf("φ %.4f p %.2e: K %.6e, from pressures %.6e, affine %.2e; G %.2e … %.2e, mean %.2e\n", state.density(),
                tensor->pressure, tensor->bulk_modulus(), slope->bulk_modulus, tensor->affine_bulk_modulus(), shear[0],
                shear[4], tensor->mean_shear_modulus());
    EXPECT_NEAR(tensor->bulk_modulus(), slope->bulk_modulus, 1e-5 * slope->bulk_modulus);
    EXPECT_GT(tensor->bulk_modulus(), 0);
    EXPECT_LT(tensor->bulk_modulus(), tensor->affine_bulk_modulus());
    EXPECT_TRUE(tensor->relaxed == tensor->relaxed.transpose());
    double sum = 0;
    for (const double g : shear) sum += g;
    EXPECT_NEAR(sum / 5, tensor->mean_shear_modulus(), 1e-10 * std::abs(shear[4]));
    EXPECT_TRUE(std::is_sorted(shear.begin(), shear.end()));
  }
}

/// Energy of given contacts whose displacements are deformed by F, and its gradient with respect to the 6N coordinates.
struct Strained {
  double energy = 0;
  VectorXd gradient;
};

Strained strained(const Measured& measured, const Matrix3d& deformation) {
  const Packing& packing = measured.state;
  const double radius = packing.solids.only().gyration_radius();
  Strained sum{0, VectorXd::Zero(6 * packing.size())};
  for (const Contact& contact : measured.contacts) {
    const Pose &a = packing.poses[contact.pair.a], &b = packing.poses[contact.pair.b];
    const Eigen::Vector3d d = deformation * contact.displacement;
    const Overlap o =
        relative_overlap(packing.solids.only(), packing.solids.only(), relative_pose(a.orientation, b.orientation, d));
    const Eigen::Vector3d push = a.orientation * (o.volume / 2 * o.area),
                          turn = a.orientation * (o.volume / 2 * o.moment);
    sum.energy += o.volume * o.volume / 4;
    sum.gradient.segment<6>(6 * contact.pair.a) += joined(push, turn / radius);
    sum.gradient.segment<6>(6 * contact.pair.b) += joined(-push, (d.cross(push) - turn) / radius);
  }
  return sum;
}

/// Unit tensors in the order of the components.
Matrix3d basis_tensor(int i) {
  static constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
  Matrix3d tensor = Matrix3d::Zero();
  tensor(pairs[i][0], pairs[i][1]) = tensor(pairs[i][1], pairs[i][0]) = i < 3 ? 1 : 1 / std::numbers::sqrt2;
  return tensor;
}

/// exp(ε) by its series, for small ε.
Matrix3d exponential(const Matrix3d& strain) {
  return Matrix3d::Identity() + strain + strain * strain / 2 + strain * strain * strain / 6;
}

struct Differences {
  Matrix6d affine;
  MatrixXd forces;  ///< 6N rows and 6 columns
};

Differences by_differences(const Measured& measured, double h) {
  const auto energy = [&](const Matrix3d& strain) { return strained(measured, exponential(strain)).energy; };
  Differences result;
  result.forces.resize(6 * measured.state.size(), 6);
  for (int i = 0; i < 6; ++i) {
    const Matrix3d e_i = h * basis_tensor(i);
    result.forces.col(i) =
        (strained(measured, exponential(e_i)).gradient - strained(measured, exponential(-e_i)).gradient) / (2 * h);
    for (int j = 0; j < 6; ++j) {
      const Matrix3d e_j = h * basis_tensor(j);
      result.affine(i, j) =
          (energy(e_i + e_j) - energy(e_i - e_j) - energy(e_j - e_i) + energy(-e_i - e_j)) / (4 * h * h);
    }
  }
  return result;
}

TEST_P(Moduli, TensorIsThatOfExplicitStrains) {
  // Only states whose contacts are deep enough for differences.
  for (const std::size_t s : {std::size_t{0}, std::size_t{2}}) {
    const Measured measured(result.states[s]);
    const double volume = measured.state.cell.volume();
    const auto tensor = measured.tensor();
    ASSERT_TRUE(tensor);
    const Differences differences = by_differences(measured, 2e-6);
    const Matrix6d affine = differences.affine / volume;
    const double scale = tensor->affine.norm();
    EXPECT_LE((tensor->affine - affine).norm(), 3e-4 * scale) << tensor->affine - affine;
    // This pseudo-inverse ignores translations.
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> dense(dense_matrix(measured.hessian));
    ASSERT_EQ(dense.rank(), 6 * measured.state.size() - 3);
    const Matrix6d relaxed =
        affine - differences.forces.transpose() * MatrixXd(dense.solve(differences.forces)) / volume;
    EXPECT_LE((tensor->relaxed - relaxed).norm(), 3e-4 * scale) << tensor->relaxed - relaxed;
    EXPECT_GT((tensor->relaxed - tensor->affine).norm(), 0.1 * tensor->affine.norm()) << "relaxation matters";
  }
}

TEST(ElasticTensor, IsotropicTensorsGiveTheirModuli) {
  ElasticTensor tensor;
  tensor.pressure = 0.25;
  const double bulk = 3, shear = 0.5;
  tensor.relaxed = 2 * shear * Matrix6d::Identity();
  tensor.relaxed.topLeftCorner<3, 3>().array() += (3 * (bulk - tensor.pressure) - 2 * shear) / 3;
  tensor.affine = 2 * tensor.relaxed;
  EXPECT_NEAR(tensor.bulk_modulus(), bulk, 1e-14);
  EXPECT_NEAR(tensor.affine_bulk_modulus(), 2 * bulk - tensor.pressure, 1e-14);
  EXPECT_NEAR(tensor.mean_shear_modulus(), shear, 1e-14);
  for (const double g : tensor.shear_moduli()) EXPECT_NEAR(g, shear, 1e-14);
  // Shear in one plane with a negative modulus.
  tensor.relaxed(5, 5) = -2;
  EXPECT_NEAR(tensor.shear_moduli()[0], -1, 1e-14);
  EXPECT_NEAR(tensor.shear_moduli()[1], shear, 1e-14);
}

TEST_P(Moduli, UndefinedIfParticlesAreUnconstrained) {
  const Measured measured(result.states.front());
  Measured free = measured;
  for (Matrix6d& block : free.hessian.diagonal) block.setZero();
  free.hessian.off_diagonal.clear();
  EXPECT_FALSE(free.tensor());
  Measured loose = measured;
  loose.hessian.diagonal[7](4, 4) = -1;
  EXPECT_FALSE(loose.tensor());
  // A particle without contacts is ignored.
  Measured more = measured;
  more.state.poses.push_back(Pose{});
  more.hessian.diagonal.push_back(Matrix6d::Zero());
  ASSERT_TRUE(more.tensor());
  EXPECT_EQ(more.tensor()->relaxed, measured.tensor()->relaxed);
}

}  // namespace
}  // namespace isojam
