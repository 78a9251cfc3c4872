#include "engine/packing/cohesion_energy.hpp"

#include "engine/packing/strain_border.hpp"

namespace isojam {

const Composition& CohesionEnergy::grown_solids(const Packing& packing) {
  if (!grown_ || grown_from_ != packing.solids) {
    grown_ = Packing{grown(packing.solids, packing.size(), cohesion_.range / 2), packing.cell, {}};
    grown_from_ = packing.solids;
  }
  return grown_->solids;
}

void CohesionEnergy::update(const Packing& packing, Precision precision, PairCounts& counts) {
  grown_solids(packing);
  grown_->cell = packing.cell;
  grown_->poses = packing.poses;
  overlaps_.update(*grown_, precision, counts);
}

const PairTerms& CohesionEnergy::evaluate(const Packing& packing, Precision precision, PairCounts& counts) {
  overlaps_.forget();  // as in PackingEnergy::evaluate()
  update(packing, precision, counts);
  set_terms(packing, precision, overlaps_.pairs(), overlaps_.touching(), {0, -cohesion_.strength}, terms_);
  return terms_;
}

BlockMatrix CohesionEnergy::hessian(const Packing& packing, Precision precision, CellFreedom cell, PairCounts& counts) {
  update(packing, precision, counts);
  const double w = cohesion_.strength;
  BlockMatrix hessian;
  hessian.diagonal.assign(packing.poses.size(), Matrix6d::Zero());
  StrainBorder border(cell, packing.size(), hessian);
  std::vector<PairHessian> volume = overlaps_.volume_hessians(*grown_, packing.solids);
  auto next = volume.begin();
  for (const auto& block : overlaps_.touching().blocks) {
    for (const PairOverlap& at : block) {
      const NeighbourPair& pair = overlaps_.pairs()[at.pair];
      PairHessian& h = *next++;
      for (Matrix6d* part : {&h.aa, &h.ab, &h.bb}) *part *= -w;
      hessian.add_pair(pair.a, pair.b, h.aa, h.ab, h.bb);
      // ∂e/∂r = −∂e/∂x_A = w S_A
      border.add_pair(pair.a, pair.b, h, w * at.overlap.area, displacement(packing, pair));
    }
  }
  border.finish();
  return hessian;
}

}  // namespace isojam
