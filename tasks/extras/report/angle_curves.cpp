#include "tasks/extras/report/angle_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/arithmetic/elementary.hpp"

namespace isojam {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int samples = 80, bins_per_decade = 60;
/// Smallest angle of the charts. Near it, the curves for random contacts are straight lines in logarithmic axes.
constexpr double least_sampled = 0.001 * degree;

/// Rounds a number to the digits that a chart can show, which saves disk space and time.
double shortened(double x) {
  if (x == 0) return 0;
  const double unit = nearest::pow(10, std::floor(nearest::log10(std::abs(x))) - 5);
  return std::round(x / unit) * unit;
}

/// Edges of the bins of a distribution of angles in degrees, from `angle_floor` to 100.
const std::vector<double>& edges_of_bins() {
  static const auto edges = [] {
    std::vector<double> list;
    for (int k = -6 * bins_per_decade; k <= 2 * bins_per_decade; ++k)
      list.push_back(nearest::pow(10, static_cast<double>(k) / bins_per_decade));
    return list;
  }();
  return edges;
}

Json sampled(const std::function<double(double)>& distribution, double largest) {
  Json curve = Json::array();
  const double ratio = nearest::log(largest / least_sampled);
  for (int k = 0; k <= samples; ++k) {
    const double theta = least_sampled * nearest::exp(ratio * k / samples);
    const double height = distribution(theta);
    if (height > 0) curve.push_back({shortened(theta / degree), shortened(height)});
  }
  return curve;
}

Json critical_record(const CriticalAngles& angles) {
  const auto entry = [](std::string_view topology, double angle) -> Json {
    return {{"topology", topology}, {"angle", angle / degree}};
  };
  Json json;
  json["edge_face"] = {entry("vertex-face", angles.ef_vertex_face), entry("edge-edge", angles.ef_edge_edge)};
  json["face_face"] = {entry("vertex-face", angles.ff_vertex_face), entry("edge-edge", angles.ff_edge_edge),
                       entry("edge-face", angles.ff_edge_face)};
  return json;
}

Json random_record(const ConvexSolid& solid) {
  const RandomAlignment random(solid);
  Json constrained, unconstrained;
  constrained["which"] = "random, edge in face";
  constrained["face_face"] =
      sampled([&](double theta) { return random.constrained_face_face(theta); }, random.constrained_ff_max());
  constrained["edge_face"] =
      sampled([&](double theta) { return random.constrained_edge_face(theta); }, random.ef_max());
  unconstrained["which"] = "random, unconstrained";
  unconstrained["face_face"] = sampled([&](double theta) { return random.face_face(theta); }, random.ff_max());
  unconstrained["edge_face"] = sampled([&](double theta) { return random.edge_face(theta); }, random.ef_max());
  return {constrained, unconstrained};
}

}  // namespace

Json angle_references(const Mixture& mixture) {
  Json json{{"critical", critical_record(critical_angles(mixture))}, {"random", Json::array()}};
  if (mixture.is_one_solid()) json["random"] = random_record(*mixture.solid());
  return json;
}

void ThinnedCdf::add(double angle) {
  const double theta = std::max(angle / degree, angle_floor);
  const auto& edges = edges_of_bins();
  bins_.resize(edges.size() + 1);
  auto& bin = bins_[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), theta) - edges.begin())];
  ++bin.angles;
  bin.largest = std::max(bin.largest, theta);
  if (size_++ == 0 || theta < least_) {
    least_ = theta;
    equal_to_least_ = 0;
  }
  equal_to_least_ += theta == least_;
}

Json ThinnedCdf::steps() const {
  Json steps = Json::array();
  const auto add_step = [&](double theta, std::size_t below) {
    steps.push_back({shortened(theta), shortened(static_cast<double>(below) / static_cast<double>(size_))});
  };
  if (size_ > 0) add_step(least_, equal_to_least_);
  std::size_t below = 0;
  for (const auto& bin : bins_) {
    below += bin.angles;
    if (bin.largest > least_) add_step(bin.largest, below);
  }
  return steps;
}

std::optional<PaperDensity> paper_density(const Mixture& solid, int particles) {
  struct Entry {
    SolidKind solid;
    int particles;
    PaperDensity density;
  };
  static constexpr std::array table{
      Entry{SolidKind::tetrahedron, 100, {.629, .001}},    Entry{SolidKind::tetrahedron, 400, {.634, .011}},
      Entry{SolidKind::octahedron, 100, {.6796, .0003}},   Entry{SolidKind::octahedron, 400, {.686, .001}},
      Entry{SolidKind::dodecahedron, 100, {.7065, .0002}}, Entry{SolidKind::dodecahedron, 400, {.7085, .0003}},
      Entry{SolidKind::icosahedron, 100, {.6953, .0003}},  Entry{SolidKind::icosahedron, 400, {.7008, .0003}},
  };
  const auto* found = std::find_if(table.begin(), table.end(), [&](const Entry& entry) {
    return solid == Mixture(entry.solid) && entry.particles == particles;
  });
  if (found == table.end()) return std::nullopt;
  return found->density;
}

}  // namespace isojam
