#include "tasks/extras/export/contact_faces.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

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

}  // namespace

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

}  // namespace isojam
