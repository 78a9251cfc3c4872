#include "engine/packing/cell/control.hpp"

#include <cassert>
#include <cmath>

#include "engine/packing/cell/strain.hpp"

namespace isojam {

StrainBasis strain_basis(CellFreedom cell) {
  StrainBasis basis;
  switch (cell) {
    case CellFreedom::fixed: basis.resize(6, 0); break;
    case CellFreedom::isotropic: basis = trace_direction(); break;
    case CellFreedom::shape: basis = traceless_basis(); break;
    case CellFreedom::free: basis = Matrix6d::Identity(); break;
  }
  return basis;
}

CellFreedom freedom_of(Eigen::Index strains) {
  assert(strains == 0 || strains == 1 || strains == 5 || strains == 6);
  if (strains == 0) return CellFreedom::fixed;
  if (strains == 1) return CellFreedom::isotropic;
  return strains == 5 ? CellFreedom::shape : CellFreedom::free;
}

double strain_length(int particles) { return std::sqrt(particles); }

}  // namespace isojam
