#include "engine/packing/cell/periodic_cell.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/packing/packing.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(PeriodicCellTest, HalfASideCountsAsNegative) {
  const PeriodicCell cell(2);
  EXPECT_EQ(cell.nearest_shift(Vector3d(1, -1, 3)), Vector3i(-1, 0, -2));
  EXPECT_EQ(cell.nearest_image(Vector3d(1, -1, 3)), Vector3d(-1, -1, -1));
}

DoubleDoubleMatrix random_vectors(RandomStream& random, double skewness) {
  DoubleDoubleMatrix vectors;
  do {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        vectors.set(r, c, DoubleDouble(5.0 * (r == c) + skewness * random.normal()) + 1e-17 * random.normal());
    }
  } while (!(vectors.high.determinant() > 1));
  return vectors;
}

/// The same lattice with longer and more skew vectors.
DoubleDoubleMatrix more_skew(DoubleDoubleMatrix vectors, RandomStream& random) {
  for (int k = 0; k < 6; ++k) {
    const int to = k % 3, from = (to + 1 + k / 3) % 3;
    const double times = std::floor(7 * random.uniform()) - 3;
    for (int r = 0; r < 3; ++r) vectors.set(r, to, vectors(r, to) + vectors(r, from) * times);
  }
  return vectors;
}

/// Length of the shortest among many translations.
double shortest_of_many(const PeriodicCell& cell) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int image = 0; image < 11 * 11 * 11; ++image) {
    const Vector3i k(image % 11 - 5, image / 11 % 11 - 5, image / 121 - 5);
    if (!k.isZero()) shortest = std::min(shortest, cell.translation(k).norm());
  }
  return shortest;
}

TEST(PeriodicCellTest, OfAnyShapeFollowsFromItsLatticeVectors) {
  RandomStream random{6, 3};
  for (int k = 0; k < 200; ++k) {
    const PeriodicCell cell(random_vectors(random, 1.5));
    const Eigen::Matrix3d h = cell.vectors().high;
    EXPECT_FALSE(cell.is_cube());
    EXPECT_NEAR(cell.volume(), h.determinant(), 1e-13 * cell.volume());
    EXPECT_NEAR(cell.volume_double_double().high, h.determinant(), 1e-13 * cell.volume());
    EXPECT_NEAR(std::pow(cell.side(), 3), cell.volume(), 1e-14 * cell.volume());
    for (int c = 0; c < 3; ++c) {
      const double area = h.col((c + 1) % 3).cross(h.col((c + 2) % 3)).norm();
      EXPECT_NEAR(cell.heights()[c], cell.volume() / area, 1e-13 * cell.side());
    }
    const Vector3i shift(static_cast<int>(9 * random.uniform()) - 4, 2, -7);
    EXPECT_LE((cell.translation(shift) - h * shift.cast<double>()).norm(), 1e-14 * h.norm() * 7);
    EXPECT_LE((cell.fractional(cell.translation(shift)) - shift.cast<double>()).norm(), 1e-12);
    const QuadMatrix exact = widened(cell.vectors());
    for (int r = 0; r < 3; ++r) {
      const Quad sum = exact[r][0] * shift[0] + exact[r][1] * shift[1] + exact[r][2] * shift[2];
      EXPECT_LE(std::abs(static_cast<double>(widened(cell.translation_double_double(r, shift)) - sum)), 1e-29);
    }
  }
}

