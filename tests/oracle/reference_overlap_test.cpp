#include "tasks/extras/chart/pairs/reference_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/oracle/exact_overlap.hpp"
#include "tests/oracle/overlap_checks.hpp"

namespace isojam::oracle {
namespace {

TEST(ReferenceOverlap, AgreesWithRationalArithmetic) {
  double worst = 0;
  for (const SolidKind solid : {SolidKind::tetrahedron, SolidKind::dodecahedron}) {
    for (const PairClass pair_class :
         {PairClass::random_contact, PairClass::near_parallel_faces, PairClass::same_orientation}) {
      for (const PairCase& pair : pair_cases(solid, solid, pair_class, 3)) {
        const Real exact = exact_clipped_volume(solid, solid, exact_pose(pair));
        const RealVector area = exact_overlap(solid, solid, exact_pose(pair)).area;
        const ReferenceOverlap found = reference_overlap(pair);
        const Real volume(found.volume.str());
        RealVector difference;
        for (int c = 0; c < 3; ++c) difference[c] = Real(found.area[static_cast<std::size_t>(c)].str()) - area[c];
        const auto error = static_cast<double>(Real(abs(Real(volume - exact)) / exact));
        const auto area_error =
            std::sqrt(static_cast<double>(Real(difference.squaredNorm() / Real(area.squaredNorm()))));
        EXPECT_LT(error, 1e-25) << describe(pair);
        EXPECT_LT(area_error, 1e-25) << describe(pair);
        worst = std::max({worst, error, area_error});
      }
    }
  }
  std::cout << "largest relative difference " << worst << "\n";
}

}  // namespace
}  // namespace isojam::oracle
