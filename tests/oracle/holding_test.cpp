// References: differences of gradients in quadruple precision, because the Hessian in double has much larger errors;
// Gaussian elimination with complete pivoting for the ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/overlap/small_distances.hpp"
#include "engine/packing/neighbours.hpp"
#include "engine/rigidity/pair_stiffness.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tests/engine/vibration/jammed_states.hpp"
#include "tests/oracle/quad_packing.hpp"

namespace isojam::oracle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();
/// Fraction of the rounding bound that the errors are expected to reach.
constexpr double likely = .25;

Quad size_of(Quad x) { return x < 0 ? -x : x; }

/// A contact: V, |S|, and ∇V with respect to {x_A, R·θ_A, x_B, R·θ_B} in the lab frame.
struct QuadContact {
  Quad volume = 0, area = 0;
  double rounding = 0;  ///< ρ of Evaluation::residual_floor: relative error of V and ∇V in double
  std::array<Quad, 12> slope{};

  Quad slope_size() const {
    Quad square = 0;
    for (const Quad g : slope) square += g * g;
    return square_root(square);
  }
};

QuadContact in_quad(const Packing& packing, const NeighbourPair& pair) {
  const Pose &a = packing.poses[pair.a], &b = packing.poses[pair.b];
  const Quad3 r = widened(displacement_double_double(packing, pair));
  const QuadOverlap overlap = clipped_overlap(packing.solids[pair.a], packing.solids[pair.b], relative_pose(a, b, r));
  const QuadMatrix q = quad_rotation(a);
  const Quad3 area = q * overlap.area, turn_a = q * overlap.moment;
  // V does not change if both particles rotate together about the centre of A.
  const Quad3 turn_b = cross(r, area) - turn_a;
  const Quad radius_a = packing.solids[pair.a].gyration_radius(), radius_b = packing.solids[pair.b].gyration_radius();
  QuadContact contact{overlap.volume, norm(area), 0, {}};
  const ConvexSolid &solid_a = packing.solids[pair.a], &solid_b = packing.solids[pair.b];
  const double distances = gap_tolerance(solid_a, solid_b, rounded(r)), size = static_cast<double>(contact.area);
  contact.rounding =
      distances / std::max(double_double_below(solid_a, solid_b), static_cast<double>(contact.volume) / size) +
      distances / std::sqrt(size);
  for (std::size_t k = 0; k < 3; ++k) {
    contact.slope[k] = area[k], contact.slope[3 + k] = turn_a[k] / radius_a;
    contact.slope[6 + k] = -area[k], contact.slope[9 + k] = turn_b[k] / radius_b;
  }
  return contact;
}

/// A jammed state with all results of the engine that are tested.
struct Held {
  Held(std::string its_name, const JamResult& jam)
      : name(std::move(its_name)),
        packing(nearest_state(jam)),
        distance(packing.density() - jam.phi_j.value().density),
        contacts(PackingEnergy().contacts(packing)),
        pairs(pair_stiffnesses(packing, contacts)),
        normals(normal_constraints(packing, contacts)),
        hessian(PackingEnergy().hessian(packing, Precision::double_double)) {
    for (const Contact& contact : contacts) {
      exact.push_back(in_quad(packing, contact.pair));
      least_depth = std::min(least_depth, static_cast<double>(exact.back().volume / exact.back().area));
    }
  }

  std::string name;
  const Packing& packing;
  double distance;
  std::vector<Contact> contacts;
  std::vector<PairStiffness> pairs;
  RigidityMatrix normals;
  BlockMatrix hessian;
  std::vector<QuadContact> exact;
  double least_depth = std::numeric_limits<double>::infinity();
};

/// Jammed states of three solids. One of the solids has a second state nearer to jamming.
const std::vector<Held>& states() {
  static const std::vector<Held> made = [] {
    std::vector<Held> list;
    list.emplace_back("octahedra", jammed(SolidKind::octahedron, 48, .01));
    list.emplace_back("tetrahedra", jammed(SolidKind::tetrahedron, 64, .02));
    list.emplace_back("icosahedra", jammed(SolidKind::icosahedron, 32, .01));
    list.emplace_back("icosahedra nearer", jammed(SolidKind::icosahedron, 32, .0005));
    return list;
  }();
  return made;
}

using QuadRow = std::vector<Quad>;

