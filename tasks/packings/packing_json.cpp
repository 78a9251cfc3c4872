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

/// Sums of as many volumes as there can be are right to this.
constexpr double volume_rounding = 1e-9;

/// Coefficients are stored (w, x, y, z) and held (x, y, z, w).
Eigen::Vector4d stored(const Eigen::Vector4d& xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }
Eigen::Vector4d held(const Eigen::Vector4d& wxyz) { return {wxyz[1], wxyz[2], wxyz[3], wxyz[0]}; }

StoredSolid stored(const Solid& solid) {
  StoredSolid record{std::string(to_string(solid)), {}};
  if (!solid.is_defined()) return record;
  record.vertices.emplace(solid->given().begin(), solid->given().end());
  return record;
}

/// Cubes have a side; other cells have their three vectors.
void store_cell(StoredPacking& record, const PeriodicCell& cell) {
  const auto& vectors = cell.vectors();
  if (cell.is_cube()) {
    record.side = cell.side();
    if (vectors.low(0, 0) != 0) record.side_low = vectors.low(0, 0);
    return;
  }
  record.cell = {vectors.high.col(0), vectors.high.col(1), vectors.high.col(2)};
  record.cell_low = {vectors.low.col(0), vectors.low.col(1), vectors.low.col(2)};
}

DoubleDoubleMatrix read_vectors(const JsonPlace& place, const StoredPacking& record) {
  DoubleDoubleMatrix vectors;
  if (record.cell) {
    if (!record.cell_low) (void)place.at("cell_low");
    vectors.high << (*record.cell)[0], (*record.cell)[1], (*record.cell)[2];
    vectors.low << (*record.cell_low)[0], (*record.cell_low)[1], (*record.cell_low)[2];
    return vectors;
  }
  if (!record.side) (void)place.at("side");
  vectors.high *= *record.side;
  vectors.low.diagonal().setConstant(record.side_low.value_or(0));
  return vectors;
}

/// A cell in which no particle can touch two images of another.
PeriodicCell read_cell(const JsonPlace& place, const StoredPacking& record, const ConvexSolid& solid) {
  std::optional<PeriodicCell> cell;
  std::string why = "a particle could touch two images of another";
  try {
    cell.emplace(read_vectors(place, record));
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  if (!cell || !is_legal(*cell, solid)) {
    place.at(place.has("cell") ? "cell" : "side")
        .refuse(why, fmt::format("right-handed vectors whose translations are all longer than {}", least_side(solid)));
  }
  return *cell;
}

/// Particles that are alike have one solid. Others have kinds, each with its solid, and each particle has a kind and a
/// size.
void store_solids(StoredPacking& record, const Composition& solids) {
  if (solids.is_uniform()) {
    record.solid = stored(Solid::of(solids.only()));
    return;
  }
  record.kinds.emplace(static_cast<std::size_t>(solids.kinds()));
  record.kind.emplace();
  record.size.emplace();
  for (const auto& particle : solids.particles()) {
    auto& kind = record.kinds->at(static_cast<std::size_t>(particle.kind));
    if (!kind.solid) kind = stored(Solid::of(*particle.unit));
    record.kind->push_back(particle.kind);
    record.size->push_back(particle.scale);
  }
}

void expect_length(const JsonPlace& place, std::string_view key, std::size_t size) {
  place.at(key).expect_length(size, fmt::format("a list with an entry for each of {} particles", size));
}

/// Reads the solids of n particles.
Composition read_solids(const JsonPlace& place, const StoredPacking& record, std::size_t n) {
  if (!record.kinds) return *read_solid(place);
  std::vector<const ConvexSolid*> units(record.kinds->size());
  for (std::size_t k = 0; k < units.size(); ++k) units[k] = &*read_solid(place.at("kinds").at(k));
  for (const auto* key : {"kind", "size"}) expect_length(place, key, n);
  std::vector<Particle> particles;
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto which = place.at("kind").at(i).integer({0, static_cast<double>(units.size()) - 1});
    const double scale = (*record.size)[i];
    particles.push_back({units[static_cast<std::size_t>(which)], scale, static_cast<int>(which)});
    volume += scale * scale * scale;
  }
  if (const double mean = volume / static_cast<double>(n); !(std::abs(mean - 1) <= volume_rounding))
    place.at("size").refuse(fmt::format("the mean volume is {}", mean), "sizes whose cubes have mean 1");
  return Composition(particles);
}

