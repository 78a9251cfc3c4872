#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/packing/energy.hpp"
#include "tasks/extras/export/frame.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// Pairs of particles 2k and 2k + 1 that touch in a known way: face-face for k mod 3 = 0, edge-face for 1, vertex-face
/// for 2. Each pair uses its own face of one of the particles. Every other face-face pair has equal orientations, so
/// that other faces are as parallel as the touching ones. The pairs do not reach each other. The solids are
/// dodecahedra, because their edges are short enough to lie in a face; edges of other solids would reach over
/// neighbouring faces.
struct ConstructedPairs {
  Packing packing;
  std::vector<std::uint64_t> faces;  ///< a bit for each face, for every particle
};

constexpr int pairs_a_side = 4, pairs = pairs_a_side * pairs_a_side * pairs_a_side;

FaceContact kind_of(int pair) {
  constexpr std::array kinds{FaceContact::face_face, FaceContact::edge_face, FaceContact::lower_order};
  return kinds[static_cast<std::size_t>(pair % 3)];
}

constructed::Site site_of(const ConvexSolid& solid, FaceContact kind, int feature) {
  if (kind == FaceContact::face_face)
    return constructed::face_site(solid, feature % static_cast<int>(solid.faces().size()));
  if (kind == FaceContact::edge_face)
    return constructed::edge_site(solid, feature % static_cast<int>(solid.edges().size()));
  return constructed::vertex_site(solid, feature % static_cast<int>(solid.vertices().size()));
}

int opposite(const ConvexSolid& solid, int face) {
  const auto along = [&](const Face& other) { return other.normal.dot(solid.faces()[face].normal); };
  const auto least = std::min_element(solid.faces().begin(), solid.faces().end(),
                                      [&](const Face& a, const Face& b) { return along(a) < along(b); });
  return static_cast<int>(least - solid.faces().begin());
}

ConstructedPairs constructed_pairs(std::uint64_t seed) {
  const auto& solid = platonic(SolidKind::dodecahedron);
  RandomStream random({seed});
  const int faces = static_cast<int>(solid.faces().size());
  const double spacing = 7 * solid.circumradius();
  ConstructedPairs made{{solid, PeriodicCell(spacing * pairs_a_side), {}}, {}};
  for (int k = 0; k < pairs; ++k) {
    const auto kind = kind_of(k);
    const auto on_a = constructed::face_site(solid, k % faces);
    const bool alike = k % 6 == 0;
    const auto on_b = alike ? constructed::face_site(solid, opposite(solid, k % faces)) : site_of(solid, kind, k);
    const bool flat = kind != FaceContact::lower_order;
    const Vector3d tilt = (flat ? 1e-6 : 0.1) * random.uniform() * constructed::random_direction(random);
    auto contact = constructed::contact(on_a, on_b, 2 * std::numbers::pi * random.uniform(), tilt, flat ? 1e-4 : 1e-2);
    if (alike) {
      contact.pose.rotation = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
      contact.pose.displacement = (2 * solid.inradius() - 1e-4) * on_a.outward;
    }
    Pose a, b;
    const Eigen::Vector3i site(k % pairs_a_side, k / pairs_a_side % pairs_a_side, k / (pairs_a_side * pairs_a_side));
    a.position = spacing * site.cast<double>();
    a.orientation = constructed::random_orientation(random);
    b.position = a.position + a.orientation * contact.pose.displacement;
    b.orientation = a.orientation * Eigen::Quaterniond(contact.pose.rotation);
    const bool b_first = k % 2 == 1;  // A is the particle with the lower index
    made.packing.poses.insert(made.packing.poses.end(), {b_first ? b : a, b_first ? a : b});
    made.faces.insert(made.faces.end(), {b_first ? on_b.faces : on_a.faces, b_first ? on_a.faces : on_b.faces});
  }
  return made;
}

TEST(ExportFrame, ConstructedContactsMarkTheirFaces) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto made = constructed_pairs(seed);
    const auto frame = make_frame(made.packing, std::nullopt);
    const auto faces = made.packing.solids.only().faces().size();
    ASSERT_EQ(frame.faces.size(), made.packing.poses.size() * faces);
    for (int i = 0; i < made.packing.size(); ++i) {
      const auto contact = kind_of(i / 2);
      const auto place = ::testing::Message()
                         << "seed " << seed << ", particle " << i << ", " << static_cast<int>(contact);
      EXPECT_EQ(frame.Z[i], 1) << place;
      EXPECT_EQ(frame.cluster[i], contact == FaceContact::face_face ? i / 2 * 2 : ExportFrame::no_cluster) << place;
      for (std::size_t f = 0; f < faces; ++f) {
        const bool touched = (made.faces[i] >> f & 1) != 0;
        EXPECT_EQ(static_cast<int>(frame.faces[i * faces + f]), touched ? static_cast<int>(contact) : 0)
            << place << ", face " << f;
      }
    }
  }
}

