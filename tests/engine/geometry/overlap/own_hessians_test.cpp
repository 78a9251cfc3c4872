// Fact proved here: for random H_AB, S and r, of both signs and many magnitudes, zeros among them, set_own_hessians()
// sets H_AA and H_BB to the bits of set_own_hessian(), H_AB stays as it was, and so does what lies behind the blocks.

#include "engine/geometry/overlap/own_hessians.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

double random_number(RandomStream& random) {
  return random.uniform() < .1 ? 0 : random.normal() * std::exp(5 * random.normal());
}

struct Guarded {
  OverlapHessian hessian;
  double behind[4] = {1, 2, 3, 4};
};

TEST(OwnHessians, AreThoseOfThePlainFormula) {
  RandomStream random{23};
  for (int k = 0; k < 200; ++k) {
    Guarded found;
    for (double& value : found.hessian.ab.reshaped()) value = random_number(random);
    Eigen::Vector3d area, r;
    for (int c = 0; c < 3; ++c) area[c] = random_number(random), r[c] = random_number(random);
    const Matrix6d ab = found.hessian.ab;
    set_own_hessians(area, r, found.hessian);
    Matrix6d aa, bb;
    set_own_hessian(ab, area, r, aa);
    set_own_hessian(ab.transpose(), -area, -r, bb);
    EXPECT_EQ(found.hessian.aa, aa) << "differences\n" << found.hessian.aa - aa;
    EXPECT_EQ(found.hessian.bb, bb) << "differences\n" << found.hessian.bb - bb;
    EXPECT_EQ(found.hessian.ab, ab);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(found.behind[c], c + 1);
  }
}

}  // namespace
}  // namespace isojam
