#include "tasks/extras/export/frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include "engine/analysis/clusters.hpp"
#include "engine/analysis/contacts.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The faces of A and of B that belong to a contact.
struct ContactFaces {
  FeatureSet of_a{}, of_b{};
};

/// Cut-offs (radians) of the angle between two faces, and of the angle between an edge and a face.
struct Cutoffs {
  double face_face = 0, edge_face = 0;
};

FeatureSet set_of(std::initializer_list<int> faces) {
  FeatureSet set{};
  for (const int face : faces) set.insert(static_cast<std::uint32_t>(face));
  return set;
}

/// One of the two solids of a contact, in the body frame of A, with its part in the contact.
struct Body {
  const ConvexSolid& solid;
  Matrix3d rotation;
  Vector3d centre;
  FeatureSet faces, edges;

  Vector3d normal(int face) const { return rotation * solid.faces()[face].normal; }
  /// Depth of a point below the plane of the face.
  double depth(int face, const Vector3d& point) const {
    return solid.faces()[face].offset - normal(face).dot(point - centre);
  }
  Vector3d vertex(int v) const { return centre + rotation * solid.vertices()[v]; }
};

/// The faces with the smallest depth that was found so far.
struct Least {
  double depth = std::numeric_limits<double>::infinity();
  ContactFaces faces;

  void offer(double other_depth, const ContactFaces& other) {
    if (other_depth < depth) *this = {other_depth, other};
  }
};

ContactFaces aligned_faces(const Body& a, const Body& b, double cutoff) {
  Least least;
  a.faces.for_each([&](int i) {
    b.faces.for_each([&](int j) {
      const Vector3d n = a.normal(i), m = b.normal(j);
      if (nearest::atan2(n.cross(m).norm(), -n.dot(m)) >= cutoff) return;
      least.offer(a.depth(i, b.centre + b.solid.faces()[j].offset * m), {set_of({i}), set_of({j})});
    });
  });
  return least.faces;
}

/// Finds edges of `body` that lie in faces of `other`. named(faces of body, faces of other) returns the two in the
/// order A, B.
template <class Named>
void offer_edges(const Body& body, const Body& other, double cutoff, const Named& named, Least& least) {
  body.edges.for_each([&](int e) {
    const Edge& edge = body.solid.edges()[e];
    const Vector3d tail = body.vertex(edge.tail), head = body.vertex(edge.head);
    const Vector3d direction = (head - tail).normalized();
    other.faces.for_each([&](int f) {
      const Vector3d n = other.normal(f);
      if (nearest::atan2(std::abs(direction.dot(n)), direction.cross(n).norm()) >= cutoff) return;
      least.offer(other.depth(f, (tail + head) / 2), named(set_of({edge.left, edge.right}), set_of({f})));
    });
  });
}

ContactFaces aligned_edge(const Body& a, const Body& b, double cutoff) {
  Least least;
  offer_edges(
      a, b, cutoff,
      [](auto own, auto others) {
        return ContactFaces{own, others};
      },
      least);
  offer_edges(
      b, a, cutoff,
      [](auto own, auto others) {
        return ContactFaces{others, own};
      },
      least);
  return least.faces;
}

/// Finds the faces of a contact.
/// - For a face-face contact, these are its two faces.
/// - For an edge-face contact, these are the face, and the two faces that meet at the edge.
/// - For a lower-order contact, these are all faces that bound the intersection.
///
/// Several pairs of features may have alignment angles below the cut-off, for example if both solids have the same
/// orientation. The pair with the smallest depth then counts, because the others bound the intersection at its sides.
ContactFaces contact_faces(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Contact& contact,
                           ContactClass contact_class, const Cutoffs& cutoffs) {
  const auto& overlap = contact.overlap;
  const Body a{solid_a, Matrix3d::Identity(), Vector3d::Zero(), overlap.faces_a, overlap.edges_a};
  const Body b{solid_b, contact.pose.rotation, contact.pose.displacement, overlap.faces_b, overlap.edges_b};
  switch (contact_class) {
    case ContactClass::face_face: return aligned_faces(a, b, cutoffs.face_face);
    case ContactClass::edge_face: return aligned_edge(a, b, cutoffs.edge_face);
    case ContactClass::lower_order: break;
  }
  return {overlap.faces_a, overlap.faces_b};
}

void mark_faces(ExportFrame& frame, int particle, const FeatureSet& faces, FaceContact strength) {
  const auto first = frame.first_face[static_cast<std::size_t>(particle)];
  faces.for_each([&](int index) {
    auto& face = frame.faces[first + static_cast<std::size_t>(index)];
    // In one frame either all contacts are classified or none. Therefore `undecided` never has to be compared with the
    // other values.
    face = strength == FaceContact::undecided ? strength : std::max(face, strength);
  });
}

std::vector<std::int32_t> clusters_of(const Packing& packing, const ClassifiedContacts& classified) {
  const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
  std::vector<std::int32_t> labels(packing.poses.size(), ExportFrame::no_cluster);
  for (const auto& cluster : find_clusters(packing, bonds)) {
    if (cluster.size() < 2) continue;
    for (const int member : cluster.members) labels[static_cast<std::size_t>(member)] = cluster.label();
  }
  return labels;
}

}  // namespace

FaceContact strength_of(ContactClass contact_class) {
  switch (contact_class) {
    case ContactClass::face_face: return FaceContact::face_face;
    case ContactClass::edge_face: return FaceContact::edge_face;
    case ContactClass::lower_order: break;
  }
  return FaceContact::lower_order;
}

