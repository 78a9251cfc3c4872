#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "engine/analysis/gaps.hpp"
#include "engine/rigidity/pair_stiffness.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/solve/jam.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tasks/measure/measure.hpp"

namespace isojam {
namespace {

const JamResult& octahedra() {
  static const JamResult result = [] {
    RandomStream random{2024};
    JamOptions options;
    options.decompression.final_distance = 0.01;
    options.decompression.step_fraction = 0.5;
    return jam(random_packing(platonic(SolidKind::octahedron), 50, options.compression.initial_density, random),
               options);
  }();
  return result;
}

/// The part of every state that a measure wrote under its key.
std::vector<Json> states_of(Measure what, const std::string& key) {
  std::vector<Json> list;
  for (const Json& state : measure(what, octahedra()).states) list.push_back(state.at(key));
  EXPECT_EQ(list.size(), octahedra().states.size());
  return list;
}

/// Checks how the numbers of a state depend on thresholds and shares.
void expect_choices(const Json& state, const Packing& packing) {
  const Json& modes = state.at("modes");
  const Json &by_share = modes.at("second_by_share"), &by_threshold = modes.at("prestress_by_threshold");
  EXPECT_EQ(by_share[0].at("modes"), modes.at("held_by_second"));
  EXPECT_EQ(by_threshold[2].at("modes"), modes.at("held_by_prestress"));
  for (std::size_t k = 0; k + 1 < by_share.size(); ++k)
    EXPECT_GE(by_share[k].at("modes").get<int>(), by_share[k + 1].at("modes").get<int>());
  for (std::size_t k = 0; k + 1 < by_threshold.size(); ++k)
    EXPECT_LE(by_threshold[k].at("modes").get<int>(), by_threshold[k + 1].at("modes").get<int>());
  int contacts = 0, tilts = 0;
  for (const Json& entry : state.at("by_class"))
    contacts += entry.at("contacts").get<int>(), tilts += entry.at("stiff_tilts").get<int>();
  if (state.at("by_class").empty()) return;
  EXPECT_EQ(contacts, static_cast<int>(PackingEnergy().contacts(packing).size()));
  EXPECT_NEAR(state.at("C_s").get<double>() * packing.size() / 2, contacts + tilts, 1e-9 * contacts);
}

TEST(HoldingMeasure, PrestressCountsConstraintsAndModes) {
  const auto states = states_of(Measure::prestress, "prestress");
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Json& state = states[k];
    const Packing& packing = octahedra().states[k];
    const auto contacts = PackingEnergy().contacts(packing);
    const auto pairs = pair_stiffnesses(packing, contacts);
    double last = 1e9;
    for (const Json& one : state.at("thresholds")) {
      const double threshold = one.at("threshold"), C = one.at("C");
      EXPECT_EQ(C, stiff_constraint_number(packing.size(), pairs, threshold));
      EXPECT_LE(C, last);
      last = C;
      if (threshold == 10) {
        EXPECT_EQ(state.at("C_s"), C);
      }
    }
    const auto rigidity = analyse_rigidity(stiff_constraints(packing, contacts, pairs, 10));
    EXPECT_EQ(state.at("missing").get<double>(),
              static_cast<double>(6 * packing.size() - 3 - rigidity.rank) / packing.size());
    EXPECT_EQ(state.at("self_stress").get<int>(), rigidity.self_stress);
    const auto normals = analyse_rigidity(normal_constraints(packing, contacts));
    EXPECT_EQ(state.at("normals").at("rank").get<int>(), normals.rank);
    const Json& modes = state.at("modes");
    EXPECT_EQ(modes.at("looked_at").get<int>(), 6 * packing.size() - 3);
    EXPECT_LE(modes.at("worst_sum").get<double>(), 1e-6);
    // In at least half as many modes as there are motions that no normal opposes, normals have less than half of the
    // stiffness.
    EXPECT_GE(modes.at("held_by_second").get<int>(), (normals.floppy - 3) / 2);
    EXPECT_LE(modes.at("held_by_prestress").get<int>(), modes.at("held_by_second").get<int>());
    expect_choices(state, packing);
    for (std::size_t m = 0; m < modes.at("lambda").size(); ++m) {
      const double normal = modes.at("normal")[m], tilt = modes.at("tilt")[m];
      EXPECT_GE(normal, 0);
      EXPECT_GE(tilt, 0);
    }
  }
  EXPECT_TRUE(states.back().contains("s_normal"));
  EXPECT_EQ(states.back().at("s_normal").size(), PackingEnergy().contacts(octahedra().states.back()).size());
}

TEST(HoldingMeasure, PrestressCountsModesByTheirStiffness) {
  const Packing& packing = octahedra().states[1];
  PackingEnergy energy;
  const auto contacts = energy.contacts(packing);
  const auto pairs = pair_stiffnesses(packing, contacts);
  const auto modes = dense_modes(dynamical_matrix(packing, energy.hessian(packing, Precision::double_double)));
  const Json counted = states_of(Measure::prestress, "prestress")[1].at("modes");
  ASSERT_EQ(counted.at("unresolved").get<int>(), 0);
  std::map<double, int> by_share, by_threshold;
  for (Eigen::Index m = 0; m < modes.size(); ++m) {
    double normal = 0;
    std::map<double, double> tilts;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      Vector12d u;
      u << modes.vectors.col(m).segment<6>(6 * contacts[c].pair.a),
          modes.vectors.col(m).segment<6>(6 * contacts[c].pair.b);
      normal += pairs[c].normal_stiffness * std::pow(pairs[c].normal.dot(u), 2);
      for (int k = 0; k < 5; ++k) {
        for (const Json& entry : counted.at("prestress_by_threshold")) {
          const double threshold = entry.at("threshold");
          if (pairs[c].tilt_stiffness[k] * pairs[c].length > threshold * pairs[c].force)
            tilts[threshold] += pairs[c].tilt_stiffness[k] * std::pow(pairs[c].tilts.col(k).dot(u), 2);
        }
      }
    }
    for (const Json& entry : counted.at("second_by_share"))
      by_share[entry.at("normals_below")] += normal < entry.at("normals_below").get<double>() * modes.eigenvalues[m];
    for (const Json& entry : counted.at("prestress_by_threshold"))
      by_threshold[entry.at("threshold")] += normal + tilts[entry.at("threshold")] < modes.eigenvalues[m] / 2;
  }
  for (const Json& entry : counted.at("second_by_share"))
    EXPECT_EQ(entry.at("modes").get<int>(), by_share[entry.at("normals_below")]) << entry;
  for (const Json& entry : counted.at("prestress_by_threshold"))
    EXPECT_EQ(entry.at("modes").get<int>(), by_threshold[entry.at("threshold")]) << entry;
  EXPECT_NE(by_threshold.begin()->second, by_threshold.rbegin()->second);
}

