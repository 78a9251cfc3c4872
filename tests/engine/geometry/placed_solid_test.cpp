#include "engine/geometry/placed_solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"
#include "tests/oracle/own_hessian.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int cases = 10;  // for each pair of solids

struct Placed {
  explicit Placed(const Pair& pair)
      : alone_a(pair.solid_a(), pair.a.orientation.toRotationMatrix()),
        alone_b(pair.solid_b(), pair.b.orientation.toRotationMatrix()),
        a(alone_a.view()),
        b(alone_b.view()),
        r(pair.displacement()) {}
  LonePlacedSolid alone_a, alone_b;
  PlacedSolid a, b;
  Vector3d r;
};

template <class Check>
void for_each_near_pair(std::uint64_t seed, const Check& check) {
  RandomStream random{8, seed};
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      const double nearest = platonic(a).inradius() + platonic(b).inradius();
      const double farthest = platonic(a).circumradius() + platonic(b).circumradius();
      for (int k = 0; k < cases; ++k)
        check(random_pair(random, a, b, nearest + (farthest - nearest) * random.uniform()));
    }
  }
}

TEST(PlacedSolidTest, IsTheRotatedSolid) {
  for_each_near_pair(1, [](const Pair& pair) {
    const ConvexSolid& solid = pair.solid_a();
    const Placed both(pair);
    const PlacedSolid placed = both.a;
    const Matrix3d q = pair.a.orientation.toRotationMatrix();
    const double tolerance = 4 * epsilon * solid.circumradius();
    for (int v = 0; v < placed.vertices(); ++v) {
      EXPECT_LE((placed.vertex(v) - q * solid.vertices()[v]).norm(), tolerance) << "vertex " << v;
      EXPECT_EQ(placed.vertex_block(v / 4)[4 + v % 4], placed.vertex(v).y()) << "vertex " << v;
    }
    for (int f = 0; f < placed.faces(); ++f) {
      EXPECT_LE((placed.normal(f) - q * solid.faces()[f].normal).norm(), 4 * epsilon) << "face " << f;
      EXPECT_EQ(placed.normal_block(f / 4)[8 + f % 4], placed.normal(f).z()) << "face " << f;
      EXPECT_EQ(placed.offset()[f], solid.faces()[f].offset);
    }
  });
}

double distance(const PlacedSolid& body, int vertex, const PlacedSolid& other, int face, const Vector3d& to_other) {
  return other.normal(face).dot(body.vertex(vertex) - to_other) - other.offset()[face];
}

/// A table of distances that owns its memory.
struct Table : Distances<SmallSolids> {
  Table(const PlacedSolid& body, const PlacedSolid& other, const Vector3d& to_other)
      : memory(static_cast<std::size_t>(size(body, other))) {
    of = memory.data();
    tabulate_distances(body, other, to_other, *this);
  }
  std::vector<double> memory;
};

TEST(DistancesTest, AreThoseOfTheDefinition) {
  int missing = 0;
  for_each_near_pair(2, [&](const Pair& pair) {
    const Placed placed(pair);
    const Table table(placed.a, placed.b, placed.r);
    const double tolerance = gap_tolerance(pair.solid_a(), pair.solid_b(), placed.r);
    double nearest = SolidArrays::far;
    std::vector<double> lowest(static_cast<std::size_t>(placed.b.faces()), SolidArrays::far);
    for (int v = 0; v < placed.a.vertices(); ++v) {
      const bool has_row = table.rows.contains(static_cast<std::uint32_t>(v));
      if (!has_row) ++missing;
      double outermost = -SolidArrays::far;
      for (int f = 0; f < placed.b.faces(); ++f) {
        const double exact = distance(placed.a, v, placed.b, f, placed.r);
        outermost = std::max(outermost, exact);
        if (!has_row) continue;
        EXPECT_NEAR(table.row(v)[f], exact, tolerance) << "vertex " << v << ", face " << f << "\n" << describe(pair);
        nearest = std::min(nearest, std::abs(table.row(v)[f]));
        lowest[f] = std::min(lowest[f], table.row(v)[f]);
      }
      if (!has_row) {
        EXPECT_GT(outermost, 0) << "vertex " << v << " is inside: " << describe(pair);
      }
    }
    if (table.rows.empty()) return;
    EXPECT_EQ(table.nearest, nearest);
    const auto least = std::max_element(lowest.begin(), lowest.end());
    EXPECT_EQ(table.least_penetrated, least - lowest.begin()) << describe(pair);
    EXPECT_NEAR(table.least_penetration, -*least, 64 * epsilon * std::abs(*least)) << describe(pair);
  });
  EXPECT_GT(missing, 100) << "no row was left out: nothing is proved of those";
}