/// A row of unit length for a contact.
QuadRow unit_row(const Packing& packing, const NeighbourPair& pair, const std::array<Quad, 12>& entries) {
  Quad square = 0;
  for (const Quad x : entries) square += x * x;
  QuadRow row(6 * packing.poses.size());
  for (std::size_t k = 0; k < 6; ++k) {
    row[6 * static_cast<std::size_t>(pair.a) + k] += entries[k] / square_root(square);
    row[6 * static_cast<std::size_t>(pair.b) + k] += entries[6 + k] / square_root(square);
  }
  return row;
}

/// The rotation of A minus that of B, about an axis in the lab frame.
QuadRow tilt_row(const Packing& packing, const NeighbourPair& pair, const Quad3& axis) {
  const Quad radius_a = packing.solids[pair.a].gyration_radius(), radius_b = packing.solids[pair.b].gyration_radius();
  std::array<Quad, 12> entries{};
  for (std::size_t k = 0; k < 3; ++k) entries[3 + k] = axis[k] / radius_a, entries[9 + k] = -axis[k] / radius_b;
  return unit_row(packing, pair, entries);
}

/// Axes of the rotations that a contact of this class opposes. Face-face contacts have two in the plane of the faces,
/// and edge-face contacts have one: edge × normal of the face.
std::vector<Quad3> tilt_axes(const Packing& packing, const NeighbourPair& pair, const Alignment& angle,
                             ContactClass its_class) {
  if (its_class == ContactClass::lower_order) return {};
  const QuadMatrix to_lab_a = quad_rotation(packing.poses[pair.a]), to_lab_b = quad_rotation(packing.poses[pair.b]);
  const SolidArrays &a = packing.solids[pair.a].arrays(), &b = packing.solids[pair.b].arrays();
  if (its_class == ContactClass::face_face) {
    const Quad3 n = to_lab_a * a.normal(angle.face_a);
    const Quad3 in_plane = cross(n, size_of(n[0]) < size_of(n[1]) ? Quad3{1, 0, 0} : Quad3{0, 1, 0});
    return {in_plane, cross(n, in_plane)};
  }
  const SolidArrays &of_edge = angle.edge_of_a ? a : b, &of_face = angle.edge_of_a ? b : a;
  const EdgeRecord& edge = of_edge.record[angle.edge];
  const Quad3 along = of_edge.vertex(edge.head) - of_edge.vertex(edge.tail);
  return {cross((angle.edge_of_a ? to_lab_a : to_lab_b) * along,
                (angle.edge_of_a ? to_lab_b : to_lab_a) * of_face.normal(angle.face))};
}

/// Absolute values of the pivots of Gaussian elimination with complete pivoting, in descending order.
std::vector<double> pivots_of(std::vector<QuadRow> rows) {
  std::vector<double> pivots;
  while (!rows.empty()) {
    std::size_t at = 0, column = 0;
    Quad largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t k = 0; k < rows[i].size(); ++k) {
        if (size_of(rows[i][k]) > largest) largest = size_of(rows[i][k]), at = i, column = k;
      }
    }
    if (!(largest > 0)) break;
    pivots.push_back(static_cast<double>(largest));
    std::swap(rows[at], rows.back());
    const QuadRow pivot = std::move(rows.back());
    rows.pop_back();
    std::vector<std::size_t> filled;
    for (std::size_t k = 0; k < pivot.size(); ++k) {
      if (pivot[k] != 0 && k != column) filled.push_back(k);
    }
    for (QuadRow& row : rows) {
      if (row[column] == 0) continue;
      const Quad factor = row[column] / pivot[column];
      for (const std::size_t k : filled) row[k] -= factor * pivot[k];
      row[column] = 0;
    }
  }
  std::sort(pivots.rbegin(), pivots.rend());
  return pivots;
}