TEST(HoldingMeasure, RigidityUsesOtherCutoffsToo) {
  const auto states = states_of(Measure::rigidity, "rigidity");
  int told = 0;
  for (const Json& state : states) {
    const Json& scaled = state.at("scaled_cutoffs");
    EXPECT_EQ(scaled.size(), state.at("classes").at("rank").is_null() ? 0U : 2U);
    if (scaled.empty()) continue;
    ++told;
    const Json &half = scaled[0], &fitted = state.at("classes"), &twice = scaled[1];
    for (const char* key : {"constraints", "rank"}) {
      EXPECT_LE(half.at(key).get<int>(), fitted.at(key).get<int>()) << key;
      EXPECT_LE(fitted.at(key).get<int>(), twice.at(key).get<int>()) << key;
    }
    EXPECT_LT(half.at("constraints").get<int>(), twice.at("constraints").get<int>());
    EXPECT_EQ(half.at("constraints").get<int>() - half.at("rank").get<int>(), half.at("self_stress").get<int>());
  }
  EXPECT_GT(told, 0);
}

TEST(HoldingMeasure, GapsCountsEveryPair) {
  const auto states = states_of(Measure::gaps, "gaps");
  const auto sum = [](const Json& bins) {
    const auto counts = bins.at("counts").get<std::vector<long>>();
    return std::accumulate(counts.begin(), counts.end(), bins.at("below").get<long>());
  };
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Packing& packing = octahedra().states[k];
    EXPECT_EQ(sum(states[k].at("faces")) + sum(states[k].at("edges")),
              static_cast<long>(near_gaps(packing, .1).size()));
    EXPECT_EQ(sum(states[k].at("face_face")) + sum(states[k].at("edge_face")) + sum(states[k].at("lower_order")),
              static_cast<long>(PackingEnergy().contacts(packing).size()));
    const double distance = packing.density() - octahedra().phi_j->density;
    const auto gaps = near_gaps(packing, .1);
    const auto near = std::count_if(gaps.begin(), gaps.end(), [&](const Gap& gap) { return gap.width < distance; });
    if (!states[k].at("within_distance").is_null()) {
      EXPECT_EQ(states[k].at("within_distance").get<double>(), 2. * static_cast<double>(near) / packing.size());
    }
    EXPECT_EQ(states[k].at("log10_gap").size(), states[k].at("faces").at("counts").size() + 1);
    EXPECT_EQ(states[k].at("log10_force").size(), states[k].at("face_face").at("counts").size() + 1);
  }
  EXPECT_GT(states.back().at("within_distance").get<double>(), 0);
}

