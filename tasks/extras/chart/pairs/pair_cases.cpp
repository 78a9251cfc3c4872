#include "tasks/extras/chart/pairs/pair_cases.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/random/stream.hpp"
#include "tasks/extras/chart/pairs/intersection.hpp"

namespace isojam {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::uint64_t seed = 20110711;

/// Positions of B along a line: B overlaps A at `start` and moves out of A along `direction`.
struct Approach {
  Quaterniond quaternion;
  Vector3d start;
  Vector3d direction;
};

double between(RandomStream& random, double low, double high) { return low + (high - low) * random.uniform(); }

double log_between(RandomStream& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

std::size_t pick(RandomStream& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

Vector3d random_vector(RandomStream& random) { return {random.normal(), random.normal(), random.normal()}; }
Vector3d random_direction(RandomStream& random) { return random_vector(random).normalized(); }

Quaterniond random_quaternion(RandomStream& random) {
  const Vector3d imaginary = random_vector(random);
  return {random.normal(), imaginary.x(), imaginary.y(), imaginary.z()};
}

Vector3d random_normal_to(RandomStream& random, const Vector3d& axis) {
  return axis.cross(random_direction(random)).normalized();
}

/// Right-handed frame whose first axis is `axis`. The second axis is as close to `hint` as possible.
Matrix3d frame(const Vector3d& axis, const Vector3d& hint) {
  Matrix3d f;
  f.col(0) = axis.normalized();
  f.col(2) = axis.cross(hint).normalized();
  f.col(1) = f.col(2).cross(f.col(0));
  return f;
}

/// Rotation from the frame `from` to the frame `to`.
Quaterniond taking(const Matrix3d& from, const Matrix3d& to) { return Quaterniond(Matrix3d(to * from.transpose())); }

Quaterniond turn(double angle, const Vector3d& axis) {
  return Quaterniond(std::cos(angle / 2), std::sin(angle / 2) * axis.x(), std::sin(angle / 2) * axis.y(),
                     std::sin(angle / 2) * axis.z());
}

/// The faces are regular, so the foot of the normal is the centre.
Vector3d face_centre(const Face& face) { return face.offset * face.normal; }

Approach random_contact(RandomStream& random) {
  return {random_quaternion(random), Vector3d::Zero(), random_direction(random)};
}

Approach near_parallel_faces(RandomStream& random, const ConvexSolid& a, const ConvexSolid& b) {
  const Face& face_a = a.faces()[pick(random, a.faces().size())];
  const Face& face_b = b.faces()[pick(random, b.faces().size())];
  const Vector3d n = face_a.normal;
  const Quaterniond facing =
      taking(frame(face_b.normal, random_normal_to(random, face_b.normal)), frame(-n, random_normal_to(random, n)));
  const Quaterniond q = turn(log_between(random, 1e-10, 1e-2), random_normal_to(random, n)) * facing;
  const double reach = .5 * (a.vertices()[face_a.vertices[0]] - face_centre(face_a)).norm();
  return {q, random.uniform() * reach * random_normal_to(random, n), n};
}

/// An outward direction of the edge, strictly between the normals of its two faces.
Vector3d edge_normal(RandomStream& random, const ConvexSolid& solid, const Edge& edge) {
  const double s = between(random, .1, .9);
  return ((1 - s) * solid.faces()[edge.left].normal + s * solid.faces()[edge.right].normal).normalized();
}

Vector3d middle(const ConvexSolid& solid, const Edge& edge) {
  return (solid.vertices()[edge.tail] + solid.vertices()[edge.head]) / 2;
}

Vector3d along(const ConvexSolid& solid, const Edge& edge) {
  return solid.vertices()[edge.head] - solid.vertices()[edge.tail];
}

Approach edge_in_face(RandomStream& random, const ConvexSolid& a, const ConvexSolid& b) {
  const Edge& edge = a.edges()[pick(random, a.edges().size())];
  const Face& face = b.faces()[pick(random, b.faces().size())];
  const Vector3d m = edge_normal(random, a, edge);
  const Quaterniond facing =
      taking(frame(face.normal, random_normal_to(random, face.normal)), frame(-m, along(a, edge)));
  const double tilt = random.uniform() < .5 ? 0 : log_between(random, 1e-16, 1e-2);
  const Vector3d aside = random.uniform() * .3 * along(a, edge).norm() * random_normal_to(random, m);
  return {turn(tilt, random_normal_to(random, m)) * facing, middle(a, edge) + aside, m};
}

Approach parallel_edges(RandomStream& random, const ConvexSolid& a, const ConvexSolid& b) {
  const Edge& edge_a = a.edges()[pick(random, a.edges().size())];
  const Edge& edge_b = b.edges()[pick(random, b.edges().size())];
  const Vector3d m = edge_normal(random, a, edge_a);
  const Quaterniond q = taking(frame(edge_normal(random, b, edge_b), along(b, edge_b)), frame(-m, along(a, edge_a)));
  const Vector3d aside = between(random, -.4, .4) * along(a, edge_a) - b.inradius() * m;
  return {q, middle(a, edge_a) - q * middle(b, edge_b) + aside, m};
}

Approach vertex_vertex(RandomStream& random, const ConvexSolid& a, const ConvexSolid& b) {
  const std::size_t i = pick(random, a.vertices().size()), j = pick(random, b.vertices().size());
  const Vector3d &u = a.vertices()[i], &v = b.vertices()[j];
  const Vector3d neighbour = a.vertices()[(i + 1) % a.vertices().size()] + .1 * random_direction(random);
  const Matrix3d facing = frame(-u, random.uniform() < .5 ? neighbour : random_direction(random));
  return {taking(frame(v, b.vertices()[(j + 1) % b.vertices().size()]), facing), Vector3d::Zero(), u.normalized()};
}

/// One of the 12 rotations of the tetrahedron. They are symmetries of all five solids and exact in doubles.
Quaterniond exact_symmetry(RandomStream& random) {
  const std::size_t k = pick(random, 12);
  if (k < 4) return Quaterniond(k == 0, k == 1, k == 2, k == 3);
  const auto half = [k](std::size_t bit) { return (k - 4) >> bit & 1 ? -.5 : .5; };
  return Quaterniond(.5, half(0), half(1), half(2));
}

/// Any rotation of the solid onto itself, with rounding errors.
Quaterniond rounded_symmetry(RandomStream& random, const ConvexSolid& solid) {
  const auto face_frame = [&](const Face& face, std::size_t corner) {
    return frame(face.normal, solid.vertices()[face.vertices[corner]] - face_centre(face));
  };
  const Face& from = solid.faces()[pick(random, solid.faces().size())];
  const Face& to = solid.faces()[pick(random, solid.faces().size())];
  return taking(face_frame(from, 0), face_frame(to, pick(random, to.vertices.size())));
}

/// A vector parallel to a face. Its multiples by a number of 24 bits are exact.
Vector3d exact_in_plane(RandomStream& random, SolidKind kind) {
  const auto small = [&] { return static_cast<double>(pick(random, 17)) - 8; };
  const double x = small(), y = small() + .5;
  if (kind == SolidKind::cube) return {0, x, y};          // parallel to the face with the normal (1, 0, 0)
  if (kind == SolidKind::dodecahedron) return {0, y, 0};  // parallel to a face with a normal (g, 0, ±1)
  return {x, y, -x - y};                                  // parallel to the face with the normal (1, 1, 1)
}

/// Volume of the intersection in doubles, which suffices to construct pairs.
double rough_volume(const PairCase& pair) {
  return intersection<double>(platonic(pair.a), Pose{}, platonic(pair.b), pair.pose()).volume();
}

/// Moves B along the line until the volume is within 1 % of `target`. Returns nullopt if this does not succeed.
std::optional<PairCase> at_volume(SolidKind a, SolidKind b, const Approach& approach, double target) {
  double deep = 0, free = 2 * (platonic(a).circumradius() + platonic(b).circumradius());
  PairCase pair{a, b, approach.quaternion, approach.start};
  if (rough_volume(pair) < target) return std::nullopt;
  for (int step = 0; step < 60; ++step) {
    const double t = (deep + free) / 2;
    pair.displacement = approach.start + t * approach.direction;
    const double volume = rough_volume(pair);
    if (std::abs(volume - target) < .01 * target) return pair;
    (volume > target ? deep : free) = t;
  }
  return std::nullopt;
}

std::optional<PairCase> contact(RandomStream& random, SolidKind a, SolidKind b, const Approach& approach) {
  const double margin = 1.02;  // at_volume() stops within 1 %
  return at_volume(a, b, approach,
                   log_between(random, least_contact_volume * margin, greatest_contact_volume / margin));
}

std::optional<PairCase> coplanar_faces(RandomStream& random, SolidKind a, SolidKind b) {
  const bool exact = random.uniform() < .5;
  const Vector3d n = platonic(a).faces()[pick(random, platonic(a).faces().size())].normal;
  Vector3d within = exact ? exact_in_plane(random, a) : random_normal_to(random, n);
  const Quaterniond q = exact ? exact_symmetry(random) : rounded_symmetry(random, platonic(b));
  const double length = within.norm();
  // Faces that share an area need a large overlap. In a small overlap, the faces are coplanar but do not touch.
  const double target = random.uniform() < .5 ? between(random, .3, .97) : log_between(random, 1e-4, .9);
  auto pair = at_volume(a, b, {q, Vector3d::Zero(), within / length}, target);
  if (!pair || !exact) return pair;
  const double t = static_cast<float>(pair->displacement.norm() / length);
  return PairCase{a, b, q, t * within};
}

PairCase near_coincident(RandomStream& random, SolidKind a, SolidKind b) {
  const double angle = random.uniform() < .3 ? 0 : log_between(random, 1e-16, 1e-8);
  const double distance = angle > 0 && random.uniform() < .3 ? 0 : log_between(random, 1e-16, 1e-8);
  const Quaterniond q = turn(angle, random_direction(random)) * exact_symmetry(random);
  return {a, b, q, distance * random_direction(random)};
}

std::optional<PairCase> attempt(RandomStream& random, SolidKind kind_a, SolidKind kind_b, PairClass pair_class) {
  const ConvexSolid &a = platonic(kind_a), &b = platonic(kind_b);
  switch (pair_class) {
    case PairClass::random_contact: return contact(random, kind_a, kind_b, random_contact(random));
    case PairClass::near_parallel_faces: return contact(random, kind_a, kind_b, near_parallel_faces(random, a, b));
    case PairClass::edge_in_face: return contact(random, kind_a, kind_b, edge_in_face(random, a, b));
    case PairClass::parallel_edges: return contact(random, kind_a, kind_b, parallel_edges(random, a, b));
    case PairClass::vertex_vertex: return contact(random, kind_a, kind_b, vertex_vertex(random, a, b));
    case PairClass::same_orientation:
      return at_volume(kind_a, kind_b, {exact_symmetry(random), Vector3d::Zero(), random_direction(random)},
                       log_between(random, 1e-5, .9));
    case PairClass::coplanar_faces: return coplanar_faces(random, kind_a, kind_b);
    case PairClass::coincident: {
      const bool exact = random.uniform() < .5;
      return PairCase{kind_a, kind_b, exact ? exact_symmetry(random) : rounded_symmetry(random, b), Vector3d::Zero()};
    }
    case PairClass::near_coincident: return near_coincident(random, kind_a, kind_b);
  }
  throw std::logic_error("unknown class of pairs");
}

}  // namespace

std::vector<PairCase> pair_cases(SolidKind a, SolidKind b, PairClass pair_class, int count) {
  RandomStream random{seed, static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b),
                      static_cast<std::uint64_t>(pair_class)};
  std::vector<PairCase> cases;
  for (int tries = 0; static_cast<int>(cases.size()) < count; ++tries) {
    if (tries > 100 * count) throw std::logic_error("no pairs of class " + std::string(to_string(pair_class)));
    if (auto pair = attempt(random, a, b, pair_class)) cases.push_back(std::move(*pair));
  }
  return cases;
}

}  // namespace isojam
