// Reference: rounds that count contacts and use all eigenvectors of a dense matrix, summed pair by pair.

#include "engine/vibration/backbone.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

std::vector<int> first_numbers(int n) {
  std::vector<int> list(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) list[static_cast<std::size_t>(i)] = i;
  return list;
}

double bulk_modulus(const Packing& packing) {
  PackingEnergy energy;
  const auto here = energy.evaluate(packing, Precision::double_double);
  const auto hessian = energy.hessian(packing, Precision::double_double);
  const auto tensor = elastic_tensor(packing, hessian, energy.contacts(packing), here);
  return tensor ? tensor->bulk_modulus() : 0;
}

TEST(BackboneTest, OfJammedStatesIsTheWholePacking) {
  int whole = 0;
  for (const JamResult* result : {&jammed(SolidKind::octahedron, 48, .01), &jammed(SolidKind::tetrahedron, 64, .02),
                                  &jammed(SolidKind::icosahedron, 32, .01)}) {
    for (const Packing& state : result->states) {
      const Backbone backbone = backbone_of(state);
      std::printf("%s φ %.4f: %zu removed in %d rounds, residual %.1e\n", state.solids.only().name().data(),
                  state.density(), backbone.removed.size(), backbone.rounds, backbone.here.residual);
      if (!backbone.removed.empty()) continue;
      ++whole;
      EXPECT_EQ(backbone.kept, first_numbers(state.size()));
      EXPECT_EQ(backbone.rounds, 0);
      EXPECT_TRUE(same_bits(backbone.packing, state));
      EXPECT_EQ(backbone.stability.verdict, Verdict::stable);
      const auto tensor = elastic_tensor(backbone);
      ASSERT_TRUE(tensor);
      EXPECT_EQ(tensor->bulk_modulus(), bulk_modulus(state));
    }
  }
  EXPECT_GT(whole, 10);
}

/// The remaining particles according to the definition, with dense matrices. The Hessian is summed over packings of two
/// particles.
std::vector<int> by_definition(const Packing& packing, int& rounds) {
  constexpr auto precision = Precision::double_double;
  std::vector<int> kept = first_numbers(packing.size());
  for (rounds = 0; !kept.empty(); ++rounds) {
    const auto n = static_cast<int>(kept.size());
    MatrixXd full = MatrixXd::Zero(6 * n, 6 * n);
    std::vector<int> contacts(kept.size(), 0);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(6 * n);
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        const std::array two{kept[static_cast<std::size_t>(a)], kept[static_cast<std::size_t>(b)]};
        PackingEnergy energy;
        const Packing pair = part_of(packing, two);
        const Evaluation here = energy.evaluate(pair, precision);
        if (here.contacts == 0) continue;
        ++contacts[static_cast<std::size_t>(a)];
        ++contacts[static_cast<std::size_t>(b)];
        const MatrixXd both = dense(energy.hessian(pair, precision));
        full.block<6, 6>(6 * a, 6 * a) += both.topLeftCorner<6, 6>();
        full.block<6, 6>(6 * b, 6 * b) += both.bottomRightCorner<6, 6>();
        full.block<6, 6>(6 * a, 6 * b) += both.topRightCorner<6, 6>();
        full.block<6, 6>(6 * b, 6 * a) += both.bottomLeftCorner<6, 6>();
        gradient.segment<6>(6 * a) += here.gradient.head<6>();
        gradient.segment<6>(6 * b) += here.gradient.tail<6>();
      }
    }
    double torque = 0;
    for (int i = 0; i < n; ++i) torque = std::max(torque, gradient.segment<3>(6 * i + 3).norm());
    torque /= packing.solids.only().gyration_radius();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(full);
    const auto& lambda = solver.eigenvalues();
    const int most = 1 + *std::max_element(contacts.begin(), contacts.end());
    const double tolerance =
        std::numeric_limits<double>::epsilon() * std::sqrt(6.0 * n) * most * lambda.cwiseAbs().maxCoeff() + torque;
    std::vector<int> left;
    for (int i = 0; i < n; ++i) {
      bool named = contacts[static_cast<std::size_t>(i)] < 4;
      const Eigen::SelfAdjointEigenSolver<MatrixXd> own(full.block<6, 6>(6 * i, 6 * i), Eigen::EigenvaluesOnly);
      named = named || own.eigenvalues()[0] <= tolerance;
      for (Eigen::Index k = 0; k < lambda.size() && lambda[k] <= tolerance; ++k)
        named = named || solver.eigenvectors().col(k).segment<6>(6 * i).squaredNorm() > 0.5;
      if (!named) left.push_back(kept[static_cast<std::size_t>(i)]);
    }
    if (left.size() == kept.size()) break;
    kept = left;
  }
  return kept;
}