/// The numbers of the record follow from its list of exponents, and the constraints satisfy Calladine's relation.
TEST(HoldingMeasure, ExponentsCountClasses) {
  MeasureOptions options;
  options.exponents_of_all_states = true;
  const auto& jam = octahedra();
  const auto all = measure(Measure::exponents, jam, options).states, nearest = measure(Measure::exponents, jam).states;
  const std::size_t last = *nearest_state(jam);
  EXPECT_EQ(all[last], nearest[last]);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    EXPECT_EQ(nearest[k].contains("exponents"), k == last);
    const Json& state = all[k].at("exponents");
    const int n = jam.states[k].size();
    const auto contacts = PackingEnergy().contacts(jam.states[k]);
    ASSERT_EQ(state.at("x").size(), contacts.size());
    double faces = 0, edges = 0, points = 0, low = 0, high = 0;
    for (const Json& entry : state.at("x")) {
      const double x = entry.is_null() ? 1 : entry.get<double>();
      (x < -2.5 ? faces : x < .5 ? edges : points) += 2. / n;
      low += 2. / n * (x < -4 ? 3 : x < .3 ? 2 : 1);
      high += 2. / n * (x < -1 ? 3 : x < .7 ? 2 : 1);
    }
    const double C = state.at("C"), m = state.at("missing"), s = state.at("rank").at("self_stress");
    std::printf("state %zu: C %.3f from %.3f to %.3f, m %.3f, S %.0f, step %g\n", k, C, low, high, m, s,
                state.at("step").get<double>());
    EXPECT_NEAR(state.at("Z_ff"), faces, 1e-9);
    EXPECT_NEAR(state.at("Z_ef"), edges, 1e-9);
    EXPECT_NEAR(state.at("Z_l"), points, 1e-9);
    EXPECT_NEAR(state.at("C_low"), low, 1e-9);
    EXPECT_NEAR(state.at("C_high"), high, 1e-9);
    EXPECT_NEAR(C, 12 - 6. / n - 2 * m + 2 * s / n, 1e-9);
    EXPECT_LE(state.at("missing_low"), m);
    EXPECT_GE(state.at("missing_high"), m);
    EXPECT_LE(state.at("supported").at("missing").get<double>() * (n - state.at("supported").at("removed").get<int>()),
              m * n + 1e-9);
  }
}

}  // namespace
}  // namespace isojam
