#include "tasks/measure/measure.hpp"
#include "tasks/records/summary.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <iostream>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/measure/recorded_measurement.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tests/tasks/support/packings.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::violations;

/// An outcome of `jam` with these measures.
Outcome measured_outcome(const JamResult& jam, std::span<const Measure> measures = all_measures) {
  Outcome outcome;
  outcome.spec = test::make_plan(parse_manifest(test::tiny_manifest().dump(), "tiny")).front();
  outcome.jam = jam;
  MeasureOptions options;
  options.shear.until = 0.04;  // so that the packing yields
  for (const auto what : measures) outcome.measured[what] = measure(what, jam, options);
  return outcome;
}

const JamResult& jammed() {
  static const JamResult result = test::jammed_octahedra(MinimiseOptions{}.residual);
  return result;
}

/// Paths of null values that have no reason.
std::string unexplained(const Json& json, const std::string& path = "") {
  std::string list;
  if (json.is_array()) {
    for (std::size_t k = 0; k < json.size(); ++k) list += unexplained(json[k], path + "/" + std::to_string(k));
  } else if (json.is_object()) {
    for (const auto& item : json.items()) {
      const auto here = path + "/" + item.key();
      if (item.value().is_null() && !json.contains(item.key() + "_reason")) list += here + " ";
      list += unexplained(item.value(), here);
    }
  }
  return list;
}

/// Checks that the part of each measure is found in a record with all measures.
void expect_recorded(const Json& record, const Outcome& outcome) {
  for (const auto& [what, measured] : outcome.measured) {
    const auto found = recorded_measurement(what, record);
    EXPECT_EQ(Json(found.states).dump(), Json(measured.states).dump()) << to_string(what);
    if (outcome.failure) continue;
    EXPECT_EQ(found.replicate.dump(), measured.replicate.dump()) << to_string(what);
    EXPECT_EQ(found.flags, measured.flags) << to_string(what);
  }
}

/// The parts of the record of each measure, with their fields.
std::vector<std::pair<MeasurePart, Json>> parts_of(const Outcome& outcome) {
  std::vector<std::pair<MeasurePart, Json>> parts;
  for (const auto& [what, measured] : outcome.measured) {
    const auto& definition = definition_of(what);
    for (const auto& state : measured.states) parts.emplace_back(definition.state, state);
    parts.emplace_back(definition.replicate, measured.replicate);
  }
  return parts;
}

std::string error_of(const MeasurePart& part, const Json& json) {
  try {
    if (part.check) part.check({json, "record"});
    return part.check || json.empty() ? "" : "nothing is described";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Measure, DescribesWhatItWritesAndNothingElse) {
  const auto parts = parts_of(measured_outcome(jammed()));
  for (const auto& [part, json] : parts) EXPECT_EQ(error_of(part, json), "") << json;
  RandomStream random{5};
  const auto any = [&](std::size_t size) {
    return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(size)), size - 1);
  };
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    auto [part, json] = parts[any(parts.size())];
    std::vector<Json*> places;
    for (auto& value : json) places.push_back(&value);
    if (places.empty()) continue;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (auto& value : *places[i])
        if (places[i]->is_structured()) places.push_back(&value);
    Json& place = *places[any(places.size())];
    if (!place.is_object()) place = Json::object();
    place["new"] = 1;
    EXPECT_NE(error_of(part, json), "") << json;
    ++refused;
  }
  std::cout << parts.size() << " parts accepted, " << refused << " changed ones refused\n";
  EXPECT_GT(refused, 200);
}

TEST(Measure, FillsTheRecordOfAJammedPacking) {
  ASSERT_EQ(jammed().status, JamStatus::jammed);
  const auto outcome = measured_outcome(jammed());
  const auto record = test::record_on_disk(outcome);
  expect_recorded(record, outcome);
  EXPECT_EQ(violations("record", record), "");
  EXPECT_EQ(unexplained(record), "");
  const auto summary = summarise_record(record, "record");
  ASSERT_EQ(summary.states.size(), jammed().states.size());
  for (std::size_t i = 0; i < all_quantities().size(); ++i) {
    const auto& quantity = all_quantities()[i];
    // This packing is not a mixture, and has no cohesion.
    if (quantity.group.name == "kinds of a mixture" || quantity.cohesive) continue;
    const auto& place = quantity.of == Quantity::Of::state ? test::nearest_of(record) : record;
    const Json::json_pointer pointer{std::string(quantity.pointer)};
    ASSERT_TRUE(place.contains(pointer)) << quantity.name;
    EXPECT_EQ(summary.values[i].has_value(), !place.at(pointer).is_null()) << quantity.name;
  }
  const Json &sheared = record.at("shear"), &path = sheared.at("path");
  std::size_t drop = 0;
  while (drop < path.size() && path[drop].at("dropped") == false) ++drop;
  std::cout << "the packing yields in step " << drop << " of " << path.size() << "\n";
  ASSERT_LT(drop, path.size());
  EXPECT_EQ(sheared.at("yield_strain"), path[drop - 1].at("strain"));
}

