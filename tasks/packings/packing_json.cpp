#include "tasks/packings/packing_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tasks/packings/solid_json.hpp"

namespace isojam {
namespace {

/// Far beyond any cell, and far from overflow.
constexpr double greatest_length = 1e9;

template <class Vector>
Json numbers(const Vector& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

/// Coefficients are stored (w, x, y, z) and held (x, y, z, w).
Json quaternion(const Eigen::Vector4d& xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

template <int size>
Eigen::Matrix<double, size, 1> read_vector(const JsonPlace& place, double greatest) {
  place.expect_length(size, fmt::format("a list of {} numbers", size));
  Eigen::Matrix<double, size, 1> v;
  for (std::size_t c = 0; c < size; ++c) v[static_cast<Eigen::Index>(c)] = place.at(c).number({-greatest, greatest});
  return v;
}

Eigen::Vector4d read_quaternion(const JsonPlace& place) {
  const auto wxyz = read_vector<4>(place, 2);
  return {wxyz[1], wxyz[2], wxyz[3], wxyz[0]};
}

/// Cubes have a side; other cells their three vectors, one after the other.
void put_cell(Json& json, const PeriodicCell& cell) {
  const auto& vectors = cell.vectors();
  if (cell.is_cube()) {
    json["side"] = cell.side();
    if (vectors.low(0, 0) != 0) json["side_low"] = vectors.low(0, 0);
    return;
  }
  for (int c = 0; c < 3; ++c) {
    json["cell"].push_back(numbers(Eigen::Vector3d(vectors.high.col(c))));
    json["cell_low"].push_back(numbers(Eigen::Vector3d(vectors.low.col(c))));
  }
}

DoubleDoubleMatrix read_vectors(const JsonPlace& place) {
  DoubleDoubleMatrix vectors;
  if (!place.has("cell")) {
    const double low = place.has("side_low") ? place.at("side_low").number({-greatest_length, greatest_length}) : 0;
    vectors.high *= place.at("side").number({0, greatest_length, true});
    vectors.low.diagonal().setConstant(low);
    return vectors;
  }
  const auto cell = place.at("cell"), cell_low = place.at("cell_low");
  for (const auto& list : {cell, cell_low}) list.expect_length(3, "three vectors");
  for (std::size_t c = 0; c < 3; ++c) {
    vectors.high.col(static_cast<Eigen::Index>(c)) = read_vector<3>(cell.at(c), greatest_length);
    vectors.low.col(static_cast<Eigen::Index>(c)) = read_vector<3>(cell_low.at(c), greatest_length);
  }
  return vectors;
}

/// A cell in which no particle can touch two images of another.
PeriodicCell read_cell(const JsonPlace& place, const ConvexSolid& solid) {
  std::optional<PeriodicCell> cell;
  std::string why = "a particle could touch two images of another";
  try {
    cell.emplace(read_vectors(place));
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  if (!cell || !is_legal(*cell, solid)) {
    place.at(place.has("cell") ? "cell" : "side")
        .refuse(why, fmt::format("right-handed vectors whose translations are all longer than {}", least_side(solid)));
  }
  return *cell;
}

JsonPlace list_of(const JsonPlace& place, const std::string& key, std::size_t size) {
  auto list = place.at(key);
  list.expect_length(size, fmt::format("a list with an entry for each of {} particles", size));
  return list;
}

}  // namespace

namespace {

/// Particles alike have one solid; others kinds, each with its solid, and which kind and in which size each particle
/// is.
void put_solids(Json& json, const Composition& solids) {
  if (solids.is_uniform()) return put_solid(json, Solid::of(solids.only()));
  std::vector<Json> kinds(static_cast<std::size_t>(solids.kinds()));
  for (const auto& particle : solids.particles()) {
    auto& kind = kinds[static_cast<std::size_t>(particle.kind)];
    if (kind.is_null()) put_solid(kind, Solid::of(*particle.unit));
  }
  json["kinds"] = std::move(kinds);
  json["kind"] = json["size"] = Json::array();
  for (const auto& particle : solids.particles()) {
    json["kind"].push_back(particle.kind);
    json["size"].push_back(particle.scale);
  }
}

/// Reads the solids of n particles.
Composition read_solids(const JsonPlace& place, std::size_t n) {
  if (!place.has("kinds")) return *read_solid(place);
  constexpr Range listed_sizes{0, 1e3, true};
  // Sums of as many volumes as there can be are right to this.
  constexpr double rounding = 1e-9;
  const auto list = place.at("kinds");
  std::vector<const ConvexSolid*> units(list.expect_list("a list of solids"));
  for (std::size_t k = 0; k < units.size(); ++k) units[k] = &*read_solid(list.at(k));
  const auto kind = list_of(place, "kind", n), size = list_of(place, "size", n);
  std::vector<Particle> particles;
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto which = kind.at(i).integer({0, static_cast<double>(units.size()) - 1});
    const double scale = size.at(i).number(listed_sizes);
    particles.push_back({units[static_cast<std::size_t>(which)], scale, static_cast<int>(which)});
    volume += scale * scale * scale;
  }
  if (!(std::abs(volume / static_cast<double>(n) - 1) <= rounding))
    size.refuse(fmt::format("the mean volume is {}", volume / static_cast<double>(n)), "sizes whose cubes have mean 1");
  return Composition(particles);
}

}  // namespace

Json to_json(const Packing& packing) {
  Json json;
  put_solids(json, packing.solids);
  json["density"] = packing.density();
  put_cell(json, packing.cell);
  for (const auto* key : {"positions", "orientations", "positions_low", "orientations_low"}) json[key] = Json::array();
  for (const auto& pose : packing.poses) {
    json["positions"].push_back(numbers(pose.position));
    json["orientations"].push_back(quaternion(pose.orientation.coeffs()));
    json["positions_low"].push_back(numbers(pose.position_low));
    json["orientations_low"].push_back(quaternion(pose.orientation_low));
  }
  return json;
}

Packing read_packing(const JsonPlace& place) {
  const auto n =
      place.at("positions").expect_entries(most_particles, fmt::format("a list of 1 to {} positions", most_particles));
  const auto solids = read_solids(place, n);
  Packing packing{solids, read_cell(place, solids.widest()), {}};
  const auto positions = list_of(place, "positions", n), positions_low = list_of(place, "positions_low", n);
  const auto orientations = list_of(place, "orientations", n);
  const auto orientations_low = list_of(place, "orientations_low", n);
  packing.poses.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Pose& pose = packing.poses[i];
    pose.position = read_vector<3>(positions.at(i), greatest_length);
    pose.position_low = read_vector<3>(positions_low.at(i), greatest_length);
    pose.orientation.coeffs() = read_quaternion(orientations.at(i));
    pose.orientation_low = read_quaternion(orientations_low.at(i));
    // |q| is 1 to rounding in all that is written; what is far from it is no orientation.
    if (!(pose.orientation.squaredNorm() > 0.5))
      orientations.at(i).refuse("not an orientation", "four numbers whose squares sum to 1");
  }
  return packing;
}

}  // namespace isojam
