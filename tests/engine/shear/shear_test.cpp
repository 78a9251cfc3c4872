#include "engine/shear/shear.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <map>

#include "engine/packing/cell/strain.hpp"
#include "engine/packing/energy.hpp"
#include "engine/solve/jam.hpp"
#include "engine/vibration/moduli.hpp"
#include "engine/vibration/settle.hpp"

namespace isojam {
namespace {

const Packing& jammed(SolidKind kind) {
  static std::map<SolidKind, Packing> made;
  const auto found = made.find(kind);
  if (found != made.end()) return found->second;
  JamOptions options;
  options.compression.initial_density = .2;
  options.compression.step = .03;
  options.decompression.final_distance = .03;
  options.decompression.control = Control::pressure;
  options.cell = CellShape::free;
  options.minimise.residual = 1e-9;
  RandomStream random{23, static_cast<std::uint64_t>(kind)};
  JamResult result = jam(random_packing(platonic(kind), 60, options.compression.initial_density, random), options);
  settle(result, options);
  // Minimised to the smallest possible residual, because the remaining stress is a part of every difference.
  Packing packing = result.states.back();
  PackingEnergy energy;
  MinimiseOptions exact;
  exact.residual = 1e-13;
  minimise(packing, energy, exact);
  return made.emplace(kind, packing).first->second;
}

struct Case {
  SolidKind kind;
  ShearMode mode;
};

class ShearOf : public testing::TestWithParam<Case> {
 protected:
  const Packing& start_ = jammed(GetParam().kind);

  ShearOptions options(ShearControl control, double step, double until) const {
    ShearOptions options;
    options.mode = GetParam().mode;
    options.control = control;
    options.step = step;
    options.until = until;
    options.minimise.residual = 1e-11;
    return options;
  }

  ElasticTensor tensor() const {
    PackingEnergy energy;
    const Evaluation here = energy.evaluate(start_, Precision::double_double);
    return *elastic_tensor(start_, energy.hessian(start_, Precision::double_double), energy.contacts(start_), here);
  }

