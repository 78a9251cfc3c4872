#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/solids/named_solids.hpp"

namespace isojam {

namespace {

ConvexSolid make(SolidKind kind) { return ConvexSolid(std::string(to_string(kind)), *named_vertices(to_string(kind))); }

}  // namespace

const ConvexSolid& platonic(SolidKind kind) {
  static const std::array<ConvexSolid, 5> solids{make(all_solids[0]), make(all_solids[1]), make(all_solids[2]),
                                                 make(all_solids[3]), make(all_solids[4])};
  return solids[static_cast<std::size_t>(kind)];
}

}  // namespace isojam