TEST(DistancesTest, UnlistedEdgesAreOutside) {
  int listed = 0, unlisted = 0;
  for_each_near_pair(3, [&](const Pair& pair) {
    const Placed placed(pair);
    const Table table(placed.a, placed.b, placed.r);
    for (int e = 0; e < static_cast<int>(pair.solid_a().edges().size()); ++e) {
      const Edge& edge = pair.solid_a().edges()[e];
      if (table.edges.contains(static_cast<std::uint32_t>(e))) {
        ++listed;
        const auto row = [&](int v) { return table.rows.contains(static_cast<std::uint32_t>(v)); };
        EXPECT_TRUE(row(edge.tail) && row(edge.head)) << "edge " << e << " has no rows";
        continue;
      }
      ++unlisted;
      // Seven points of the edge. Each of them is outside some plane.
      for (int k = 0; k <= 6; ++k) {
        const Vector3d y = placed.a.vertex(edge.tail) * (6 - k) / 6 + placed.a.vertex(edge.head) * k / 6 - placed.r;
        double outermost = -SolidArrays::far;
        for (int f = 0; f < placed.b.faces(); ++f)
          outermost = std::max(outermost, placed.b.normal(f).dot(y) - placed.b.offset()[f]);
        EXPECT_GT(outermost, 0) << "edge " << e << " at " << k << "/6: " << describe(pair);
      }
    }
  });
  EXPECT_GT(listed, 100);
  EXPECT_GT(unlisted, 100);
}

TEST(DistancesTest, AChangedTableIsClassifiedAgain) {
  RandomStream random{8, 4};
  for_each_near_pair(4, [&](const Pair& pair) {
    const Placed placed(pair);
    Table table(placed.a, placed.b, placed.r);
    const auto edges = table.edges;
    const auto nearest = table.nearest;
    const double least_penetration = table.least_penetration;
    classify(pair.solid_a(), table);
    EXPECT_EQ(table.edges, edges) << "nothing was changed: " << describe(pair);
    EXPECT_EQ(table.nearest, nearest);
    EXPECT_EQ(table.least_penetration, least_penetration);
    // If all entries are positive, everything is outside of all planes: no edge remains, and every plane separates.
    for (double& entry : table.memory) entry = std::abs(entry) + 1;
    classify(pair.solid_a(), table);
    EXPECT_EQ(table.edges, 0U);
    if (!table.rows.empty()) {
      EXPECT_LE(table.least_penetration, 0) << describe(pair);
    }
  });
}