  /// Strain for γ = 1, in Mandel components.
  Vector6d direction() const { return strain_components(deviator_with(.5, GetParam().mode)); }
};

INSTANTIATE_TEST_SUITE_P(Cases, ShearOf,
                         testing::Values(Case{SolidKind::octahedron, ShearMode::pure},
                                         Case{SolidKind::dodecahedron, ShearMode::simple}),
                         [](const auto& test) {
                           return std::string(to_string(test.param.kind)) + '_' +
                                  std::string(to_string(test.param.mode));
                         });

TEST_P(ShearOf, TheFirstStepHasTheShearModulus) {
  const double expected = direction().dot(tensor().relaxed * direction());
  const double step = 1e-6;
  const ShearResult forth = shear(start_, options(ShearControl::strain, step, 2 * step));
  ASSERT_EQ(forth.states.size(), 3U);
  // With this formula the terms of second order cancel.
  const double slope = (4 * forth.states[1].stress - forth.states[2].stress - 3 * forth.states[0].stress) / (2 * step);
  std::printf("G %.9e, by stress over strain %.9e\n", expected, slope);
  EXPECT_NEAR(slope, expected, 1e-6 * std::abs(expected));
}

TEST_P(ShearOf, StressIsTheSlopeOfTheEnergy) {
  const ShearResult result = shear(start_, options(ShearControl::strain, 2e-5, 1e-4));
  ASSERT_EQ(result.ended, ShearEnd::completed);
  for (const ShearState& state : result.states) {
    EXPECT_FALSE(state.dropped) << state.load;
    EXPECT_LE(std::abs(state.dissipated), 1e-7 * state.energy) << state.load;
    EXPECT_NEAR(state.packing.cell.volume(), start_.cell.volume(), 1e-12 * start_.cell.volume());
    EXPECT_EQ(state.strain, state.load);
  }
}

TEST_P(ShearOf, ReversingTheLoadRestoresTheEnergy) {
  for (const ShearControl control : {ShearControl::strain, ShearControl::stress}) {
    ShearOptions there_and_back =
        options(control, control == ShearControl::strain ? 5e-5 : 1e-3, control == ShearControl::strain ? 1e-4 : 2e-3);
    there_and_back.back = true;
    const ShearResult result = shear(start_, there_and_back);
    ASSERT_EQ(result.ended, ShearEnd::completed) << to_string(control);
    ASSERT_EQ(result.states.size(), 5U);
    const double before = result.states.front().energy, after = result.states.back().energy;
    std::printf("%s: energy back to %.1e of it\n", to_string(control).data(), (after - before) / before);
    EXPECT_NEAR(after, before, 1e-9 * before) << to_string(control);
    EXPECT_NE(result.states[2].energy, before);
  }
}

TEST_P(ShearOf, UnderStressControlTheStressIsTheRequestedOne) {
  const ShearResult result = shear(start_, options(ShearControl::stress, 1e-4, 3e-4));
  ASSERT_EQ(result.ended, ShearEnd::completed);
  const double pressure = result.states.front().pressure;
  const Matrix6d compliance = [&] {
    Matrix6d stiffness = tensor().relaxed;
    stiffness.topLeftCorner<3, 3>().array() += pressure;  // response at constant pressure
    return Matrix6d(stiffness.inverse());
  }();
  const Vector6d load = strain_components(deviator_with(1, GetParam().mode));
  for (std::size_t k = 1; k < result.states.size(); ++k) {
    const ShearState& state = result.states[k];
    const Eigen::Matrix3d wanted =
        deviator_with(state.load * pressure, GetParam().mode) - pressure * Eigen::Matrix3d::Identity();
    EXPECT_LE((state.full_stress - wanted).cwiseAbs().maxCoeff(), 1e-8 * pressure) << k;
    EXPECT_NEAR(state.pressure, pressure, 1e-8 * pressure);
    if (state.dropped) break;
    EXPECT_LE(std::abs(state.dissipated), 1e-8 * state.energy) << k;
    // For such a small load, compliance and strain are linear to a few per cent.
    const double expected = 2 * direction().dot(compliance * load) * state.load * pressure;
    std::printf("s/p %.0e: strain %.6e, linear %.6e\n", state.load, state.strain, expected);
    EXPECT_NEAR(state.strain, expected, .02 * std::abs(expected)) << k;
  }
}

TEST_P(ShearOf, AtLargeLoadsThePackingRearranges) {
  const ShearResult result = shear(start_, options(ShearControl::strain, 6e-3, .06));
  int drops = 0;
  for (const ShearState& state : result.states) {
    drops += state.dropped;
    EXPECT_TRUE(!state.dropped || state.descents > 0 || state.dissipated > 0) << state.load;
  }
  std::printf("%zu states, %d drops, %s\n", result.states.size(), drops, to_string(result.ended).data());
  EXPECT_GE(drops, 1);
  const ShearResult beyond = shear(start_, options(ShearControl::stress, .1, .8));
  std::printf("under stress to %.2f p: %s\n", beyond.states.back().load, to_string(beyond.ended).data());
  EXPECT_NE(beyond.ended, ShearEnd::completed);
  for (const ShearState& state : beyond.states) EXPECT_TRUE(std::isfinite(state.strain) && std::isfinite(state.stress));
}

TEST(ShearTest, RejectsUnjammedPackingsAndInvalidSteps) {
  Packing loose{platonic(SolidKind::octahedron), PeriodicCell(9), {Pose{}, Pose{}}};
  loose.poses[1].position.setConstant(4);
  EXPECT_THROW(shear(loose, {}), std::invalid_argument);
  const Packing& packing = jammed(SolidKind::octahedron);
  ShearOptions options;
  options.step = 0;
  EXPECT_THROW(shear(packing, options), std::invalid_argument);
  options.step = .1, options.until = .05;
  EXPECT_THROW(shear(packing, options), std::invalid_argument);
}

TEST(ShearTest, AStopEndsItBetweenSteps) {
  std::stop_source stop;
  stop.request_stop();
  const ShearResult result = shear(jammed(SolidKind::octahedron), {}, stop.get_token());
  EXPECT_EQ(result.ended, ShearEnd::interrupted);
  EXPECT_EQ(result.states.size(), 1U);
}

}  // namespace
}  // namespace isojam