void describe_solids(Fields& field, StoredPacking& packing) {
  constexpr Range sizes{0, 1e3, true};
  describe(field, packing.solid);
  field("kinds", packing.kinds,
        "Solids of a mixture, one for each kind of particle; absent if all particles are equal.");
  field("kind", packing.kind,
        "For each particle, the index of its kind in the list `kinds`, counted from 0; absent if all particles are "
        "equal.");
  field("size", packing.size,
        "Size of each particle: its length divided by the length of the same solid at unit volume; absent if all "
        "particles are equal.")
      .range(sizes);
}

void describe_cell(Fields& field, StoredPacking& packing) {
  constexpr Range lengths{-greatest_length, greatest_length};
  field("side", packing.side, "Side L of the cell if it is a cube; otherwise absent.")
      .range({0, greatest_length, true})
      .finite();
  field("side_low", packing.side_low,
        "Second double of the side; absent if it is 0. The exact side is `side` + `side_low`.")
      .range(lengths)
      .finite();
  field("cell", packing.cell, "Three lattice vectors of the cell if it is not a cube; otherwise absent.")
      .range(lengths);
  field("cell_low", packing.cell_low,
        "Second doubles of the lattice vectors. The exact lattice vectors are `cell` + `cell_low`.")
      .range(lengths);
}

}  // namespace

void describe(Fields& field, StoredSolid& solid) {
  field.rules = {{"required", {"solid"}}};
  field("solid", solid.solid, "Name of the solid; absent in a mixture, whose kinds have their solids.");
  field("vertices", solid.vertices,
        "Vertices of a user-defined solid, before the solid is scaled to unit volume; absent for a named solid.")
      .range({-greatest_length, greatest_length});
}

void describe(Fields& field, StoredPacking& packing) {
  constexpr Range lengths{-greatest_length, greatest_length}, components{-2, 2};
  const auto required = [](auto... keys) { return Json{{"required", {keys...}}}; };
  describe_solids(field, packing);
  field.rules = {{"oneOf", {required("side"), required("cell", "cell_low")}},
                 {"anyOf", {required("solid"), required("kinds", "kind", "size")}}};
  field("density", packing.density, "Density φ = N V_p/V_cell.").range(positive).finite();
  describe_cell(field, packing);
  field("positions", packing.positions, "Centres of the particles, not wrapped into the cell.")
      .range(lengths)
      .length(1, most_particles);
  field("orientations", packing.orientations,
        "Quaternion q = (w, x, y, z) of each particle. The rotation q/|q| takes the body frame to the lab frame.")
      .range(components);
  field("positions_low", packing.positions_low,
        "Second doubles of the particle centres. The exact centres are `positions` + `positions_low`.")
      .range(lengths);
  field("orientations_low", packing.orientations_low,
        "Second doubles of the quaternions. The exact quaternions are `orientations` + `orientations_low`.")
      .range(components);
}

StoredPacking stored(const Packing& packing) {
  StoredPacking record;
  store_solids(record, packing.solids);
  record.density = packing.density();
  store_cell(record, packing.cell);
  for (const auto& pose : packing.poses) {
    record.positions.push_back(pose.position);
    record.orientations.push_back(stored(pose.orientation.coeffs()));
    record.positions_low.push_back(pose.position_low);
    record.orientations_low.push_back(stored(pose.orientation_low));
  }
  return record;
}

Json to_json(const Packing& packing) { return written(stored(packing)); }

Packing read_packing(const JsonPlace& place) {
  StoredPacking record;
  Fields fields;
  describe(fields, record);
  fields.are_all = false;
  read_into(place, fields);
  const auto n = record.positions.size();
  const auto solids = read_solids(place, record, n);
  Packing packing{solids, read_cell(place, record, solids.widest()), {}};
  for (const auto* key : {"orientations", "positions_low", "orientations_low"}) expect_length(place, key, n);
  packing.poses.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Pose& pose = packing.poses[i];
    pose.position = record.positions[i];
    pose.position_low = record.positions_low[i];
    pose.orientation.coeffs() = held(record.orientations[i]);
    pose.orientation_low = held(record.orientations_low[i]);
    // |q| is 1 to rounding in all that is written; what is far from it is no orientation.
    if (!(pose.orientation.squaredNorm() > 0.5))
      place.at("orientations").at(i).refuse("not an orientation", "four numbers whose squares sum to 1");
  }
  return packing;
}

}  // namespace isojam
