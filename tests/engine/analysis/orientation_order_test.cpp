#include "engine/analysis/orientation_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/analysis/order.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using constructed::random_orientation;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector3i;

Packing scattered(const ConvexSolid& solid, int n, double side, RandomStream& random) {
  Packing packing{solid, PeriodicCell(side), {}};
  for (int k = 0; k < n; ++k) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    packing.poses.push_back({.position = side * Vector3d(x, y, z), .orientation = random_orientation(random)});
  }
  return packing;
}

/// Σ_vw P_l(v·w) over the vertices of two particles.
double double_sum(const ConvexSolid& solid, const Quaterniond& p, const Quaterniond& q, unsigned l) {
  double sum = 0;
  for (const Vector3d& v : solid.vertices()) {
    for (const Vector3d& w : solid.vertices())
      sum += std::legendre(l, std::clamp((p * v.normalized()).dot(q * w.normalized()), -1.0, 1.0));
  }
  return sum;
}

/// A random rotation that maps the solid to itself. There are as many such rotations as directed edges.
Quaterniond symmetry(const ConvexSolid& solid, RandomStream& random) {
  const auto frame = [&](const Edge& edge, bool reversed) {
    const Vector3d tail = solid.vertices()[edge.tail], head = solid.vertices()[edge.head];
    Eigen::Matrix3d m;
    m.col(0) = (reversed ? tail - head : head - tail).normalized();
    m.col(2) = (tail + head).normalized();
    m.col(1) = m.col(2).cross(m.col(0));
    return m;
  };
  const auto e = static_cast<std::size_t>(random.uniform() * static_cast<double>(solid.edges().size()));
  const Eigen::Matrix3d to = frame(solid.edges()[e], random.uniform() < 0.5);
  return Quaterniond(Eigen::Matrix3d(to * frame(solid.edges()[0], false).transpose()));
}

double order_of(const Packing& packing) {
  return orientation_order(orientation_harmonics(packing, orientation_rank(packing.solids.only())));
}

class OrientationOf : public testing::TestWithParam<SolidKind> {
 protected:
  const ConvexSolid& solid = platonic(GetParam());
  const unsigned rank = orientation_rank(solid);
  RandomStream random{61, static_cast<std::uint64_t>(GetParam())};
};

TEST_P(OrientationOf, RankIsTheFirstThatDoesNotVanish) {
  const unsigned expected = GetParam() == SolidKind::tetrahedron                                   ? 3
                            : GetParam() == SolidKind::cube || GetParam() == SolidKind::octahedron ? 4
                                                                                                   : 6;
  EXPECT_EQ(rank, expected);
  const double terms = std::pow(static_cast<double>(solid.vertices().size()), 2);
  for (unsigned l = 1; l < rank; ++l)
    EXPECT_NEAR(double_sum(solid, Quaterniond::Identity(), Quaterniond::Identity(), l) / terms, 0, 1e-14) << l;
  EXPECT_GT(double_sum(solid, Quaterniond::Identity(), Quaterniond::Identity(), rank) / terms, 0.05);
}

TEST_P(OrientationOf, ProductsAreDoubleSums) {
  const Packing packing = scattered(solid, 12, 10, random);
  const MatrixXd harmonics = orientation_harmonics(packing, rank);
  ASSERT_EQ(harmonics.rows(), 2 * rank + 1);
  const double self = double_sum(solid, Quaterniond::Identity(), Quaterniond::Identity(), rank);
  for (int i = 0; i < packing.size(); ++i) {
    for (int j = 0; j < packing.size(); ++j) {
      const double expected =
          double_sum(solid, packing.poses[i].orientation, packing.poses[j].orientation, rank) / self;
      EXPECT_NEAR(harmonics.col(i).dot(harmonics.col(j)), expected, 1e-12) << i << ", " << j;
    }
  }
}

TEST_P(OrientationOf, SymmetriesKeepParticlesAligned) {
  Packing packing = scattered(solid, 40, 10, random);
  const Quaterniond common = random_orientation(random), other = random_orientation(random);
  for (Pose& pose : packing.poses) pose.orientation = common * symmetry(solid, random);
  EXPECT_NEAR(order_of(packing), 1, 1e-12);
  for (int k = 0; k < 20; ++k) packing.poses[k].orientation = other * symmetry(solid, random);
  const MatrixXd harmonics = orientation_harmonics(packing, rank);
  const double q = harmonics.col(0).dot(harmonics.col(39));
  EXPECT_LT(q, 1 - 1e-6);
  EXPECT_NEAR(orientation_order(harmonics), std::sqrt((1 + q) / 2), 1e-12);
}

/// The orientation `q` followed by rotations about three axes by angles with this standard deviation.
Quaterniond disturbed(const Quaterniond& q, double deviation, RandomStream& random) {
  // A uniform number in (−√3, √3) has the variance 1.
  const auto angle = [&] { return deviation * std::sqrt(3.0) * (2 * random.uniform() - 1); };
  const double a = angle(), b = angle(), c = angle();
  return q * Quaterniond(Eigen::AngleAxisd(a, Vector3d::UnitX())) *
         Quaterniond(Eigen::AngleAxisd(b, Vector3d::UnitY())) * Quaterniond(Eigen::AngleAxisd(c, Vector3d::UnitZ()));
}

