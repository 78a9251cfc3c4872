#include "engine/packing/mixture/composition.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace isojam {

Composition::Composition(std::span<const Particle> particles) {
  assert(!particles.empty());
  const auto like_first = [&](const Particle& p) { return p == particles.front(); };
  if (particles.front().scale == 1 && std::all_of(particles.begin(), particles.end(), like_first)) {
    one_ = particles.front().unit;
    return;
  }
  auto mixed = std::make_shared<Mixed>();
  mixed->particles.assign(particles.begin(), particles.end());
  std::map<std::pair<const ConvexSolid*, double>, const ConvexSolid*> made;
  for (const Particle& particle : particles) {
    const ConvexSolid*& solid = made[{particle.unit, particle.scale}];
    if (solid == nullptr) {
      mixed->sized.push_back(std::make_unique<const ConvexSolid>(*particle.unit, particle.scale));
      solid = mixed->sized.back().get();
    }
    mixed->solids.push_back(solid);
  }
  measure(*mixed);
  mixed_ = std::move(mixed);
}

void Composition::measure(Mixed& mixed) {
  const ConvexSolid& first = *mixed.solids.front();
  mixed.widest = &first;
  mixed.least_inradius = first.inradius();
  for (std::size_t i = 0; i < mixed.solids.size(); ++i) {
    const ConvexSolid& solid = *mixed.solids[i];
    if (solid.diameter() > mixed.widest->diameter()) mixed.widest = &solid;
    mixed.kinds = std::max(mixed.kinds, mixed.particles[i].kind + 1);
    mixed.least_inradius = std::min(mixed.least_inradius, solid.inradius());
    mixed.greatest_circumradius = std::max(mixed.greatest_circumradius, solid.circumradius());
    mixed.mean_circumradius += solid.circumradius() / static_cast<double>(mixed.solids.size());
    mixed.greatest_lever_arm = std::max(mixed.greatest_lever_arm, solid.circumradius() / solid.gyration_radius());
  }
}

const ConvexSolid& Composition::only() const {
  assert(is_uniform());
  return *one_;
}

bool Composition::has_one_shape() const {
  if (is_uniform()) return true;
  const std::span<const Particle> all = particles();
  return std::all_of(all.begin(), all.end(), [&](const Particle& p) { return p.unit == all.front().unit; });
}

std::span<const ConvexSolid* const> Composition::solids() const {
  if (is_uniform()) return {};
  return mixed_->solids;
}

std::span<const Particle> Composition::particles() const {
  if (is_uniform()) return {};
  return mixed_->particles;
}

bool operator==(const Composition& a, const Composition& b) {
  if (a.one_ != b.one_) return false;
  return a.mixed_ == b.mixed_ || (a.mixed_ && b.mixed_ && a.mixed_->particles == b.mixed_->particles);
}

}  // namespace isojam