TEST(PeriodicCellTest, ReductionKeepsTheLatticeAndFindsItsShortestVectors) {
  RandomStream random{6, 4};
  for (int k = 0; k < 200; ++k) {
    const PeriodicCell skew(more_skew(random_vectors(random, 1.2), random)), reduced = skew.reduced();
    // Two bases belong to the same lattice if an integer matrix with determinant 1 transforms one into the other.
    const Eigen::Matrix3d integers = skew.vectors().high.inverse() * reduced.vectors().high;
    const Eigen::Matrix3d rounded = integers.array().round();
    EXPECT_LE((integers - rounded).norm(), 1e-9) << k;
    EXPECT_NEAR(rounded.determinant(), 1, 1e-9) << k;
    for (int c = 0; c < 3; ++c) {
      const Vector3i shift = rounded.col(c).cast<int>();
      for (int r = 0; r < 3; ++r) {
        const Quad error = widened(skew.translation_double_double(r, shift)) - widened(reduced.vectors()(r, c));
        const double scale = skew.vectors().high.row(r).cwiseAbs() * shift.cast<double>().cwiseAbs();
        EXPECT_LE(std::abs(static_cast<double>(error)), 1e-30 * scale) << k;
      }
    }
    const Vector3d lengths = reduced.vectors().high.colwise().norm();
    EXPECT_LE(lengths[0], lengths[1]);
    EXPECT_LE(lengths[1], lengths[2]);
    const double shortest = shortest_of_many(reduced);
    EXPECT_NEAR(lengths[0], shortest, 1e-12) << k;
    EXPECT_NEAR(skew.shortest_translation(), shortest, 1e-9) << k;
    EXPECT_TRUE(reduced.reduced() == reduced) << k;
    // Minkowski reduction: a vector becomes no shorter if other vectors are added to it or subtracted from it.
    for (int image = 0; image < 27; ++image) {
      const Vector3i at(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
      for (int c = 0; c < 3; ++c) {
        if (at[c] == 0 || !at.tail(2 - c).isZero()) continue;
        EXPECT_GE(reduced.translation(at).norm(), lengths[c] * (1 - 1e-11)) << k << ", " << at.transpose();
      }
    }
  }
}

TEST(PeriodicCellTest, NearestImageOfAnyCellIsTheShortest) {
  RandomStream random{6, 5};
  for (int k = 0; k < 200; ++k) {
    const PeriodicCell cell = PeriodicCell(random_vectors(random, 1.5)).reduced();
    const Vector3d d = 20 * Vector3d(random.normal(), random.normal(), random.normal());
    const Vector3d nearest = cell.nearest_image(d), cells = cell.fractional(nearest - d);
    EXPECT_LE((cells - Vector3d(cells.array().round())).norm(), 1e-10);
    for (int image = 0; image < 11 * 11 * 11; ++image) {
      const Vector3i away(image % 11 - 5, image / 11 % 11 - 5, image / 121 - 5);
      EXPECT_LE(nearest.norm(), (nearest + cell.translation(away)).norm() + 1e-12) << away.transpose();
    }
  }
}

TEST(PeriodicCellTest, ReductionEndsForVerySkewCells) {
  DoubleDoubleMatrix vectors;
  vectors.high << 5, 5e9 + 1, 3e9, 0, 5, -7e9, 0, 0, 5;
  const PeriodicCell cell(vectors);
  EXPECT_NEAR(cell.volume(), 125, 1e-9);
  EXPECT_NEAR(cell.reduced().volume(), 125, 1e-6);
  EXPECT_LE(cell.shortest_translation(), 5 * std::pow(2, 1.0 / 6) + 1e-9);  // Hermite's bound
}

TEST(PeriodicCellTest, RejectsInvalidVectors) {
  DoubleDoubleMatrix left, flat, lost;
  left.high.col(2) *= -1;
  flat.high.col(2).setZero();
  lost.high(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PeriodicCell{left}, std::invalid_argument);
  EXPECT_THROW(PeriodicCell{flat}, std::invalid_argument);
  EXPECT_THROW(PeriodicCell{lost}, std::invalid_argument);
}

TEST(PeriodicCellTest, IsLegalIfTheShortestTranslationIsLongEnough) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    const double least = least_side(solid);
    // A wide cell in which one lattice vector is very skew.
    for (const double factor : {.999, 1.001}) {
      DoubleDoubleMatrix vectors;
      const double length = factor * least;
      vectors.high << length * .6, 0, 0, length * .8, 4 * least, 0, 0, 0, 4 * least;
      EXPECT_EQ(is_legal(PeriodicCell(vectors), solid), factor > 1) << to_string(kind) << ' ' << factor;
    }
    EXPECT_EQ(is_legal(PeriodicCell(least), solid), false);
    EXPECT_EQ(is_legal(PeriodicCell(least * (1 + 1e-12)), solid), true);
  }
}

TEST(PeriodicCellTest, LeastParticlesIsTheSmallestLegalNumber) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    double diameter = 0;
    for (const Vector3d& v : solid.vertices()) {
      for (const Vector3d& w : solid.vertices()) diameter = std::max(diameter, (v - w).norm());
    }
    EXPECT_NEAR(least_side(solid), 2 * diameter, 8 * epsilon * diameter) << to_string(kind);
    for (const double density : {.01, .05, .3, .64, .7, .85, 1.0}) {
      const int n = least_particles(solid, density);
      EXPECT_GT(side_at(n, density), least_side(solid)) << to_string(kind) << ", φ " << density << ", N " << n;
      EXPECT_LE(side_at(n - 1, density), least_side(solid)) << to_string(kind) << ", φ " << density << ", N " << n;
    }
  }
}

}  // namespace
}  // namespace isojam
