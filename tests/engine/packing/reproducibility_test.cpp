#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "engine/packing/energy.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;

constexpr int particles = 300;  // thousands of pairs, enough for several threads
constexpr double density = .7;

/// All results of the energy for a packing.
struct Answer {
  Evaluation evaluation, in_double_double;
  SecondOrder second, second_in_double_double;
  std::vector<Contact> contacts;
};

Answer answer(PackingEnergy& energy, const Packing& packing) {
  return {energy.evaluate(packing), energy.evaluate(packing, Precision::double_double),
          energy.second_order(packing, 0.01), energy.second_order(packing, 0.01, Precision::double_double),
          energy.contacts(packing)};
}

Answer fresh(const Packing& packing) {
  PackingEnergy energy;
  return answer(energy, packing);
}

void expect_same_bits(const Evaluation& one, const Evaluation& two) {
  EXPECT_EQ(one.energy, two.energy);
  EXPECT_EQ((one.gradient.array() != two.gradient.array()).count(), 0);
  EXPECT_EQ((one.stress.array() != two.stress.array()).count(), 0) << one.stress - two.stress;
  EXPECT_EQ(one.pressure, two.pressure);
  EXPECT_EQ(one.mean_force, two.mean_force);
  EXPECT_EQ(one.residual, two.residual);
  EXPECT_EQ(one.residual_floor, two.residual_floor);
  EXPECT_EQ(one.energy_noise, two.energy_noise);
  EXPECT_EQ(one.contacts, two.contacts);
}

void expect_same_bits(const LinearisedOverlap& one, const LinearisedOverlap& two) {
  EXPECT_EQ(one.at_rest, two.at_rest);
  EXPECT_EQ(one.slope_a, two.slope_a);
  EXPECT_EQ(one.slope_b, two.slope_b);
}

void expect_same_bits(const SecondOrder& one, const SecondOrder& two) {
  ASSERT_EQ(one.hessian.size(), two.hessian.size());
  ASSERT_EQ(one.hessian.off_diagonal.size(), two.hessian.off_diagonal.size());
  ASSERT_EQ(one.pairs.size(), two.pairs.size());
  for (int i = 0; i < one.hessian.size(); ++i)
    EXPECT_EQ(one.hessian.diagonal[i], two.hessian.diagonal[i]) << "particle " << i;
  for (std::size_t k = 0; k < one.hessian.off_diagonal.size(); ++k) {
    EXPECT_EQ(one.hessian.off_diagonal[k].row, two.hessian.off_diagonal[k].row);
    EXPECT_EQ(one.hessian.off_diagonal[k].column, two.hessian.off_diagonal[k].column);
    EXPECT_EQ(one.hessian.off_diagonal[k].value, two.hessian.off_diagonal[k].value) << "block " << k;
  }
  for (std::size_t k = 0; k < one.pairs.size(); ++k) {
    EXPECT_EQ(one.pairs[k].a, two.pairs[k].a);
    EXPECT_EQ(one.pairs[k].b, two.pairs[k].b);
    EXPECT_EQ(one.pairs[k].tilt, two.pairs[k].tilt) << "pair " << k;
    expect_same_bits(one.pairs[k].now, two.pairs[k].now);
    expect_same_bits(one.pairs[k].closed, two.pairs[k].closed);
  }
}

void expect_same_bits(const Answer& one, const Answer& two) {
  ASSERT_GT(one.evaluation.contacts, particles);
  expect_same_bits(one.evaluation, two.evaluation);
  expect_same_bits(one.in_double_double, two.in_double_double);
  expect_same_bits(one.second, two.second);
  expect_same_bits(one.second_in_double_double, two.second_in_double_double);
  ASSERT_EQ(one.contacts.size(), two.contacts.size());
  for (std::size_t k = 0; k < one.contacts.size(); ++k) {
    const Contact &c = one.contacts[k], &d = two.contacts[k];
    EXPECT_TRUE(c.pair.a == d.pair.a && c.pair.b == d.pair.b && c.pair.shift == d.pair.shift) << "contact " << k;
    EXPECT_TRUE(c.displacement == d.displacement && c.pose.rotation == d.pose.rotation) << "contact " << k;
    EXPECT_TRUE(c.overlap.volume == d.overlap.volume && c.overlap.area == d.overlap.area &&
                c.overlap.moment == d.overlap.moment && c.overlap.path == d.overlap.path)
        << "contact " << k;
    EXPECT_TRUE(c.overlap.faces_a == d.overlap.faces_a && c.overlap.edges_b == d.overlap.edges_b) << "contact " << k;
  }
}