TEST(ExportFrame, AFaceIsMarkedWithItsStrongestContact) {
  auto made = constructed_pairs(1);
  const auto& solid = made.packing.solids.only();
  // Another particle touches face 0 of particle 0 face to face. A third particle touches the same face with a vertex,
  // after the other one or before.
  const auto& host = made.packing.poses[0];
  const auto weak = constructed::contact(constructed::face_site(solid, 0), constructed::vertex_site(solid, 0), 0.3,
                                         Vector3d::Zero(), 1e-2);
  Pose third;
  third.position = host.position + host.orientation * weak.pose.displacement;
  third.orientation = host.orientation * Eigen::Quaterniond(weak.pose.rotation);
  made.packing.poses.push_back(third);
  const auto frame = make_frame(made.packing, std::nullopt);
  EXPECT_GE(frame.Z[0], 2) << "both touch";
  EXPECT_EQ(static_cast<int>(frame.faces[0]), static_cast<int>(FaceContact::face_face));
  std::reverse(made.packing.poses.begin(), made.packing.poses.end());
  const auto reversed = make_frame(made.packing, std::nullopt);
  const auto first_face = (made.packing.poses.size() - 1) * solid.faces().size();
  EXPECT_EQ(static_cast<int>(reversed.faces[first_face]), static_cast<int>(FaceContact::face_face));
}

TEST(ExportFrame, TooFewContactsDecideNothing) {
  RandomStream random({4});
  const auto packing = random_packing(platonic(SolidKind::octahedron), 12, 0.2, random);
  const auto touching = static_cast<int>(PackingEnergy().contacts(packing).size());
  ASSERT_GT(touching, 0);
  const auto frame = make_frame(packing, 0.5);
  EXPECT_EQ(frame.delta_phi, 0.5);
  EXPECT_EQ(frame.cluster, std::vector<std::int32_t>(12, ExportFrame::undecided_cluster));
  int z = 0;
  for (int i = 0; i < 12; ++i) {
    z += frame.Z[i];
    bool marked = false;
    for (int f = 0; f < 8; ++f) {
      const auto face = frame.faces[8 * i + f];
      EXPECT_TRUE(face == FaceContact::none || face == FaceContact::undecided) << static_cast<int>(face);
      marked = marked || face == FaceContact::undecided;
    }
    EXPECT_EQ(marked, frame.Z[i] > 0) << "particle " << i;
  }
  EXPECT_EQ(z, 2 * touching);
}

TEST(ExportFrame, WrappingMovesByWholeSides) {
  const double ulp = std::numeric_limits<double>::epsilon();
  for (const double side : {1.0, 4.7, std::cbrt(100 / 0.68), 123.456}) {
    const PeriodicCell cell(side);
    const float float_side = static_cast<float>(side);
    for (const double cells :
         {0.0, -0.0, -1e-20, 1e-20, 0.25, 0.5, -0.5, 1.0, 1 - ulp, 1 - 1e-9, 0.5 - 1e-9, -7.3, 1e6 + 0.1}) {
      const Vector3d x = Vector3d::Constant(side * cells);
      const auto corner = into_cell(cell, x), centred = into_centred_cell(cell, x);
      const auto place = ::testing::Message() << cells << " sides of " << side;
      EXPECT_TRUE(corner.wrapped[0] >= 0 && corner.wrapped[0] < side) << place << ": " << corner.wrapped[0];
      EXPECT_NEAR(corner.wrapped[0] + side * corner.image[0], x[0], 2 * ulp * side * (1 + std::abs(cells))) << place;
      const auto single = static_cast<float>(centred.wrapped[0]);
      EXPECT_EQ(static_cast<double>(single), centred.wrapped[0]) << place;
      EXPECT_TRUE(single >= -float_side / 2 && single < float_side / 2) << place << ": " << single;
      EXPECT_NEAR(centred.wrapped[0] + side * centred.image[0], x[0],
                  side * (std::numeric_limits<float>::epsilon() + 2 * ulp * (1 + std::abs(cells))))
          << place;
      EXPECT_EQ(into_cell(cell, corner.wrapped).wrapped, corner.wrapped) << place;
    }
  }
}

TEST(ExportFrame, FramesOfDifferentPackingsAreRejected) {
  RandomStream random({5});
  const auto make = [&](SolidKind kind, int n) {
    return make_frame(random_packing(platonic(kind), n, 0.2, random), std::nullopt);
  };
  const std::vector twelve{make(SolidKind::octahedron, 12), make(SolidKind::octahedron, 12)};
  EXPECT_NO_THROW(check_frames(twelve));
  EXPECT_THROW(check_frames({}), std::invalid_argument);
  EXPECT_THROW(check_frames(std::vector{twelve[0], make(SolidKind::octahedron, 13)}), std::invalid_argument);
  EXPECT_THROW(check_frames(std::vector{twelve[0], make(SolidKind::cube, 12)}), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
