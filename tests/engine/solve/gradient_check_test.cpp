#include "tests/engine/solve/gradient_check.hpp"

#include "engine/solve/minimise/minimise.hpp"
#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

EnergyFunction right(PackingEnergy& energy) {
  return [&](const Packing& packing) {
    Evaluation value = energy.evaluate(packing);
    return EnergyAndGradient{value.energy, std::move(value.gradient)};
  };
}

using Distortion = std::function<void(const Packing&, PackingEnergy&, Eigen::VectorXd&)>;

EnergyFunction wrong(PackingEnergy& energy, const Distortion& distort) {
  return [&energy, distort](const Packing& packing) {
    Evaluation value = energy.evaluate(packing);
    distort(packing, energy, value.gradient);
    return EnergyAndGradient{value.energy, std::move(value.gradient)};
  };
}

struct WrongGradient {
  std::string name;
  Distortion distort;
};

std::vector<WrongGradient> wrong_gradients(Eigen::Index largest) {
  const auto each_torque = [](auto change) {
    return [change](const Packing& packing, PackingEnergy&, Eigen::VectorXd& g) {
      for (int i = 0; i < packing.size(); ++i) change(packing, i, g);
    };
  };
  return {
      {"one per cent too large", [](const Packing&, PackingEnergy&, Eigen::VectorXd& g) { g *= 1.01; }},
      {"torque without 1/R", each_torque([](const Packing& packing, int i, Eigen::VectorXd& g) {
         g.segment<3>(6 * i + 3) *= packing.solids.only().gyration_radius();
       })},
      {"torque of the wrong sign",
       each_torque([](const Packing&, int i, Eigen::VectorXd& g) { g.segment<3>(6 * i + 3) *= -1; })},
      {"torque in the body frame", each_torque([](const Packing& packing, int i, Eigen::VectorXd& g) {
         const Eigen::Vector3d torque = g.segment<3>(6 * i + 3);
         g.segment<3>(6 * i + 3) = packing.poses[static_cast<std::size_t>(i)].orientation.conjugate() * torque;
       })},
      {"torque on B about the centre of A",
       [](const Packing& packing, PackingEnergy& energy, Eigen::VectorXd& g) {
         for (const Contact& c : energy.contacts(packing)) {
           const Eigen::Quaterniond& q = packing.poses[static_cast<std::size_t>(c.pair.a)].orientation;
           const Eigen::Vector3d dx = q * Eigen::Vector3d(c.overlap.volume / 2 * c.overlap.area);
           g.segment<3>(6 * c.pair.b + 3) -= c.displacement.cross(dx) / packing.solids.only().gyration_radius();
         }
       }},
      {"one entry missing", [=](const Packing&, PackingEnergy&, Eigen::VectorXd& g) { g[largest] = 0; }},
  };
}

class GradientOf : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, GradientOf, testing::ValuesIn(all_solids),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST_P(GradientOf, OnlyTheCorrectGradientPasses) {
  RandomStream random{21};
  PackingEnergy energy;
  for (const long evaluations : {0L, 60L}) {
    Packing packing = small_packing(GetParam(), over_compressed(GetParam()), 22);
    if (evaluations > 0) {
      MinimiseOptions options;
      options.method = Method::lbfgs;
      options.max_evaluations = evaluations;
      minimise(packing, energy, options);
    }
    const double step = 1e-6 * packing.solids.only().inradius();
    const GradientCheck good = check_gradient(right(energy), packing, step, random);
    EXPECT_TRUE(good.passes()) << "after " << evaluations << " evaluations: off by " << good.worst
                               << " tolerances in entry " << good.entry;
    EXPECT_LT(good.allowed, 1e-3) << "a check this lax proves nothing";
    Eigen::Index largest = 0;
    energy.evaluate(packing).gradient.cwiseAbs().maxCoeff(&largest);
    for (const WrongGradient& bad : wrong_gradients(largest)) {
      const GradientCheck check = check_gradient(wrong(energy, bad.distort), packing, step, random);
      EXPECT_FALSE(check.passes()) << "accepted after " << evaluations << " evaluations: " << bad.name;
    }
  }
}

}  // namespace
}  // namespace isojam
