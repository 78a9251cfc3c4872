#include "tests/engine/geometry/overlap/pairs.hpp"

#include <limits>
#include <sstream>

namespace isojam::testing_pairs {

Eigen::Vector3d random_direction(RandomStream& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Vector3d(x, y, z).normalized();
}

Eigen::Quaterniond random_orientation(RandomStream& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

Pair random_pair(RandomStream& random, SolidKind a, SolidKind b, double distance) {
  Pair pair{a, b, {}, {}};
  pair.a.position = random_direction(random);
  pair.a.orientation = random_orientation(random);
  pair.b.position = pair.a.position + distance * random_direction(random);
  pair.b.orientation = random_orientation(random);
  return pair;
}

Pair random_contact(RandomStream& random, SolidKind a, SolidKind b, double least_volume, double greatest_volume) {
  const double nearest = platonic(a).inradius() + platonic(b).inradius();
  const double farthest = platonic(a).circumradius() + platonic(b).circumradius();
  for (;;) {
    const double distance = nearest + (farthest - nearest) * random.uniform();
    Pair pair = random_pair(random, a, b, distance);
    const double volume = overlap(pair).volume;
    if (least_volume < volume && volume < greatest_volume) return pair;
  }
}

Overlap overlap(const Pair& pair) { return relative_overlap(pair.solid_a(), pair.solid_b(), pair.relative()); }

std::string describe(const Pair& pair) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << to_string(pair.kind_a) << " at (" << pair.a.position.transpose() << "), quaternion xyzw ("
       << pair.a.orientation.coeffs().transpose() << "); " << to_string(pair.kind_b) << " at ("
       << pair.b.position.transpose() << "), quaternion xyzw (" << pair.b.orientation.coeffs().transpose() << ")";
  return text.str();
}

}  // namespace isojam::testing_pairs