/// Contacts between each particle and its six neighbours on a simple cubic lattice with `side` particles per edge.
std::vector<Contact> lattice_contacts(int side) {
  std::vector<Contact> contacts;
  const auto index = [&](int x, int y, int z) { return (x % side * side + y % side) * side + z % side; };
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        for (const int other : {index(x + 1, y, z), index(x, y + 1, z), index(x, y, z + 1)}) {
          Contact contact;
          contact.pair.a = index(x, y, z);
          contact.pair.b = other;
          contact.displacement = Vector3d::UnitX();
          contacts.push_back(contact);
        }
      }
    }
  }
  return contacts;
}

TEST_P(OrientationOf, LimitsSeparateRandomOrientationsFromCrystals) {
  constexpr int side = 8, n = side * side * side, sets = 20;
  constexpr double five_degrees = 0.087;
  const auto contacts = lattice_contacts(side);
  const OrderLimits limits = order_limits(rank);
  for (int set = 0; set < sets; ++set) {
    Packing packing = scattered(solid, n, 20, random);
    EXPECT_FALSE(is_aligned(order_of(packing, contacts)));
    packing.poses.resize(64);
    EXPECT_LT(order_of(packing, {}).S.value(), limits.S) << "also for few particles";
    packing = scattered(solid, n, 20, random);
    for (Pose& pose : packing.poses) pose.orientation = disturbed(Quaterniond::Identity(), five_degrees, random);
    const Order crystal = order_of(packing, contacts);
    EXPECT_GT(crystal.S.value(), limits.S);
    EXPECT_GT(crystal.local_S.value(), limits.local_S);
    // Eight grains of 4³ particles. A quarter of all contacts is between grains.
    std::vector<Quaterniond> grains;
    for (int k = 0; k < 8; ++k) grains.push_back(random_orientation(random));
    for (int k = 0; k < n; ++k) {
      const int x = k / (side * side), y = k / side % side, z = k % side;
      packing.poses[k].orientation = disturbed(grains[x / 4 * 4 + y / 4 * 2 + z / 4], five_degrees / 2, random);
    }
    const Order polycrystal = order_of(packing, contacts);
    EXPECT_TRUE(is_aligned(polycrystal));
    EXPECT_GT(polycrystal.local_S.value(), limits.local_S);
    const MatrixXd harmonics = orientation_harmonics(packing, rank);
    double sum = 0;
    for (const Contact& c : contacts) sum += harmonics.col(c.pair.a).dot(harmonics.col(c.pair.b));
    EXPECT_NEAR(polycrystal.local_S.value(), sum / static_cast<double>(contacts.size()), 1e-12);
    EXPECT_EQ(polycrystal.random_local_S, 1 / std::sqrt((2.0 * rank + 1) * static_cast<double>(contacts.size())));
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, OrientationOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST(OrientationOrder, OfABoxIsNematic) {
  std::vector<Vector3d> box;
  for (int k = 0; k < 8; ++k) box.emplace_back(k & 1 ? 1 : -1, k & 2 ? 2 : -2, k & 4 ? 3 : -3);
  EXPECT_EQ(orientation_rank(ConvexSolid("box", box)), 2U);
}

/// n³ cubes at distance 1 that fill the cell. Each touches its six neighbours.
struct Lattice {
  Packing packing;
  std::vector<Contact> contacts;
};

Lattice simple_cubic(int n) {
  Lattice lattice{{platonic(SolidKind::cube), PeriodicCell(n), {}}, {}};
  for (int k = 0; k < n * n * n; ++k)
    lattice.packing.poses.push_back({.position = Eigen::Vector3i(k % n, k / n % n, k / (n * n)).cast<double>()});
  for (const NeighbourPair& pair : find_neighbours(lattice.packing, 1.1)) {
    Contact contact;
    contact.pair = pair;
    contact.displacement = displacement(lattice.packing, pair);
    lattice.contacts.push_back(contact);
  }
  return lattice;
}

TEST(Order, OfASimpleCubicLattice) {
  const Lattice lattice = simple_cubic(4);
  ASSERT_EQ(lattice.contacts.size(), 3U * 64);
  const Order order = order_of(lattice.packing, lattice.contacts);
  EXPECT_NEAR(order.Q4, std::sqrt(7.0 / 12), 1e-12);
  EXPECT_NEAR(order.Q6, std::sqrt(1.0 / 8), 1e-12);
  EXPECT_NEAR(order.local_Q4.value(), std::sqrt(7.0 / 12), 1e-12);
  EXPECT_NEAR(order.local_Q6.value(), std::sqrt(1.0 / 8), 1e-12);
  EXPECT_NEAR(order.S.value(), 1, 1e-12);
  EXPECT_EQ(order.Q6, contact_q6(lattice.contacts));
}

TEST(Order, LocalOrderUsesOnlyTheOwnContacts) {
  std::vector<Contact> contacts(3);
  contacts[0].pair = {0, 1, Vector3i::Zero()};
  contacts[0].displacement = Vector3d::UnitX();
  contacts[1].pair = {1, 2, Vector3i::Zero()};
  contacts[1].displacement = Vector3d::UnitY();
  contacts[2].pair = {0, 2, Vector3i::Zero()};
  contacts[2].displacement = Vector3d(1, 1, 0);
  const auto local = local_steinhardt_order(contacts, 4, 4);
  const auto of = [](const Vector3d& u, const Vector3d& v) { return steinhardt_order(std::vector<Vector3d>{u, v}, 4); };
  EXPECT_NEAR(local[0].value(), of({1, 0, 0}, {1, 1, 0}), 1e-14);
  EXPECT_NEAR(local[1].value(), of({1, 0, 0}, {0, 1, 0}), 1e-14);
  EXPECT_NEAR(local[2].value(), of({0, 1, 0}, {1, 1, 0}), 1e-14);
  EXPECT_FALSE(local[3]);
}

Order measured(unsigned rank, double order, double local, int particles = 100) {
  Order result;
  result.rank = rank;
  result.S = order;
  result.random_S = 1 / std::sqrt(particles);
  result.local_S = local;
  return result;
}

TEST(Order, LimitsSeparateTheMeasuredPackings) {
  // The numbers are those of docs/results.md. Between 0.5 and 0.53, only cubes are disordered.
  EXPECT_FALSE(is_aligned(measured(4, 0.53, 0.50))) << "disordered cubes";
  EXPECT_TRUE(is_aligned(measured(4, 0.68, 0.50))) << "S of ordered cubes";
  EXPECT_TRUE(is_aligned(measured(4, 0.53, 0.62))) << "local S of ordered cubes";
  EXPECT_FALSE(is_aligned(measured(6, 0.41, 0.38))) << "disordered dodecahedra, and local S of crystals of icosahedra";
  for (const unsigned rank : {2U, 3U, 6U}) {
    EXPECT_TRUE(is_aligned(measured(rank, 0.52, 0))) << rank;
    EXPECT_TRUE(is_aligned(measured(rank, 0, 0.52))) << rank;
  }
  EXPECT_FALSE(is_aligned(measured(6, 0.58, 0, 36))) << "3.5/√36 is larger";
  EXPECT_TRUE(is_aligned(measured(6, 0.59, 0, 36)));
}

TEST(OrientationCorrelation, IsTheMeanOverPairs) {
  RandomStream random{63};
  for (const double side : {5.0, 9.0}) {
    const Packing packing = scattered(platonic(SolidKind::octahedron), 60, side, random);
    const MatrixXd harmonics = orientation_harmonics(packing, 4);
    const OrientationCorrelation found = orientation_correlation(packing, harmonics, {.width = 0.3});
    ASSERT_EQ(found.bins.size(), static_cast<std::size_t>(side / 2 / 0.3));
    std::vector<double> sums(found.bins.size(), 0.0);
    std::vector<long> pairs(found.bins.size(), 0);
    for (int i = 0; i < packing.size(); ++i) {
      for (int j = i + 1; j < packing.size(); ++j) {
        const double distance =
            packing.cell.nearest_image(packing.poses[j].position - packing.poses[i].position).norm();
        const auto bin = static_cast<std::size_t>(distance / 0.3);
        if (bin >= sums.size()) continue;
        ++pairs[bin];
        sums[bin] += harmonics.col(i).dot(harmonics.col(j));
      }
    }
    double weighted = 0;
    long all = 0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      EXPECT_EQ(found.bins[k].pairs, pairs[k]) << k;
      EXPECT_EQ(found.bins[k].mean.has_value(), pairs[k] > 0);
      if (pairs[k] == 0) continue;
      EXPECT_NEAR(*found.bins[k].mean, sums[k] / static_cast<double>(pairs[k]), 1e-12);
      weighted += sums[k];
      all += pairs[k];
    }
    // Products of independent unit vectors with 9 components have variance 1/9.
    EXPECT_LT(std::abs(weighted), 5 * std::sqrt(static_cast<double>(all) / 9));
  }
}

TEST(OrientationCorrelation, OfALatticeShowsItsShells) {
  const Lattice lattice = simple_cubic(6);
  const MatrixXd harmonics = orientation_harmonics(lattice.packing, 4);
  const OrientationCorrelation found =
      orientation_correlation(lattice.packing, harmonics, {.width = 0.1, .reach = 2.05});
  ASSERT_EQ(found.bins.size(), 20U);
  // There are 6, 12 and 8 neighbours at the distances 1, √2 and √3. Each pair counts once.
  for (std::size_t k = 0; k < found.bins.size(); ++k) {
    const long expected = k == 10 ? 3 : k == 14 ? 6 : k == 17 ? 4 : 0;
    EXPECT_EQ(found.bins[k].pairs, expected * 216) << k;
    EXPECT_NEAR(found.bins[k].mean.value_or(1), 1, 1e-12);
  }
  EXPECT_THROW(orientation_correlation(lattice.packing, harmonics, {.width = 0}), std::invalid_argument);
  EXPECT_THROW(orientation_correlation(lattice.packing, harmonics, {.reach = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
