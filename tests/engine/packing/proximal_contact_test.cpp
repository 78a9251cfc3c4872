#include "engine/packing/envelope/proximal_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/packing/packing.hpp"

namespace isojam {
namespace {

struct Pair {
  const ConvexSolid* solid = nullptr;
  Pose a, b;

  double radius() const { return solid->gyration_radius(); }
};

LonePlacedSolid placed(const Pair& pair) { return {*pair.solid, rotation_matrix(pair.a)}; }

DoubleDoubleVector displacement(const Pose& a, const Pose& b) {
  DoubleDoubleVector r;
  for (int c = 0; c < 3; ++c) r.set(c, b.coordinate(c) - a.coordinate(c));
  return r;
}

ProximalContact envelope(const Pair& pair, const ProximalTerms& terms, const Vector6d& start = Vector6d::Zero()) {
  return proximal_contact(placed(pair), *pair.solid, pair.b, displacement(pair.a, pair.b), terms, start);
}

double normal_below(RandomStream& random, double size) { return size * random.normal(); }

Vector6d random_vector(RandomStream& random, double size) {
  Vector6d v;
  for (double& entry : v) entry = normal_below(random, size);
  return v;
}

Pose turned(const Pose& pose, RandomStream& random) {
  Pose result = pose;
  for (int c = 0; c < 4; ++c) result.orientation.coeffs()[c] = random.normal();
  result.orientation.normalize();
  return result;
}

/// A pair whose distance differs from that at contact by up to `depth`, in either direction. The distance is found by
/// bisection.
Pair random_pair(SolidKind kind, double depth, RandomStream& random) {
  Pair pair{&platonic(kind), {}, {}};
  pair.a = turned(pair.a, random);
  pair.b = turned(pair.b, random);
  const Eigen::Vector3d axis = turned({}, random).orientation * Eigen::Vector3d::UnitX();
  double low = 0, high = 2 * pair.solid->circumradius();
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    pair.b.position = middle * axis;
    (pair_energy(placed(pair), LonePlacedSolid(*pair.solid, rotation_matrix(pair.b)), displacement(pair.a, pair.b))
                 .energy > 0
         ? low
         : high) = middle;
  }
  pair.b.position = (low - depth * (2 * random.uniform() - 0.5)) * axis;
  return pair;
}

/// e(w) + ½ρ|w|² − μ·w from its definition; the ghost is a separate body.
double minimand(const Pair& pair, const ProximalTerms& terms, const Vector6d& w) {
  Pose ghost = pair.b;
  const Eigen::Vector3d half = w.tail<3>() / (2 * pair.radius());
  const Eigen::Quaterniond turn(std::sqrt(1 - half.squaredNorm()), half[0], half[1], half[2]);
  const Eigen::Quaterniond q = pair.b.orientation * turn;
  ghost = moved_by_half_rotation(ghost, pair.b.orientation * Eigen::Vector3d(w.head<3>()),
                                 (q * pair.b.orientation.conjugate()).vec());
  const double e =
      pair_energy(placed(pair), LonePlacedSolid(*pair.solid, rotation_matrix(ghost)), displacement(pair.a, ghost))
          .energy;
  return e + terms.stiffness / 2 * w.squaredNorm() - terms.multiplier.dot(w);
}

struct Case {
  Pair pair;
  ProximalTerms terms;
};

/// Multipliers of the order of the contact's own force, and stiffnesses with which such a force causes a shift of up to
/// a depth.
Case random_case(SolidKind kind, RandomStream& random) {
  const double depth = std::pow(10, -1 - 3 * random.uniform());
  Case made{random_pair(kind, depth, random), {}};
  const PairEnergy pair =
      pair_energy(placed(made.pair), LonePlacedSolid(*made.pair.solid, rotation_matrix(made.pair.b)),
                  displacement(made.pair.a, made.pair.b));
  const double force = std::max(pair.gradient_b.norm(), std::pow(depth, 5));
  made.terms.multiplier = to_body(made.pair.b, pair.gradient_b) + random_vector(random, force / 2);
  made.terms.stiffness = force / depth * std::pow(10, 2 * random.uniform());
  return made;
}

class ProximalContactOf : public testing::TestWithParam<SolidKind> {};
INSTANTIATE_TEST_SUITE_P(Solids, ProximalContactOf, testing::ValuesIn(all_solids),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(ProximalContactOf, NoOtherShiftIsBetter) {
  RandomStream random{301, static_cast<std::uint64_t>(GetParam())};
  int touching = 0;
  for (int k = 0; k < 60; ++k) {
    const auto [pair, terms] = random_case(GetParam(), random);
    const ProximalContact found = envelope(pair, terms);
    EXPECT_TRUE(found.converged) << "case " << k;
    touching += found.touching;
    const double here = minimand(pair, terms, found.shift);
    const double scale = std::abs(found.value) + terms.stiffness * found.shift.squaredNorm();
    EXPECT_NEAR(here, found.value, 1e-9 * scale) << "case " << k;
    EXPECT_LE(found.value, minimand(pair, terms, Vector6d::Zero()) + 1e-12 * scale) << "case " << k;
    EXPECT_LT((found.wrench - terms.multiplier + terms.stiffness * found.shift).norm(),
              1e-8 * (terms.multiplier.norm() + found.wrench.norm()))
        << "case " << k;
    for (const double part : {1e-3, 1e-1, 1.0}) {
      const Vector6d beside = found.shift + random_vector(random, part * (found.shift.norm() + 1e-12));
      EXPECT_GE(minimand(pair, terms, beside), found.value - 1e-12 * scale) << "case " << k << ", part " << part;
    }
  }
  EXPECT_GT(touching, 20);
}

TEST_P(ProximalContactOf, DerivativesAgreeWithDifferences) {
  RandomStream random{302, static_cast<std::uint64_t>(GetParam())};
  double worst_gradient = 0, worst_curvature = 0, worst_change = 0;
  int compared = 0;
  for (int k = 0; k < 60; ++k) {
    const Case made = random_case(GetParam(), random);
    const Pair& pair = made.pair;
    const ProximalTerms& terms = made.terms;
    const ProximalContact here = envelope(pair, terms);
    if (!here.touching) continue;
    ++compared;
    const Vector6d a = random_vector(random, 1), b = random_vector(random, 1);
    const double size = here.shift.norm() + here.wrench.norm() / terms.stiffness;
    const double h = 1e-5 * size;
    const auto at = [&](double t) {
      Pair there = pair;
      there.a = moved(pair.a, t * a.head<3>(), t * a.tail<3>() / pair.radius());
      there.b = moved(pair.b, t * b.head<3>(), t * b.tail<3>() / pair.radius());
      return envelope(there, terms, here.shift);
    };
    const ProximalContact forth = at(h), back = at(-h);
    const double slope = here.gradient_a.dot(a) + here.gradient_b.dot(b);
    const double scale = here.gradient_a.norm() + here.gradient_b.norm() + terms.stiffness * size;
    worst_gradient = std::max(worst_gradient, std::abs((forth.value - back.value) / (2 * h) - slope) / scale);
    const double second =
        (forth.gradient_a.dot(a) + forth.gradient_b.dot(b) - back.gradient_a.dot(a) - back.gradient_b.dot(b)) / (2 * h);
    const double predicted = here.predicted(a, b) - here.value - slope;
    const PairHessian c = here.curvature();
    EXPECT_NEAR(predicted, (a.dot(c.aa * a) + 2 * a.dot(c.ab * b) + b.dot(c.bb * b)) / 2, 1e-9 * terms.stiffness * 12);
    // The differences are accurate to first order in the shift, which can rotate the ghost. Steps across a kink are
    // skipped.
    if (std::abs(forth.energy - back.energy) > 0.1 * here.energy) continue;
    const double first_order = here.shift.norm() + 1e-4;
    worst_curvature =
        std::max(worst_curvature, std::abs(second - 2 * predicted) / (12 * terms.stiffness * first_order));
    const Vector6d change = to_lab(pair.b, forth.shift - back.shift) / (2 * h);
    worst_change =
        std::max(worst_change, (change - here.shift_change(a, b)).norm() / ((a.norm() + b.norm()) * first_order));
  }
  std::printf("%d pairs: gradient to %.1e, curvature to %.1f |w|, change of the shift to %.1f |w|\n", compared,
              worst_gradient, worst_curvature, worst_change);
  EXPECT_GT(compared, 20);
  EXPECT_LT(worst_gradient, 1e-6);
  EXPECT_LT(worst_curvature, 10);
  EXPECT_LT(worst_change, 10);
}

TEST_P(ProximalContactOf, ALastStepByASeriesIsAccurateAndSavesOverlaps) {
  RandomStream random{306, static_cast<std::uint64_t>(GetParam())};
  long overlaps = 0, saved = 0;
  double worst_value = 0, worst_gradient = 0;
  for (int k = 0; k < 60; ++k) {
    const auto [pair, terms] = random_case(GetParam(), random);
    const ProximalContact exact = envelope(pair, terms);
    ProximalTerms loose = terms;
    loose.series_below = 1e-3;
    const ProximalContact found = envelope(pair, loose);
    overlaps += exact.iterations, saved += exact.iterations - found.iterations;
    EXPECT_EQ(found.touching, exact.touching);
    const double force = exact.wrench.norm() + terms.multiplier.norm();
    worst_gradient = std::max(worst_gradient, (found.gradient_b - exact.gradient_b).norm() / force);
    worst_value = std::max(worst_value, std::abs(found.value - exact.value) / (force * force / terms.stiffness));
  }
  std::printf("%ld of %ld overlaps saved; error of the gradient %.1e, of Φ %.1e of f²/ρ\n", saved, overlaps,
              worst_gradient, worst_value);
  EXPECT_GT(saved, overlaps / 5);
  EXPECT_LT(worst_gradient, 1e-4);
  EXPECT_LT(worst_value, 1e-6);
}

TEST_P(ProximalContactOf, APlainContactIsThePairItself) {
  RandomStream random{307, static_cast<std::uint64_t>(GetParam())};
  for (int k = 0; k < 30; ++k) {
    const Pair pair = random_case(GetParam(), random).pair;
    const LonePlacedSolid placed_b(*pair.solid, rotation_matrix(pair.b));
    const DoubleDoubleVector r = displacement(pair.a, pair.b);
    const PairEnergy e = pair_energy(placed(pair), placed_b, r);
    const ProximalContact plain = plain_contact(placed(pair), placed_b, pair.b, r);
    EXPECT_EQ(plain.value, e.energy);
    EXPECT_EQ(plain.gradient_a, e.gradient_a);
    EXPECT_EQ(plain.gradient_b, e.gradient_b);
    EXPECT_EQ(plain.curvature().ab, e.hessian.ab);
    const Vector6d a = random_vector(random, 1), b = random_vector(random, 1);
    const double second = a.dot(e.hessian.aa * a) + 2 * a.dot(e.hessian.ab * b) + b.dot(e.hessian.bb * b);
    const double expected = e.energy + e.gradient_a.dot(a) + e.gradient_b.dot(b) + second / 2;
    EXPECT_NEAR(plain.predicted(a, b), expected, 1e-12 * (std::abs(expected) + std::abs(second)));
    EXPECT_EQ(plain.shift_change(a, b).norm(), 0);
  }
}

TEST_P(ProximalContactOf, GapIsShiftedByItsMultiplierAndHasNoForce) {
  RandomStream random{304, static_cast<std::uint64_t>(GetParam())};
  Pair pair = random_pair(GetParam(), 1e-3, random);
  pair.b.position *= 1.1;
  const ProximalTerms terms{random_vector(random, 1e-6), 1e-3};
  const ProximalContact found = envelope(pair, terms);
  EXPECT_FALSE(found.touching);
  EXPECT_LT((found.shift - terms.multiplier / terms.stiffness).norm(), 1e-12 * found.shift.norm());
  EXPECT_NEAR(found.value, -terms.multiplier.squaredNorm() / (2 * terms.stiffness), 1e-12 * std::abs(found.value));
  EXPECT_EQ(found.gradient_a.norm() + found.gradient_b.norm(), 0);
  const ProximalContact nothing = envelope(pair, {Vector6d::Zero(), 1e-3});
  EXPECT_EQ(nothing.value, 0);
  EXPECT_EQ(nothing.shift.norm(), 0);
}

TEST(ProximalContact, PressedFacesAreASpringInClosedForm) {
  const ConvexSolid& cube = platonic(SolidKind::cube);
  for (const double depth : {1e-2, 1e-5, 1e-8, 1e-10}) {
    // A face on a face, one rotated by 45°. At this angle the common area is smallest, V = A·depth, and the force
    // passes through both centres without a torque.
    Pair pair{&cube, {}, {}};
    pair.b.position = {1, 0, 0};
    pair.b.position_low = {-depth, 0, 0};
    pair.b.orientation = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitX());
    const double k =
        unshifted_contact(placed(pair), *pair.solid, pair.b, displacement(pair.a, pair.b), 1).wrench.norm() / depth;
    EXPECT_GT(k, 0.1) << "A²/2";
    // With a smaller stiffness, the minimum would be at a sideways shift, because sliding reduces the common area.
    for (const double stiffness : {100 * depth * depth * k, 1e-3 * k, k}) {
      ProximalTerms terms{Vector6d::Zero(), stiffness};
      terms.multiplier[0] = -0.3 * k * depth;
      // The minimum of e(w) + ½ρw² − μw, where e(w) = k (depth − w)²/2.
      const double w = (k * depth + terms.multiplier[0]) / (k + stiffness);
      const ProximalContact found = envelope(pair, terms);
      std::printf("depth %.0e, ρ/k %.0e: shift %.9e, expected %.9e\n", depth, stiffness / k, found.shift[0], w);
      EXPECT_TRUE(found.converged);
      EXPECT_NEAR(found.shift[0], w, 1e-9 * w);
      EXPECT_LT(found.shift.tail<5>().norm(), 1e-6 * w);
      EXPECT_NEAR(found.wrench[0], -k * (depth - w), 1e-9 * k * depth);
      EXPECT_NEAR(found.value, k * std::pow(depth - w, 2) / 2 + stiffness * w * w / 2 - terms.multiplier[0] * w,
                  1e-9 * k * depth * depth);
    }
  }
}

// Near jamming, stiffnesses of 0.1 and of 1e-11 occur in one contact, and only the small ones make the packing stable.
// Rounding errors that mix the two must not appear as a negative curvature.
TEST(ProximalContact, FlatFacesSlideWithoutNegativeCurvature) {
  const ConvexSolid& cube = platonic(SolidKind::cube);
  RandomStream random{306, 0};
  for (const double depth : {1e-9, 1e-11, 1e-13}) {
    double least = 0, worst = 0, force = 0;
    for (int k = 0; k < 20; ++k) {
      const Eigen::Quaterniond frame = turned({}, random).orientation;
      Pair pair{&cube, {}, {}};
      pair.a.orientation = frame;
      pair.b.orientation = frame * Eigen::AngleAxisd(random.uniform(), Eigen::Vector3d::UnitX());
      pair.b.position = frame * Eigen::Vector3d(1 - depth, 0.3 * random.uniform(), 0.3 * random.uniform());
      force =
          unshifted_contact(placed(pair), *pair.solid, pair.b, displacement(pair.a, pair.b), 1).wrench.head<3>().norm();
      // A lower-order contact with this force has a depth of about the fifth root of the force.
      const double soft = force / std::pow(force, 0.2);
      const ProximalContact contact =
          unshifted_contact(placed(pair), *pair.solid, pair.b, displacement(pair.a, pair.b), 300 * soft);
      const Matrix6d curvature = contact.curvature().bb;
      least = std::min(least, Eigen::SelfAdjointEigenSolver<Matrix6d>(curvature).eigenvalues()[0] / soft);
      const Vector6d step = random_vector(random, 1);
      const double predicted = contact.predicted(Vector6d::Zero(), step) - contact.value - contact.gradient_b.dot(step);
      worst = std::max(worst, std::abs(2 * predicted - step.dot(curvature * step)) / (300 * soft * step.squaredNorm()));
    }
    std::printf("depth %.0e: least eigenvalue %.1e of soft contacts', predictions to %.1e of ρ\n", depth, least, worst);
    // Forces rotate with their contacts, which causes curvatures of this order.
    EXPECT_GT(least, -3 * std::pow(force, 0.2));
    EXPECT_LT(worst, 1e-6);
  }
}

}  // namespace
}  // namespace isojam
