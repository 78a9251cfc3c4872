#include "engine/geometry/overlap/own_hessians.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>

#include "engine/random/stream.hpp"
#include "tests/oracle/own_hessian.hpp"

namespace isojam {
namespace {

double random_number(RandomStream& random) {
  return random.uniform() < .1 ? 0 : random.normal() * std::exp(5 * random.normal());
}

struct Guarded {
  OverlapHessian hessian;
  double behind[4] = {1, 2, 3, 4};
};

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Sums of the absolute values of the terms in each entry of −H_AB·Tr − [S]×, symmetrised.
Matrix6d summands(const Matrix6d& ab, const Eigen::Vector3d& area, const Eigen::Vector3d& r) {
  const auto skew = [](const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, v.z(), v.y(), v.z(), 0, v.x(), v.y(), v.x(), 0;
    return Eigen::Matrix3d(m.cwiseAbs());
  };
  Matrix6d transport = Matrix6d::Identity();
  transport.topRightCorner<3, 3>() = skew(r);
  Matrix6d sizes = ab.cwiseAbs() * transport;
  sizes.topRightCorner<3, 3>() += skew(area);
  return (sizes + sizes.transpose()) / 2;
}

TEST(OwnHessians, AreThoseOfThePlainFormula) {
  RandomStream random{23};
  for (int k = 0; k < 200; ++k) {
    Guarded found;
    for (double& value : found.hessian.ab.reshaped()) value = random_number(random);
    Eigen::Vector3d area, r;
    for (int c = 0; c < 3; ++c) area[c] = random_number(random), r[c] = random_number(random);
    const Matrix6d ab = found.hessian.ab;
    set_own_hessians(area, r, found.hessian);
    const Matrix6d aa = oracle::own_hessian(ab, area, r), bb = oracle::own_hessian(ab.transpose(), -area, -r);
    const auto within = [](const Matrix6d& here, const Matrix6d& there, const Matrix6d& sizes) {
      return ((here - there).cwiseAbs().array() <= 4 * eps * sizes.array()).all();
    };
    EXPECT_TRUE(within(found.hessian.aa, aa, summands(ab, area, r))) << "differences\n" << found.hessian.aa - aa;
    EXPECT_TRUE(within(found.hessian.bb, bb, summands(ab.transpose(), area, r))) << "differences\n"
                                                                                 << found.hessian.bb - bb;
    EXPECT_EQ(found.hessian.ab, ab);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(found.behind[c], c + 1);
  }
}

}  // namespace
}  // namespace isojam
