#include "tests/bench/ratios.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/geometry/convex_solid.hpp"

namespace isojam::bench {

namespace {

using Kind = Claim::Kind;

void claim_overlaps(std::vector<Claim>& claims) {
  constexpr std::array<double, 5> faster_than_voro{9, 10, 13, 14, 13};  // in the order of all_solids
  constexpr double faster_than_cgal = 500, hessian_cost = 1.6, near_miss_ns = 12, in_a_packing = 1.15;
  for (std::size_t k = 0; k < all_solids.size(); ++k) {
    const std::string solid(platonic(all_solids[k]).name()), loop = "overlap/contact_loop/" + solid;
    claims.push_back({Kind::faster, loop, "overlap/voro++/" + solid, faster_than_voro[k]});
    claims.push_back({Kind::faster, loop, "overlap/cgal/" + solid, faster_than_cgal});
    claims.push_back({Kind::costs, "overlap/with_hessian/" + solid, loop, hessian_cost});
    claims.push_back({Kind::costs, "overlap/in_packings_N=64/" + solid, loop, 0});
    claims.push_back({Kind::costs, "overlap/in_packings_N=1000/" + solid, loop, 0});
    claims.push_back({Kind::costs, "overlap/in_packings_N=10000/" + solid, loop, in_a_packing});
    claims.push_back({Kind::faster, loop, "overlap/quadruple_clip/" + solid, 0});
    claims.push_back({Kind::absolute, "near_miss/cached_axis/" + solid, "", near_miss_ns});
  }
}

void claim_factors(std::vector<Claim>& claims) {
  for (const std::string n : {"N=100", "N=400"}) {
    claims.push_back({Kind::faster, "factorise/block_cholesky/" + n, "factorise/simplicial_ldlt/" + n, 5});
    claims.push_back({Kind::faster, "factor_solve/block_cholesky/" + n, "factor_solve/simplicial_ldlt/" + n, 0});
  }
  constexpr std::array<std::pair<const char*, double>, 3> faster_than_cholmod{{{"100", 3}, {"400", 1.5}, {"800", 1}}};
  for (const auto& [n, faster] : faster_than_cholmod) {
    const std::string size = std::string("/N=") + n;
    claims.push_back({Kind::faster, "factorise/block_cholesky" + size, "factorise/cholmod" + size, faster});
  }
  claims.push_back({Kind::faster, "factorise/block_cholesky/N=1000", "factorise/cholmod/N=1000", 0});
}

void claim_scaling(std::vector<Claim>& claims) {
  claims.push_back({Kind::costs, "evaluate/double_double/N=100", "evaluate/1_thread/N=100", 1.3});
  claims.push_back({Kind::faster, "evaluate/2_threads/N=400", "evaluate/1_thread/N=400", 1.7});
  claims.push_back({Kind::faster, "factorise/2_threads/N=400", "factorise/1_thread/N=400", 0});
  claims.push_back({Kind::faster, "factorise/2_threads/N=1000", "factorise/1_thread/N=1000", 1.6});
  claims.push_back({Kind::faster, "factorise/2_threads/N=4000", "factorise/1_thread/N=4000", 0});
  claims.push_back({Kind::faster, "sweep/2_threads/N=40", "sweep/1_thread/N=40", 1.9});
  // Costs must grow linearly with N: a particle must cost the same in a packing that is ten or a hundred times as
  // large. The factor 1.2 allows for caches that are too small.
  constexpr double linear = 1.2, particle_bytes = 5000;
  claims.push_back({Kind::absolute, "evaluate/1_thread/N=10000#bytes", "", particle_bytes, 10000});
  // In the first evaluation, the system must provide new memory, which takes time.
  claims.push_back({Kind::costs, "evaluate/afresh/N=10000", "evaluate/afresh/N=1000", 0, 10000, 1000});
  for (const double n : {1000.0, 10000.0}) {
    const std::string many = "/N=" + std::to_string(static_cast<int>(n)), few = "/N=100";
    claims.push_back({Kind::costs, "evaluate/1_thread" + many, "evaluate/1_thread" + few, linear, n, 100});
    claims.push_back(
        {Kind::costs, "evaluate/1_thread" + many + "#bytes", "evaluate/1_thread" + few + "#bytes", linear, n, 100});
  }
}

void claim_minimisers(std::vector<Claim>& claims) {
  const std::string far = "octahedron_.03";
  claims.push_back({Kind::faster, "minimise/newton/" + far, "minimise/conjugate_gradient/" + far, 100});
  claims.push_back({Kind::faster, "minimise/newton/" + far, "minimise/fire/" + far, 0});
  claims.push_back({Kind::faster, "minimise/newton/" + far, "minimise/lbfgs/" + far, 0});
  for (const std::string& name :
       {far, std::string("octahedron_.008"), std::string("tetrahedron_.033"), std::string("tetrahedron_.01")}) {
    claims.push_back({Kind::absolute, "minimise/newton/" + name + "#residual", "", 1e-6});
    claims.push_back({Kind::absolute, "minimise/newton_to_1e-9/" + name + "#residual", "", 1e-9});
    if (name == far) continue;
    // Print the final residuals of the other methods, which fail in these cases.
    for (const char* const method : {"conjugate_gradient", "fire", "lbfgs"})
      claims.push_back({Kind::faster, "minimise/newton/" + name + "#residual",
                        std::string("minimise/") + method + "/" + name + "#residual", 10});
  }
}

void claim_replicates(std::vector<Claim>& claims) {
  constexpr double second = 1e9;
  const std::vector<std::pair<std::string, double>> limits{{"tetrahedron_N=100", 15}, {"octahedron_N=100", 6},
                                                           {"dodecahedron_N=100", 5}, {"icosahedron_N=100", 5},
                                                           {"octahedron_N=400", 60},  {"dodecahedron_N=400", 60}};
  for (const auto& [name, seconds] : limits)
    claims.push_back({Kind::absolute, "replicate/jam/" + name, "", seconds * second});
  claims.push_back({Kind::absolute, "modes/both_ends/N=100", "", 0.05 * second});
  claims.push_back({Kind::absolute, "modes/both_ends/N=400", "", 0.5 * second});
}

}  // namespace

std::vector<Claim> all_claims() {
  std::vector<Claim> claims;
  claim_overlaps(claims);
  claim_factors(claims);
  claim_scaling(claims);
  claim_minimisers(claims);
  claim_replicates(claims);
  return claims;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::vector<Verdict> judge(const std::vector<Claim>& claims, const std::map<std::string, double>& medians) {
  std::vector<Verdict> verdicts;
  for (const Claim& claim : claims) {
    const bool absolute = claim.kind == Claim::Kind::absolute;
    const auto ours = medians.find(claim.ours), peer = medians.find(claim.peer);
    if (ours == medians.end() || (!absolute && peer == medians.end())) continue;
    Verdict verdict{claim, ours->second / claim.ours_per, absolute ? 0 : peer->second / claim.peer_per};
    if (absolute) {
      verdict.ratio = verdict.ours;
    } else {
      verdict.ratio = claim.kind == Claim::Kind::faster ? verdict.peer / verdict.ours : verdict.ours / verdict.peer;
    }
    verdict.holds = claim.bound == 0 ||
                    (claim.kind == Claim::Kind::faster ? verdict.ratio >= claim.bound : verdict.ratio <= claim.bound);
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

}  // namespace isojam::bench
