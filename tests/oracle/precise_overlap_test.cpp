// Fact proved here:
// - volumes in 50 digits are those of exact rational arithmetic, for pairs whose faces do not coincide.

#include "tasks/chart/pairs/precise_volume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/oracle/exact_overlap.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

TEST(PreciseVolume, IsThatOfRationalArithmetic) {
  double worst = 0;
  for (const SolidKind solid : {SolidKind::tetrahedron, SolidKind::dodecahedron}) {
    for (const PairClass pair_class :
         {PairClass::random_contact, PairClass::near_parallel_faces, PairClass::same_orientation}) {
      for (const PairCase& pair : pair_cases(solid, solid, pair_class, 3)) {
        const Real exact = exact_clipped_volume(solid, solid, exact_pose(pair));
        const Real found(precise_volume(pair).str());
        const auto error = static_cast<double>(Real(abs(Real(found - exact)) / exact));
        EXPECT_LT(error, 1e-25) << describe(pair);
        worst = std::max(worst, error);
      }
    }
  }
  std::cout << "largest relative difference " << worst << "\n";
}

}  // namespace
}  // namespace isojam::oracle