/// Checks the numbers in the record for the rows of `matrix`, from contacts with so many constraints.
void expect_counted(const Json& counted, const RigidityMatrix& matrix, int constraints, double per_particle) {
  const auto coordinates = static_cast<int>(matrix.rows.cols());
  const Eigen::VectorXd sigma = singular_values_of(Eigen::MatrixXd(matrix.rows));
  const auto rank = static_cast<int>((sigma.array() > counted.at("tolerance").get<double>()).count());
  EXPECT_EQ(counted.at("constraints"), constraints);
  EXPECT_EQ(std::lround(per_particle * coordinates / 12), constraints);
  EXPECT_EQ(counted.at("rank"), rank);
  EXPECT_EQ(counted.at("self_stress"), constraints - rank);
  EXPECT_EQ(counted.at("floppy"), coordinates - rank);
}

TEST(Measure, CountsConstraintsByContactsAndSingularValues) {
  const auto record = test::record_on_disk(measured_outcome(jammed()));
  int decided = 0;
  for (std::size_t k = 0; k < jammed().states.size(); ++k) {
    SCOPED_TRACE("state " + std::to_string(k));
    const Packing& packing = jammed().states[k];
    const auto& state = record.at("states").at(k);
    const auto& numbers = state.at("contacts");
    PackingEnergy energy;
    const auto contacts = energy.contacts(packing);
    expect_counted(state.at("rigidity").at("normals"), normal_constraints(packing, contacts),
                   static_cast<int>(contacts.size()), numbers.at("Z"));
    if (numbers.at("C").is_null()) continue;
    ++decided;
    const auto angles = alignments(packing.solids.only(), contacts);
    const auto face_face_below = numbers.at("face_face_fit").at("cutoff").get<double>();
    const auto edge_face_below = numbers.at("edge_face_fit").at("cutoff").get<double>();
    int constraints = 0;
    for (const auto& angle : angles)
      constraints += angle.face_face < face_face_below ? 3 : angle.edge_face < edge_face_below ? 2 : 1;
    const auto classes = classify(angles, face_face_below, edge_face_below);
    expect_counted(state.at("rigidity").at("classes"), class_constraints(packing, contacts, angles, classes),
                   constraints, numbers.at("C"));
  }
  EXPECT_GT(decided, 0) << "no state has classes";
}

/// A record of the jammed packing with the measures that classify its contacts.
const Json& record_of_classes() {
  static const Json record =
      test::record_on_disk(measured_outcome(jammed(), std::array{Measure::contacts, Measure::rigidity}));
  return record;
}

/// Difference between C and 12 − 6/N − 2m + 2S/N for the counted rows of a rigidity matrix.
double violation_of_identity(const Json& counted, double C, int particles) {
  const double n = particles;
  const double missing = (counted.at("floppy").get<double>() - 3) / n;
  const double redundant = counted.at("self_stress").get<double>() / n;
  return C - (12 - 6 / n - 2 * missing + 2 * redundant);
}

TEST(Measure, ConstraintNumberIsThatOfMissingAndRedundantConstraints) {
  const Json& record = record_of_classes();
  int by_fit = 0;
  for (std::size_t k = 0; k < jammed().states.size(); ++k) {
    const auto& state = record.at("states").at(k);
    const auto &contacts = state.at("contacts"), &rigidity = state.at("rigidity");
    const int particles = jammed().states[k].size();
    for (const auto& [C, counted] : {std::pair{contacts.at("C"), rigidity.at("classes")},
                                     std::pair{contacts.at("trough").at("C"), rigidity.at("trough")}}) {
      EXPECT_EQ(C.is_null(), counted.at("rank").is_null());
      if (C.is_null()) continue;
      EXPECT_NEAR(violation_of_identity(counted, C.get<double>(), particles), 0, 1e-12);
    }
    by_fit += !contacts.at("C").is_null();
  }
  EXPECT_GT(by_fit, 0);
}