TEST(PlacedSolidTest, OverlapIsThatOfTheRotatedRelativePose) {
  int touching = 0;
  for_each_near_pair(5, [&](const Pair& pair) {
    const Placed placed(pair);
    SeparatingAxis axis;
    OverlapHessian hessian;
    const Overlap lab = overlap(placed.a, placed.b, placed.r, axis);
    const Overlap both = overlap_with_hessian(placed.a, placed.b, placed.r, axis, hessian);
    const Overlap body = overlap(pair);
    EXPECT_EQ(lab.volume, both.volume);
    EXPECT_TRUE(lab.area == both.area && lab.moment == both.moment);
    EXPECT_EQ(lab.touching(), body.touching()) << describe(pair);
    if (!lab.touching()) {
      EXPECT_EQ(hessian.aa.norm() + hessian.ab.norm() + hessian.bb.norm(), 0);
      return;
    }
    ++touching;
    const Matrix3d q = pair.a.orientation.toRotationMatrix();
    const double scale = body.area.norm(), limit = 256 * epsilon * pair.reach() * scale / body.volume;
    EXPECT_NEAR(lab.volume, body.volume, limit * body.volume) << describe(pair);
    EXPECT_LE((lab.area - q * body.area).norm(), limit * scale) << describe(pair);
    EXPECT_LE((lab.moment - q * body.moment).norm(), limit * scale * pair.reach()) << describe(pair);
    EXPECT_TRUE(lab.faces_a == body.faces_a && lab.faces_b == body.faces_b && lab.edges_a == body.edges_a &&
                lab.edges_b == body.edges_b)
        << describe(pair);

    Matrix6d frame = Matrix6d::Zero();
    frame.topLeftCorner<3, 3>() = frame.bottomRightCorner<3, 3>() = q;
    const Matrix6d cross =
        frame * oracle::overlap_cross_hessian(pair.solid_a(), pair.solid_b(), pair.relative()) * frame.transpose();
    const double bound = 1e3 * limit * cross.norm();
    EXPECT_LE((hessian.ab - cross).norm(), bound) << describe(pair);
    const Matrix6d own_a = oracle::own_hessian(cross, lab.area, placed.r),
                   own_b = oracle::own_hessian(cross.transpose(), -lab.area, -placed.r);
    EXPECT_LE((hessian.aa - own_a).norm(), bound) << describe(pair);
    EXPECT_LE((hessian.bb - own_b).norm(), bound) << describe(pair);
  });
  EXPECT_GT(touching, 50);
}

TEST(PlacedSolidTest, AnAxisSeparatesIfItsGapIsLargeEnough) {
  std::map<SeparatingAxis::Kind, int> separated, joined;
  for_each_near_pair(6, [&](const Pair& pair) {
    const Placed placed(pair);
    RandomStream random{9, 1};
    std::vector<SeparatingAxis> axes{{}, best_axis(placed.a, placed.b, placed.r)};
    for (int k = 0; k < 20; ++k) {
      const auto pick = [&](std::size_t n) {
        return static_cast<std::uint8_t>(static_cast<double>(n) * random.uniform() * .999);
      };
      using Kind = SeparatingAxis::Kind;
      axes.push_back({Kind::face_a, pick(pair.solid_a().faces().size()), 0});
      axes.push_back({Kind::face_b, 0, pick(pair.solid_b().faces().size())});
      axes.push_back({Kind::edge_edge, pick(pair.solid_a().edges().size()), pick(pair.solid_b().edges().size())});
    }
    for (const SeparatingAxis& axis : axes) {
      const double width = gap(pair.solid_a(), pair.solid_b(), pair.relative(), axis);
      const double tolerance = gap_tolerance(pair.solid_a(), pair.solid_b(), placed.r);
      if (std::abs(width - tolerance) < 16 * tolerance) continue;  // rounding decides
      const bool found = separates(placed.a, placed.b, placed.r, axis);
      EXPECT_EQ(found, width > tolerance) << "gap " << width << ", kind " << static_cast<int>(axis.kind) << ", "
                                          << int{axis.a} << " and " << int{axis.b} << "\n"
                                          << describe(pair);
      ++(found ? separated : joined)[axis.kind];
    }
  });
  for (const auto kind :
       {SeparatingAxis::Kind::face_a, SeparatingAxis::Kind::face_b, SeparatingAxis::Kind::edge_edge}) {
    EXPECT_GT(separated[kind], 10) << static_cast<int>(kind);
    EXPECT_GT(joined[kind], 10) << static_cast<int>(kind);
  }
  EXPECT_EQ(separated[SeparatingAxis::Kind::none], 0);
}

}  // namespace
}  // namespace isojam
