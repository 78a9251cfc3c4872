#include <gtest/gtest.h>

#include "engine/rigidity/rigidity.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/backbone.hpp"
#include "tasks/measure/measure.hpp"
#include "tests/tasks/support/packings.hpp"

namespace isojam {
namespace {

const JamResult& jammed() {
  static const JamResult result = test::jammed_octahedra(1e-9);
  return result;
}

TEST(BackboneMeasure, OfTheWholeAgreesWithOtherMeasures) {
  ASSERT_EQ(jammed().status, JamStatus::jammed);
  const auto backbone = measure(Measure::backbone, jammed()), contacts = measure(Measure::contacts, jammed()),
             modes = measure(Measure::modes, jammed()), moduli = measure(Measure::moduli, jammed()),
             rigidity = measure(Measure::rigidity, jammed());
  int decided = 0;
  for (std::size_t k = 0; k < jammed().states.size(); ++k) {
    const auto& found = backbone.states[k].at("backbone");
    ASSERT_EQ(found.at("removed"), 0) << "state " << k;
    EXPECT_EQ(found.at("particles"), Json::array());
    EXPECT_EQ(found.at("rounds"), 0);
    EXPECT_EQ(found.at("Z"), contacts.states[k].at("contacts").at("Z"));
    for (const auto* key : {"verdict", "zero", "negative", "zero_tolerance", "omega_l"})
      EXPECT_EQ(found.at(key), modes.states[k].at("modes").at(key)) << key;
    EXPECT_EQ(found.at("K"), moduli.states[k].at("moduli").at("K"));
    for (const auto* rows : {"normals", "classes"}) {
      const auto &ours = found.at(rows), &theirs = rigidity.states[k].at("rigidity").at(rows);
      for (const auto* key : {"constraints", "rank"}) EXPECT_EQ(ours.at(key), theirs.at(key)) << rows;
      if (theirs.at("floppy").is_null()) {
        EXPECT_TRUE(ours.at("missing").is_null());
        continue;
      }
      ++decided;
      EXPECT_EQ(ours.at("missing").get<int>(), theirs.at("floppy").get<int>() - 3) << rows;
    }
  }
  EXPECT_GT(decided, static_cast<int>(jammed().states.size())) << "no state has classes";
}

/// The nearest state with small solids of the same shape, placed along the cell wherever they touch nothing.
JamResult with_floating(int wanted) {
  JamResult result = jammed();
  const std::size_t nearest = *nearest_state(result);
  const Packing state = result.states[nearest];
  const ConvexSolid& solid = state.solids.only();
  std::vector<Particle> particles(static_cast<std::size_t>(state.size()), Particle{&solid, 1, 0});
  Packing packing = state;
  RandomStream random{18};
  for (int made = 0; made < wanted;) {
    auto tried = particles;
    tried.push_back({&solid, 0.03, 1});
    Packing more{Composition(tried), state.cell, packing.poses};
    more.poses.emplace_back();
    more.poses.back().position =
        state.cell.side() * Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform());
    const auto contacts = PackingEnergy().contacts(more);
    const bool touches = std::any_of(contacts.begin(), contacts.end(),
                                     [&](const Contact& contact) { return contact.pair.b == more.size() - 1; });
    if (touches) continue;
    ++made;
    particles = tried;
    packing = more;
  }
  result.states = {packing};
  result.state_steps = {result.state_steps[nearest]};
  return result;
}

TEST(BackboneMeasure, FloatingSolidsChangeNothingElse) {
  constexpr int floating = 5;
  const auto result = with_floating(floating);
  const auto found = measure(Measure::backbone, result).states[0].at("backbone");
  const auto all = measure(Measure::backbone, jammed());
  const auto& before = all.states[*nearest_state(jammed())].at("backbone");
  EXPECT_EQ(found.at("removed"), floating);
  const int old = jammed().states[0].size();
  Json numbers = Json::array();
  for (int k = 0; k < floating; ++k) numbers.push_back(old + k);
  EXPECT_EQ(found.at("particles"), numbers);
  for (const auto* key : {"Z", "verdict", "zero", "negative", "zero_tolerance", "omega_l", "residual", "K", "normals"})
    EXPECT_EQ(found.at(key), before.at(key)) << key;
  const auto modes = measure(Measure::modes, result).states[0].at("modes");
  EXPECT_EQ(modes.at("zero"), 3 + 6 * floating);
  EXPECT_TRUE(modes.at("omega_l").is_null()) << "there would be no need of a backbone";
}

TEST(BackboneMeasure, AnUnbalancedRestHasNoBulkModulus) {
  const std::size_t nearest = *nearest_state(jammed());
  const Packing& state = jammed().states[nearest];
  RandomStream random{21};
  int seen = 0;
  for (int trial = 0; trial < 40; ++trial) {
    JamResult result = jammed();
    Packing thinned{state.solids, state.cell, {}};
    for (const Pose& pose : state.poses) {
      if (random.uniform() < 0.85) thinned.poses.push_back(pose);
    }
    result.states = {thinned};
    result.state_steps = {result.state_steps[nearest]};
    const auto found = measure(Measure::backbone, result).states[0].at("backbone");
    if (found.at("removed") == 0 || found.at("Z").is_null()) continue;
    ++seen;
    EXPECT_GT(found.at("residual").get<double>(), 1e-3);
    EXPECT_TRUE(found.at("K").is_null());
    EXPECT_EQ(found.at("K_reason"), "particles that were removed bore force: the rest does not balance");
    const Packing rest = backbone_of(thinned).packing;
    const auto normals = normal_constraints(rest, PackingEnergy().contacts(rest));
    const auto sigma = singular_values_of(Eigen::MatrixXd(normals.rows));
    EXPECT_EQ(found.at("normals").at("rank").get<long>(), (sigma.array() > 1e-12 * sigma[0]).count());
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace isojam