/// Jammed packings from which some particles were removed. The neighbours of these particles have fewer contacts, and
/// can become near-rattlers.
std::vector<Packing> thinned_out() {
  RandomStream random{102};
  std::vector<Packing> list;
  for (const JamResult* result : {&jammed(SolidKind::octahedron, 48, .01), &jammed(SolidKind::tetrahedron, 64, .02),
                                  &jammed(SolidKind::icosahedron, 32, .01)}) {
    for (const Packing* state : {&result->states.front(), &result->states.back()}) {
      for (const double share : {0.02, 0.1, 0.2, 0.4}) {
        std::vector<int> kept;
        for (int i = 0; i < state->size(); ++i) {
          if (random.uniform() >= share) kept.push_back(i);
        }
        list.push_back(part_of(*state, kept));
      }
    }
  }
  return list;
}

TEST(BackboneTest, AgreesWithTheDefinition) {
  int some_left = 0, several_rounds = 0, none_left = 0;
  for (const Packing& packing : thinned_out()) {
    int rounds = 0;
    const std::vector<int> expected = by_definition(packing, rounds);
    const Backbone backbone = backbone_of(packing, {.lowest = 6 * packing.size()});
    EXPECT_EQ(backbone.kept, expected);
    EXPECT_EQ(backbone.rounds, rounds);
    EXPECT_TRUE(backbone.stability.near_rattlers.empty());
    std::set<int> all(backbone.kept.begin(), backbone.kept.end());
    all.insert(backbone.removed.begin(), backbone.removed.end());
    EXPECT_EQ(std::vector<int>(all.begin(), all.end()), first_numbers(packing.size()));
    EXPECT_EQ(backbone.kept.size() + backbone.removed.size(), all.size());
    std::printf("%s: %zu of %d left after %d rounds\n", packing.solids.only().name().data(), backbone.kept.size(),
                packing.size(), backbone.rounds);
    some_left += !expected.empty() && !backbone.removed.empty();
    none_left += expected.empty();
    several_rounds += rounds > 1;
  }
  EXPECT_GT(some_left, 0);
  EXPECT_GT(none_left, 0);
  EXPECT_GT(several_rounds, 0);
}

TEST(BackboneTest, ContactsWithinAPartAreThoseOfThePart) {
  RandomStream random{103};
  for (const SolidKind kind : all_solids) {
    const Packing packing = small_packing(kind, 0.7, 104);
    const std::vector<Contact> all = PackingEnergy().contacts(packing);
    std::vector<int> kept;
    for (int i = 0; i < packing.size(); ++i) {
      if (random.uniform() < 0.7) kept.push_back(i);
    }
    const PartContacts within = contacts_within(all, kept, packing.size());
    const std::vector<Contact> expected = PackingEnergy().contacts(part_of(packing, kept));
    ASSERT_EQ(within.contacts.size(), expected.size());
    ASSERT_GT(expected.size(), 0U);
    ASSERT_LT(expected.size(), all.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(canonical_key(within.contacts[k].pair), canonical_key(expected[k].pair));
      EXPECT_EQ(within.contacts[k].overlap.volume, expected[k].overlap.volume);
      EXPECT_EQ(within.contacts[k].overlap.volume, all[within.places[k]].overlap.volume);
    }
  }
}

TEST(BackboneTest, OfAnEmptyPackingIsEmpty) {
  const Packing apart = small_packing(SolidKind::icosahedron, 0.05, 105);
  const Backbone backbone = backbone_of(apart);
  EXPECT_TRUE(backbone.kept.empty());
  EXPECT_EQ(backbone.removed, first_numbers(apart.size()));
  EXPECT_EQ(backbone.packing.size(), 0);
  EXPECT_FALSE(elastic_tensor(backbone));
}

}  // namespace
}  // namespace isojam