TEST(Measure, RecordsTheHistogramOfAnglesAndItsTroughs) {
  const Json& record = record_of_classes();
  const auto critical = critical_angles(platonic(SolidKind::octahedron));
  for (std::size_t k = 0; k < jammed().states.size(); ++k) {
    SCOPED_TRACE("state " + std::to_string(k));
    const Packing& packing = jammed().states[k];
    const auto& contacts = record.at("states").at(k).at("contacts");
    const auto angles = alignments(packing.solids.only(), PackingEnergy().contacts(packing));
    const auto expected = angle_histogram(angles, critical.ff_min() / 2, critical.ef_min() / 2);
    const auto histogram = read_angle_histogram({contacts.at("angle_bins"), "record"});
    EXPECT_EQ(histogram.face_face, expected.face_face);
    EXPECT_EQ(histogram.edge_face_of_others(0), expected.edge_face_of_others(0));
    EXPECT_EQ(histogram.face_face_window, expected.face_face_window);
    EXPECT_EQ(histogram.edge_face_window, expected.edge_face_window);
    EXPECT_EQ(histogram.edge_face_of_others(histogram.face_face_window),
              expected.edge_face_of_others(expected.face_face_window));
    const auto& trough = contacts.at("trough");
    if (trough.at("C").is_null()) continue;
    const auto C_with = [&](const char* key) {
      const double ff = trough.at("face_face").at(key).get<double>(), ef = trough.at("edge_face").at(key).get<double>();
      return contact_numbers(packing.size(), classify(angles, ff, ef)).C;
    };
    EXPECT_DOUBLE_EQ(trough.at("C").get<double>(), C_with("cutoff"));
    EXPECT_DOUBLE_EQ(trough.at("C_low").get<double>(), C_with("low"));
    EXPECT_DOUBLE_EQ(trough.at("C_high").get<double>(), C_with("high"));
  }
}

/// `n` solids in a row along x, `spacing` apart, in a cell of side `side`.
Packing row(SolidKind kind, int n, double spacing, double side) {
  Packing packing{platonic(kind), PeriodicCell(side), std::vector<Pose>(static_cast<std::size_t>(n))};
  for (int k = 0; k < n; ++k)
    packing.poses[static_cast<std::size_t>(k)].position = Eigen::Vector3d(1 + spacing * k, side / 2, side / 2);
  return packing;
}

/// Cubes of unit volume on a cubic lattice with spacing .999. Each overlaps 6 others at faces, 12 at edges and 8 at
/// corners.
Packing crystal_of_cubes() {
  constexpr int cells = 4;
  constexpr double spacing = 0.999;
  Packing packing{platonic(SolidKind::cube), PeriodicCell(cells * spacing), {}};
  for (int k = 0; k < cells * cells * cells; ++k) {
    packing.poses.emplace_back();
    const int x = k % cells, y = k / cells % cells, z = k / (cells * cells);
    packing.poses.back().position = spacing * Eigen::Vector3d(x, y, z) + Eigen::Vector3d::Constant(0.3);
  }
  return packing;
}

TEST(Measure, DegenerateStatesHaveValuesOrReasons) {
  const std::vector<std::pair<std::string, Packing>> cases{
      {"one particle", row(SolidKind::octahedron, 1, 0, 8)},
      {"two apart", row(SolidKind::octahedron, 2, 4, 8)},
      {"one contact", row(SolidKind::cube, 2, 0.99, 8)},
      {"three, two contacts", row(SolidKind::dodecahedron, 3, 1.9 * platonic(SolidKind::dodecahedron).inradius(), 8)},
      {"crystal of cubes", crystal_of_cubes()}};
  // For the crystal, the modes by differences take longer than all other measures together.
  std::vector<Measure> fast(all_measures.begin(), all_measures.end());
  std::erase(fast, Measure::difference_modes);
  for (const auto& [name, packing] : cases) {
    const bool is_crystal = name == cases.back().first;
    auto outcome = is_crystal ? measured_outcome(test::single_state(packing), fast)
                              : measured_outcome(test::single_state(packing));
    outcome.failure = Failure{"jam", "made up"};
    const auto record = test::record_on_disk(outcome);
    SCOPED_TRACE(name);
    for (const auto& [part, json] : parts_of(outcome)) EXPECT_EQ(error_of(part, json), "");
    expect_recorded(record, outcome);
    EXPECT_EQ(violations("record", record), "") << name;
    EXPECT_EQ(unexplained(record), "") << name;
    const auto& state = record.at("states").at(0);
    const auto text = state.dump();
    EXPECT_EQ(text.find("nan"), std::string::npos) << name;
    EXPECT_EQ(text.find("inf,"), std::string::npos) << name;
    if (!is_crystal) continue;
    EXPECT_EQ(state.at("contacts").at("Z"), 26) << name;
    EXPECT_GT(state.at("order").at("S").get<double>(), 0.999) << name;
  }
}

}  // namespace
}  // namespace isojam