ExportFrame make_frame(Packing packing, std::optional<double> delta_phi, bool with_network, double gap) {
  const auto n = packing.poses.size();
  PackingEnergy energy;
  const auto classified = classified_contacts(packing, energy, gap);
  const bool decided = !undecided(classified.analysis);

  ExportFrame frame{std::move(packing), delta_phi, {}, {}, {}, {}};
  frame.Z.assign(n, 0);
  frame.cluster =
      decided ? clusters_of(frame.packing, classified) : std::vector<std::int32_t>(n, ExportFrame::undecided_cluster);
  frame.first_face.push_back(0);
  for (std::size_t i = 0; i < n; ++i)
    frame.first_face.push_back(frame.first_face.back() + frame.solid(i).faces().size());
  frame.faces.assign(frame.first_face.back(), FaceContact::none);
  const auto& solids = frame.packing.solids;
  for (std::size_t k = 0; k < classified.contacts.size(); ++k) {
    const auto& contact = classified.contacts[k];
    const auto contact_class = decided ? classified.analysis.classes[k] : ContactClass::lower_order;
    const auto strength = decided ? strength_of(contact_class) : FaceContact::undecided;
    const auto a = static_cast<std::size_t>(contact.pair.a), b = static_cast<std::size_t>(contact.pair.b);
    const auto& fits = classified.analysis.cutoffs_of(solids.unit(a), solids.unit(b));
    const auto faces =
        contact_faces(solids[a], solids[b], contact, contact_class, {fits.face_face.cutoff, fits.edge_face.cutoff});
    ++frame.Z[a];
    ++frame.Z[b];
    mark_faces(frame, contact.pair.a, faces.of_a, strength);
    mark_faces(frame, contact.pair.b, faces.of_b, strength);
  }
  if (with_network) frame.network = contact_network(frame.packing, classified);
  return frame;
}

void check_frames(std::span<const ExportFrame> frames) {
  if (frames.empty()) throw std::invalid_argument("no frames");
  const auto& first = frames.front().packing;
  for (const auto& frame : frames) {
    if (!(frame.packing.solids == first.solids) || frame.packing.size() != first.size()) {
      throw std::invalid_argument("frames of different particles");
    }
  }
}

namespace {

/// Moves a position by lattice vectors until its fractional coordinates are in [low, low + 1).
WrappedPosition into_any_cell(const PeriodicCell& cell, const Eigen::Vector3d& position, double low) {
  const Eigen::Vector3d cells = (cell.fractional(position).array() - low).floor();
  Eigen::Vector3i image = cells.cast<int>();
  Eigen::Vector3d rest = cell.fractional(position - cell.translation(image));
  for (int c = 0; c < 3; ++c) {
    // Rounding errors can leave a coordinate slightly outside of this range. It is then set to `low`.
    if (rest[c] >= low && rest[c] < low + 1) continue;
    image[c] += rest[c] < low ? 0 : 1;
    rest[c] = low;
  }
  return {cell.vectors().high * rest, image};
}

WrappedPosition into_cube(double side, const Eigen::Vector3d& position) {
  WrappedPosition result;
  for (int c = 0; c < 3; ++c) {
    double cells = std::floor(position[c] / side);
    double x = position[c] - side * cells;
    if (x < 0 || x >= side) {
      cells += x < 0 ? 0 : 1;
      x = 0;
    }
    result.wrapped[c] = x;
    result.image[c] = static_cast<int>(cells);
  }
  return result;
}

WrappedPosition into_centred_cube(const PeriodicCell& cell, const Eigen::Vector3d& position) {
  const float half = static_cast<float>(cell.side()) / 2;
  WrappedPosition result;
  result.image = -cell.nearest_shift(position);
  for (int c = 0; c < 3; ++c) {
    auto x = static_cast<float>(position[c] - cell.side() * result.image[c]);
    if (x >= half) {
      x = -half;
      ++result.image[c];
    }
    result.wrapped[c] = std::max(x, -half);
  }
  return result;
}

}  // namespace

WrappedPosition into_cell(const PeriodicCell& cell, const Eigen::Vector3d& position) {
  return cell.is_cube() ? into_cube(cell.side(), position) : into_any_cell(cell, position, 0);
}

WrappedPosition into_centred_cell(const PeriodicCell& cell, const Eigen::Vector3d& position) {
  return cell.is_cube() ? into_centred_cube(cell, position) : into_any_cell(cell, position, -0.5);
}

Eigen::Matrix3d to_standard_frame(const PeriodicCell& cell) {
  if (cell.is_cube()) return Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d& h = cell.vectors().high;
  Eigen::Matrix3d turn;  // its rows are the new axes
  turn.row(0) = h.col(0).normalized();
  turn.row(2) = h.col(0).cross(h.col(1)).normalized();
  turn.row(1) = turn.row(2).cross(turn.row(0));
  return turn;
}

Packing in_standard_frame(Packing packing) {
  if (packing.cell.is_cube()) return packing;
  const Eigen::Matrix3d turn = to_standard_frame(packing.cell);
  DoubleDoubleMatrix upper;
  upper.high = (turn * packing.cell.vectors().high).triangularView<Eigen::Upper>();
  packing.cell = PeriodicCell(upper);
  const Eigen::Quaterniond rotation(turn);
  for (auto& pose : packing.poses) pose = {turn * pose.position, rotation * pose.orientation, {0, 0, 0}, {0, 0, 0, 0}};
  return packing;
}

}  // namespace isojam