/// All rows of a state, and the contact to which each row belongs.
struct QuadRows {
  QuadRows(const Held& held, const std::vector<Alignment>& angles, const std::vector<ContactClass>& classes) {
    std::vector<Quad> unbalanced(6 * held.packing.poses.size());
    Quad forces = 0, left = 0;
    for (std::size_t c = 0; c < held.contacts.size(); ++c) {
      const NeighbourPair& pair = held.contacts[c].pair;
      first.push_back(static_cast<Index>(rows.size()));
      rows.push_back(unit_row(held.packing, pair, held.exact[c].slope));
      const Quad force = held.exact[c].volume / 2 * held.exact[c].slope_size();
      forces += force * force;
      for (std::size_t k = 0; k < unbalanced.size(); ++k) unbalanced[k] += force * rows.back()[k];
      for (const Quad3& axis : tilt_axes(held.packing, pair, angles[c], classes[c]))
        rows.push_back(tilt_row(held.packing, pair, axis));
    }
    first.push_back(static_cast<Index>(rows.size()));
    for (const Quad x : unbalanced) left += x * x;
    imbalance = static_cast<double>(square_root(left / forces));
  }
  MatrixXd rounded() const {
    MatrixXd matrix(static_cast<Index>(rows.size()), static_cast<Index>(rows.front().size()));
    for (Index i = 0; i < matrix.rows(); ++i) {
      for (Index k = 0; k < matrix.cols(); ++k)
        matrix(i, k) = static_cast<double>(rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
    }
    return matrix;
  }

  std::vector<QuadRow> rows;
  std::vector<Index> first;  ///< first row of every contact, and the number of all rows
  double imbalance = 0;
};

void check_rows(const Held& held, const RigidityMatrix& matrix, const QuadRows& exact) {
  const MatrixXd found = matrix.rows, right = exact.rounded();
  ASSERT_EQ(found.rows(), right.rows());
  double worst_normal = 0, worst_tilt = 0;
  for (std::size_t c = 0; c < held.contacts.size(); ++c) {
    const Index row = exact.first[c], tilts = exact.first[c + 1] - row - 1;
    const double off = (found.row(row) - right.row(row)).norm();
    worst_normal = std::max(worst_normal, off / held.exact[c].rounding);
    // The two axes in the plane can be any; only their span is compared.
    const auto of_found = found.middleRows(row + 1, tilts), of_right = right.middleRows(row + 1, tilts);
    worst_tilt = std::max(worst_tilt, (of_found.transpose() * of_found - of_right.transpose() * of_right).norm());
  }
  std::printf("  rows off: normals %.2f of rounding, tilts %.1e; ", worst_normal, worst_tilt);
  EXPECT_LE(worst_normal, likely);
  EXPECT_LE(worst_tilt, 64 * eps);
}

void check_rank(const char* what, const Held& held, const RigidityMatrix& matrix, const QuadRows& exact) {
  check_rows(held, matrix, exact);
  const Rigidity rigidity = analyse_rigidity(matrix);
  // The contact forces are a state of self-stress, except for the force residual.
  EXPECT_NEAR(matrix.imbalance, exact.imbalance, .01 * exact.imbalance);
  const double zero = RigidityOptions{}.margin * exact.imbalance;
  const std::vector<double> pivots = pivots_of(exact.rows);
  const auto rank = std::count_if(pivots.begin(), pivots.end(), [&](double pivot) { return pivot > zero; });
  EXPECT_EQ(rigidity.rank, rank);
  EXPECT_EQ(rigidity.self_stress, static_cast<Index>(exact.rows.size()) - rank);
  const auto kept = static_cast<std::size_t>(rank);
  const double dropped = kept < pivots.size() ? pivots[kept] : 0;
  std::printf("%zu %s, rank %d of %d, %d states of self-stress, pivots %.1e | %.1e, imbalance %.1e\n",
              exact.rows.size(), what, rigidity.rank, 6 * held.packing.size() - 3, rigidity.self_stress,
              pivots[kept - 1], dropped, exact.imbalance);
  EXPECT_GE(pivots[kept - 1], 1e6 * std::max(dropped, exact.imbalance));
}

TEST(HoldingTest, RanksAreThoseOfElimination) {
  for (const Held& held : states()) {
    SCOPED_TRACE(held.name);
    std::printf("%s, Δφ = %.1e:\n", held.name.c_str(), held.distance);
    const auto angles = alignments(held.packing.solids, held.contacts);
    const auto classes = analyse_contacts(held.packing.solids, held.packing.size(), held.contacts, angles).classes;
    const std::vector<ContactClass> points(classes.size(), ContactClass::lower_order);
    check_rank("normals", held, held.normals, QuadRows(held, angles, points));
    check_rank("rows by class", held, class_constraints(held.packing, held.contacts, angles, classes),
               QuadRows(held, angles, classes));
  }
}

}  // namespace
}  // namespace isojam::oracle
