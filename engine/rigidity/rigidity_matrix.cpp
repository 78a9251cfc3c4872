#include "engine/rigidity/rigidity_matrix.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace isojam {

namespace {

using Eigen::Vector3d;

class Rows {
 public:
  explicit Rows(const Packing& packing) : packing_(packing) {}

  /// Adds ∇V of the contact, converted from the frame of A to the lab frame.
  void add_normal(const Contact& contact) {
    const Eigen::Quaterniond& q = orientation(contact.pair.a);
    const Vector3d area = q * contact.overlap.area, moment = q * contact.overlap.moment;
    const Vector6d on_a = joined(area, moment / radius(contact.pair.a));
    const Vector6d on_b = joined(-area, (contact.displacement.cross(area) - moment) / radius(contact.pair.b));
    const double length = std::sqrt(on_a.squaredNorm() + on_b.squaredNorm());
    add(contact, on_a / length, on_b / length);
    forces_.push_back(contact.overlap.volume / 2 * length);
  }

  /// Adds a rotation of A relative to B about `axis`, a unit vector in the frame of A.
  void add_tilt(const Contact& contact, const Vector3d& axis) {
    // θ_A − θ_B = R·θ_A/R_A − R·θ_B/R_B; the row has unit length.
    const double ratio = radius(contact.pair.a) / radius(contact.pair.b);
    const Vector3d rotation =
        std::sqrt(2 / (1 + ratio * ratio)) * (orientation(contact.pair.a) * axis / std::numbers::sqrt2);
    add(contact, joined(Vector3d::Zero(), rotation), joined(Vector3d::Zero(), -ratio * rotation));
    forces_.push_back(0);
  }

  RigidityMatrix matrix() const {
    RigidityMatrix result;
    result.rows.resize(static_cast<Eigen::Index>(forces_.size()), 6 * Eigen::Index{packing_.size()});
    result.rows.setFromTriplets(entries_.begin(), entries_.end());
    result.forces = Eigen::Map<const Eigen::VectorXd>(forces_.data(), static_cast<Eigen::Index>(forces_.size()));
    const double size = result.forces.norm();
    if (size > 0) result.imbalance = (result.rows.transpose() * result.forces).norm() / size;
    return result;
  }

 private:
  const Eigen::Quaterniond& orientation(int particle) const {
    return packing_.poses[static_cast<std::size_t>(particle)].orientation;
  }

  double radius(int particle) const { return packing_.solids[static_cast<std::size_t>(particle)].gyration_radius(); }

  void add(const Contact& contact, const Vector6d& on_a, const Vector6d& on_b) {
    const int row = static_cast<int>(forces_.size());
    for (int k = 0; k < 6; ++k) {
      entries_.emplace_back(row, 6 * contact.pair.a + k, on_a[k]);
      entries_.emplace_back(row, 6 * contact.pair.b + k, on_b[k]);
    }
  }

  const Packing& packing_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> forces_;
};

/// The solids of A and B.
using Pair = std::pair<const ConvexSolid&, const ConvexSolid&>;

void add_edge_face(const Pair& solids, const Contact& contact, const Alignment& alignment, Rows& rows) {
  if (alignment.edge < 0 || alignment.face < 0)
    throw std::invalid_argument("an edge-face contact without an edge in a face");
  const ConvexSolid &of_edge = alignment.edge_of_a ? solids.first : solids.second,
                    &of_face = alignment.edge_of_a ? solids.second : solids.first;
  const Edge& edge = of_edge.edges()[static_cast<std::size_t>(alignment.edge)];
  const Vector3d along =
      of_edge.vertices()[static_cast<std::size_t>(edge.head)] - of_edge.vertices()[static_cast<std::size_t>(edge.tail)];
  const Vector3d& normal = of_face.faces()[static_cast<std::size_t>(alignment.face)].normal;
  const Eigen::Matrix3d& to_a = contact.pose.rotation;
  rows.add_tilt(contact, alignment.edge_of_a ? along.cross(to_a * normal).normalized()
                                             : (to_a * along).cross(normal).normalized());
}

void add_face_face(const ConvexSolid& a, const Contact& contact, const Alignment& alignment, Rows& rows) {
  if (alignment.face_a < 0) throw std::invalid_argument("a face-face contact without faces");
  const Vector3d& normal = a.faces()[static_cast<std::size_t>(alignment.face_a)].normal;
  const Vector3d in_plane = normal.unitOrthogonal();
  rows.add_tilt(contact, in_plane);
  rows.add_tilt(contact, normal.cross(in_plane));
}

}  // namespace

RigidityMatrix normal_constraints(const Packing& packing, std::span<const Contact> contacts) {
  Rows rows(packing);
  for (const Contact& contact : contacts) rows.add_normal(contact);
  return rows.matrix();
}

RigidityMatrix class_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments, std::span<const ContactClass> classes) {
  if (alignments.size() != contacts.size() || classes.size() != contacts.size())
    throw std::invalid_argument("each contact needs one alignment and one class");
  Rows rows(packing);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    rows.add_normal(contacts[k]);
    const Pair solids{packing.solids[static_cast<std::size_t>(contacts[k].pair.a)],
                      packing.solids[static_cast<std::size_t>(contacts[k].pair.b)]};
    switch (classes[k]) {
      case ContactClass::face_face: add_face_face(solids.first, contacts[k], alignments[k], rows); break;
      case ContactClass::edge_face: add_edge_face(solids, contacts[k], alignments[k], rows); break;
      case ContactClass::lower_order: break;
    }
  }
  return rows.matrix();
}

std::vector<int> underconstrained(const RigidityMatrix& matrix, int particles) {
  std::vector<int> found;
  for (int i = 0; i < particles; ++i) {
    const Eigen::SparseMatrix<double> own = matrix.rows.middleCols(6 * i, 6);
    const Matrix6d products = Eigen::MatrixXd(own.transpose() * own);
    if (products.fullPivLu().rank() < 6) found.push_back(i);
  }
  return found;
}

}  // namespace isojam
