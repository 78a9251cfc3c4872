#include <vector>
#include <voro++/voro++.hh>

#include "tests/bench/peers.hpp"

namespace isojam::bench {

struct VoroCells::Cells {
  std::vector<voro::voronoicell_neighbor> of_particle;
  voro::voronoicell_neighbor cut;
  std::vector<int> neighbours;
  std::vector<double> areas;
};

namespace {

/// Removes the part with n·y > d. voro++ describes a plane by a point p with p·y = |p|²/2; p is at twice the distance
/// of the plane.
bool cut(voro::voronoicell_neighbor& cell, const Eigen::Vector3d& n, double d, int id) {
  return cell.nplane(n.x(), n.y(), n.z(), 2 * d, id);
}

}  // namespace

VoroCells::VoroCells(const PairSet& set) : set_(set), cells_(std::make_unique<Cells>()) {
  cells_->of_particle.resize(set.placed.size());
  for (std::size_t k = 0; k < set.placed.size(); ++k) {
    const PlacedSolid& solid = set.placed[k];
    const double box = 2 * solid.solid().circumradius();
    cells_->of_particle[k].init(-box, box, -box, box, -box, box);
    for (int f = 0; f < solid.faces(); ++f)
      cut(cells_->of_particle[k], solid.normal(f), solid.offset()[f], SolidArrays::max_faces + f);
  }
}

VoroCells::~VoroCells() = default;

double VoroCells::overlap(std::size_t k) {
  const PlacedSolid a = set_.a(k), b = set_.b(k);
  const Eigen::Vector3d& r = set_.r(k);
  cells_->cut = cells_->of_particle[static_cast<std::size_t>(set_.pairs[k].a)];
  for (int f = 0; f < b.faces(); ++f) {
    const Eigen::Vector3d n = b.normal(f);
    if (!cut(cells_->cut, n, b.offset()[f] + n.dot(r), f)) return 0;
  }
  double x = 0, y = 0, z = 0;
  cells_->cut.centroid(x, y, z);
  cells_->cut.neighbors(cells_->neighbours);
  cells_->cut.face_areas(cells_->areas);
  area_.setZero();
  for (std::size_t f = 0; f < cells_->areas.size(); ++f) {
    const int of_a = cells_->neighbours[f] - SolidArrays::max_faces;
    if (of_a >= 0) area_ += cells_->areas[f] * a.normal(of_a);
  }
  return cells_->cut.volume();
}

}  // namespace isojam::bench
