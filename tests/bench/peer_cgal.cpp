#include <CGAL/Convex_hull_3/dual/halfspace_intersection_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>

#include <vector>

#include "tests/bench/peers.hpp"

namespace isojam::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

void add_planes(const PlacedSolid& solid, const Eigen::Vector3d& centre, std::vector<Kernel::Plane_3>& planes) {
  for (int f = 0; f < solid.faces(); ++f) {
    const Eigen::Vector3d n = solid.normal(f);
    planes.emplace_back(n.x(), n.y(), n.z(), -(solid.offset()[f] + n.dot(centre)));
  }
}

double volume(const Polyhedron& body) {
  double six_volume = 0;
  const Kernel::Point_3 origin = body.points_begin() == body.points_end() ? CGAL::ORIGIN : *body.points_begin();
  for (auto facet = body.facets_begin(); facet != body.facets_end(); ++facet) {
    const auto first = facet->halfedge();
    const Kernel::Vector_3 a = first->vertex()->point() - origin;
    for (auto h = first->next(); h->next() != first; h = h->next()) {
      const Kernel::Vector_3 b = h->vertex()->point() - origin, c = h->next()->vertex()->point() - origin;
      six_volume += a * CGAL::cross_product(b, c);
    }
  }
  return six_volume / 6;
}

}  // namespace

double cgal_overlap(const PairSet& set, std::size_t k) {
  std::vector<Kernel::Plane_3> planes;
  add_planes(set.a(k), Eigen::Vector3d::Zero(), planes);
  add_planes(set.b(k), set.r(k), planes);
  Polyhedron body;
  CGAL::halfspace_intersection_3(planes.begin(), planes.end(), body);
  return volume(body);
}

}  // namespace isojam::bench