TEST(ReproducibilityTest, OtherPackingsBeforeChangeNothing) {
  PackingEnergy used;
  for (const Packing& packing : samples(31, particles, density)) {
    SCOPED_TRACE(describe(packing));
    used.evaluate(strained_to(packing, .4));
    used.hessian(sample(SolidKind::cube, 90, .9, 31));
    used.evaluate(
        sample(SolidKind::tetrahedron, particles, density, 32));  // the same size, but another solid or other positions
    expect_same_bits(answer(used, packing), fresh(packing));
  }
}

TEST(ReproducibilityTest, AnotherCellBeforeChangesNothing) {
  for (const Packing& packing : samples(35, particles, density)) {
    SCOPED_TRACE(describe(packing));
    PackingEnergy used;
    // No particle moves, but images do.
    Packing wider = packing;
    wider.cell = PeriodicCell(1.2 * packing.cell.side());
    used.evaluate(wider);
    expect_same_bits(answer(used, packing), fresh(packing));
  }
}

TEST(ReproducibilityTest, AnotherSolidBeforeChangesNothing) {
  for (const Packing& packing : samples(36, particles, density)) {
    SCOPED_TRACE(describe(packing));
    PackingEnergy used;
    // Only the solid differs. The dodecahedron has the smallest reach.
    Packing other = packing;
    other.solids =
        platonic(packing.solids.only().name() == "dodecahedron" ? SolidKind::icosahedron : SolidKind::dodecahedron);
    used.evaluate(other);
    expect_same_bits(answer(used, packing), fresh(packing));
  }
}

/// Number of pairs in the list that an evaluation uses. Different lists with thousands of pairs have different lengths.
long listed_by(PackingEnergy& energy, const Packing& packing) {
  const long before = energy.counts().listed;
  energy.evaluate(packing);
  return energy.counts().listed - before;
}

TEST(ReproducibilityTest, EarlierMovesChangeNothing) {
  for (const Packing& packing : samples(33, particles, density)) {
    SCOPED_TRACE(describe(packing));
    RandomStream random{33};
    PackingEnergy used;
    Packing current = packing;
    long kept = 0, rebuilt = 0, before = listed_by(used, current);
    for (const double length : {1e-3, 1e-2, 1e-2, 1e-1, 1e-3, 1e-2}) {
      current = moved(current, length * random_step(random, particles));
      const long listed = listed_by(used, current);
      ++(listed == before ? kept : rebuilt);
      before = listed;
    }
    EXPECT_GT(kept, 0) << "no evaluation used the list of the one before";
    EXPECT_GT(rebuilt, 0) << "one list served the whole walk";
    expect_same_bits(answer(used, current), fresh(current));
    // The packing returns to its initial state in one step.
    EXPECT_NE(listed_by(used, packing), before) << "the list of the walk's end serves its start";
    expect_same_bits(answer(used, packing), fresh(packing));
  }
}

TEST(ReproducibilityTest, TheNumberOfThreadsChangesNothing) {
  for (const Packing& packing : samples(34, particles, density)) {
    SCOPED_TRACE(describe(packing));
    const auto with_threads = [&](std::size_t threads) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      return fresh(packing);
    };
    const Answer one = with_threads(1);
    for (int again = 0; again < 3; ++again) expect_same_bits(one, with_threads(2));
  }
}

// Sums of products are rounded differently if they are divided into other blocks. The cache sizes that Eigen reads from
// the processor differ between machines, and its default sizes can differ between versions.
TEST(ReproducibilityTest, TheCachesOfTheMachineChangeNothing) {
  constexpr std::ptrdiff_t kibibyte = 1024;
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * kibibyte);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 * kibibyte);
  EXPECT_EQ(Eigen::l3CacheSize(), 2048 * kibibyte);
}

TEST(ReproducibilityTest, PairsThatApproachFromBeyondTheListAreFound) {
  const ConvexSolid& octahedron = platonic(SolidKind::octahedron);
  const double r = octahedron.circumradius();
  Packing packing{octahedron, PeriodicCell(10), std::vector<Pose>(2)};
  packing.poses[1].position.x() = 2.165 * r;
  PackingEnergy energy;
  EXPECT_EQ(energy.evaluate(packing).contacts, 0);
  // Each centre moves by less than the skin of the list, 0.15 r, and the distance shrinks by more.
  packing.poses[0].position.x() += 0.1 * r;
  packing.poses[1].position.x() -= 0.1 * r;
  EXPECT_EQ(energy.evaluate(packing).contacts, 1);
}

}  // namespace
}  // namespace isojam
