#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "engine/analysis/alignment/empirical_cdf.hpp"
#include "engine/analysis/gaps.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tasks/extras/page/page.hpp"
#include "tasks/extras/report/angle_curves.hpp"
#include "tasks/extras/report/distributions.hpp"
#include "tasks/extras/report/gather.hpp"
#include "tasks/io/file.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/summary.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/packings.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

std::vector<ReplicateSpec> plan(int replicates = 4) {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"octahedron", "tetrahedron"};
  manifest["sweep"]["particles"] = {100, 200};
  manifest["replicates"] = replicates;
  const Plan all(parse_manifest(manifest.dump(), "m"));
  std::vector<ReplicateSpec> specs;
  for (std::size_t k = 0; k < all.size(); ++k) specs.push_back(all[k]);
  return specs;
}

RecordedReplicate recorded(const Outcome& outcome) {
  auto record = make_record(outcome);
  auto document = read_record_document(record, "made up");
  auto summary = summarise_record(document, record, "made up");
  return {replicate_name(outcome.spec), std::move(record), std::move(document), std::move(summary)};
}

/// A manifest and records.
struct Results {  // NOLINT(bugprone-exception-escape): to move Json throws nothing
  Json manifest;
  std::vector<RecordedReplicate> replicates;
};

/// The text of the data that a report shows.
std::string text_of(const Results& results) {
  ReportData data(results.manifest);
  for (const auto& replicate : results.replicates) data.add(replicate, replicate.name);
  return data.text({}, Json::object());
}
/// The same replicates for choose_views().
std::vector<Viewable> viewable(const Results& results) {
  ReportData data(results.manifest);
  for (const auto& replicate : results.replicates) data.add(replicate, replicate.name);
  return {data.viewable().begin(), data.viewable().end()};
}

Json report_data(const Results& results) { return Json::parse(text_of(results)); }

/// Made-up results. `change` can change every outcome before it is recorded.
Results results_of(const std::vector<ReplicateSpec>& specs, const std::function<void(Outcome&)>& change = {}) {
  Results results;
  results.manifest = {{"name", "made up"}, {"seed", 7}};
  for (const auto& spec : specs) {
    auto outcome = test::made_up_outcome(spec);
    if (change) change(outcome);
    results.replicates.push_back(recorded(outcome));
  }
  return results;
}

void fail(Outcome& outcome) { outcome.failure = Failure{"jam", "made up"}; }
void flag(Outcome& outcome) { outcome.jam.status = JamStatus::goal_not_reached; }

std::string embedded_text(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

Packing dense_packing() {
  RandomStream random{1, 2, 3, 4};
  return random_packing(platonic(SolidKind::octahedron), 40, 0.6, random);
}

TEST(ReportPage, DataAreReadAsWritten) {
  const std::string hostile = "</script><script>alert(1)</script><!-- <b>\" \\ @data@ @scripts@ & \u2028";
  auto results = results_of(plan(2));
  results.manifest["name"] = hostile;
  results.replicates[0].record["flags"] = {hostile};
  results.replicates[1].record["provenance"]["compiler"] = hostile;
  const auto page = assembled_page(report_parts(), text_of(results));
  const auto data = Json::parse(embedded_text(page));
  EXPECT_EQ(data, report_data(results));
  EXPECT_EQ(data["manifest"]["name"], hostile);
  EXPECT_EQ(data["replicates"][0]["flags"][0], hostile);
  EXPECT_EQ(embedded_text(page).find('<'), std::string::npos);
  EXPECT_EQ(page.find("alert(1)", page.find("</script>", page.find("id=\"data\""))), std::string::npos);
  for (const auto* place : {"@style@", "@modules@", "@notices@"})
    EXPECT_EQ(page.find(place), std::string::npos) << place;
}

TEST(ReportData, SurvivesAnyManifest) {
  auto results = results_of(plan(1));
  for (const auto* text :
       {"null", "[]", "[1]", "\"name\"", "7", "{}", R"({"name": null})", R"({"name": {"a": [1]}})"}) {
    results.manifest = Json::parse(text);
    const auto data = report_data(results);
    EXPECT_TRUE(data["manifest"]["name"].is_null() || data["manifest"]["name"] == R"({"a":[1]})") << text;
    EXPECT_EQ(data["rows"].size(), 4U) << text;
  }
}

TEST(ReportPage, KeepsTheNoticesOfItsLibraries) {
  const auto page = assembled_page(report_parts(), text_of(results_of(plan(1))));
  for (const auto* text : {"University of Washington Interactive Data Lab", "three.js authors", "Mike Bostock"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST(ReportData, ExtrapolatesFromPhiJThroughItsStates) {
  const auto results = results_of(plan(3));
  const auto data = report_data(results);
  for (const auto& replicate : data["replicates"]) {
    const auto from = replicate["line"]["from"].get<std::vector<double>>();
    const auto to = replicate["line"]["to"].get<std::vector<double>>();
    EXPECT_EQ(from[0], replicate["phi_j"].get<double>());
    EXPECT_EQ(from[1], 0);
    // The made-up energies are exactly Δφ⁶, so the root is φ − φ_J.
    EXPECT_NEAR(to[1], 0.04, 0.04 * 1e-12) << replicate["name"];
    EXPECT_NEAR(to[0] - from[0], to[1], to[1] * 1e-10) << replicate["name"];
  }
}

TEST(ReportData, MeansAndPoolsOmitExcludedReplicates) {
  auto results = results_of(plan(3), [](Outcome& o) {
    if (o.spec.replicate == 1) o.measured.at(Measure::contacts).flags = {"crystalline"};
    if (o.spec.replicate == 2) flag(o);
  });
  const auto expect = [&](const Json& exclude, const std::vector<bool>& excluded) {
    const auto data = report_data(results);
    EXPECT_EQ(data.value("exclude", Json()), exclude);
    const auto n = 3 - std::count(excluded.begin(), excluded.end(), true);
    EXPECT_EQ(data["rows"][0]["phi_j"]["n"], n);
    EXPECT_EQ(data["rows"][0].contains("all"), n < 3);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(data["replicates"][k].value("excluded", Json()), excluded[k]) << k;
  };
  expect({"crystalline", "not_balanced"}, {false, true, false});
  results.manifest["exclude"] = {"goal_not_reached"};
  expect(Json{"goal_not_reached"}, {false, false, true});
  results.manifest["exclude"] = {"goal_not_reached", "crystalline", 7, "unheard of"};
  expect({"goal_not_reached", "crystalline"}, {false, true, true});
  results.manifest["exclude"] = Json::array();
  expect(Json::array(), {false, false, false});
}

/// The record of a replicate with so many angles of both kinds and a cut-off, all in radians.
void put_angles(Json& record, double angle, double cutoff) {
  auto& contacts = record["states"][record["nearest"].get<std::size_t>()]["contacts"];
  for (const std::string kind : {"face_face", "edge_face"}) {
    contacts["angles"][kind] = {angle, 2 * angle};
    contacts[kind + "_fit"]["cutoff"] = cutoff;
  }
}

TEST(ReportCurves, AnglesAreInDegrees) {
  auto results = results_of(plan(1));
  for (auto& replicate : results.replicates) put_angles(replicate.record, 0.1, 0.5);
  const auto angles = report_data(results)["rows"][0]["angles"]["face_face"];
  EXPECT_NEAR(angles["cutoff"].get<double>(), 0.5 * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(angles["cdf"].back()[0].get<double>(), 0.2 * 180 / std::numbers::pi, 1e-4);
}

TEST(ReportCurves, DensitiesOfForcesHaveTheNormOne) {
  const Json state = measure(Measure::gaps, test::single_state(dense_packing())).states.at(0);
  Distributions distributions;
  for (int k = 0; k < 2; ++k) distributions.add(state, std::nullopt);
  const Json curves = distributions.json().at("forces").at("curves");
  const double half = 0.5 / Histogram::per_decade;
  for (const auto& names : {std::vector{"all"}, {"face_face", "edge_face", "lower_order"}}) {
    double norm = 0;
    for (const auto* name : names) {
      for (const auto& point : curves.at(name)) {
        const double middle = point[0].get<double>();
        norm += point[1].get<double>() * middle * (std::pow(10, half) - std::pow(10, -half));
      }
    }
    EXPECT_NEAR(norm, 1, 1e-3) << names.front();
  }
}

TEST(ReportCurves, ThinnedCdfsAreExactWhereTheyHaveAPoint) {
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> decades(-9, 0);
  std::vector<double> angles;
  for (int k = 0; k < 3000; ++k) angles.push_back(std::pow(10, decades(bits)));
  const auto exact = empirical_cdf(angles);
  ThinnedCdf cdf;
  for (const double angle : angles) cdf.add(angle);
  const auto thinned = cdf.steps();
  EXPECT_LT(thinned.size(), 700U);
  EXPECT_GT(thinned.size(), 300U);
  double before = 0;
  for (const auto& point : thinned) {
    const double theta = point[0].get<double>() * std::numbers::pi / 180, c = point[1].get<double>();
    // Six digits of the angle and of c are kept.
    const double slack = 1e-5;
    EXPECT_LE(exact(theta * (1 - slack)) * (1 - slack), c) << point;
    EXPECT_GE(exact(theta * (1 + slack)) * (1 + slack), c) << point;
    EXPECT_GT(c, before);
    before = c;
  }
  EXPECT_EQ(before, 1);
}

TEST(ReportViews, OneOfEveryPointThenMoreIfThereIsRoom) {
  const auto results = results_of(plan(4), [](Outcome& o) {
    if (o.spec.replicate == 0) flag(o);
    if (o.spec.replicate == 1) fail(o);
  });
  const auto name_of = [&](const ChosenView& view) { return results.replicates[view.replicate].name; };
  std::set<std::string> names;
  const auto few = choose_views(viewable(results), {.budget = 0, .most_particles = 0});
  for (const auto& view : few) {
    names.insert(name_of(view));
    EXPECT_FALSE(view.with_modes);
  }
  EXPECT_EQ(names, (std::set<std::string>{"octahedron-N100-r0002", "octahedron-N200-r0002", "tetrahedron-N100-r0002",
                                          "tetrahedron-N200-r0002"}));
  for (const int most : {100, 650, 900, 1050, 100000}) {
    int with_modes = 0, all = 0;
    const auto chosen = choose_views(viewable(results), {.budget = most / 2, .most_particles = most});
    for (const auto& view : chosen) {
      const auto& summary = results.replicates[view.replicate].summary;
      EXPECT_FALSE(summary.failed) << name_of(view);
      if (view.with_modes) with_modes += summary.particles;
      all += summary.particles;
    }
    EXPECT_LE(with_modes, most / 2);
    EXPECT_LE(all, std::max(most, 600)) << "one of every point, 600 particles, and what there is room for";
    EXPECT_EQ(chosen.size(), most < 700 ? 4U : most < 1000 ? 6U : most < 1100 ? 7U : 12U) << most;
  }
}

TEST(ReportViews, ShowThePackingItself) {
  const auto packing = dense_packing();
  const auto view = packing_view(packing, 3), with_gaps = packing_view(packing, 0, .1);
  PackingEnergy energy;
  std::size_t sum = 0, more = 0;
  for (const auto& number : view["contacts"]) sum += number.get<std::size_t>();
  for (const auto& number : with_gaps["contacts"]) more += number.get<std::size_t>();
  EXPECT_EQ(sum, 2 * energy.contacts(packing).size());
  EXPECT_EQ(more - sum, 2 * near_gaps(packing, .1).size());
  EXPECT_GT(more, sum);
  EXPECT_EQ(with_gaps["forces"], view["forces"]) << "pairs with a gap have no force";
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double shown = view["positions"][i][static_cast<std::size_t>(c)].get<double>();
      const double cells = (packing.poses[i].position[c] - shown) / packing.cell.side();
      EXPECT_GE(shown, 0);
      EXPECT_LE(shown, packing.cell.side() * (1 + 1e-5));
      EXPECT_NEAR(cells, std::round(cells), 1e-5);
    }
  }
}

TEST(ReportViews, ForcesAreThoseOfTheContactsAndEndWhereTheyAct) {
  const auto packing = dense_packing();
  const auto view = packing_view(packing, 0);
  const auto contacts = PackingEnergy().contacts(packing);
  const auto forces = view["forces"].get<std::vector<int>>();
  ASSERT_EQ(forces.size(), 6 * contacts.size());
  const double largest = view["largest_force"].get<double>(), rounding = 0.005 * std::sqrt(3.);
  int most = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& [pair, displacement, pose, overlap] = contacts[k];
    const auto* shown = &forces[6 * k];
    ASSERT_EQ(std::pair(shown[0], shown[1]), std::pair(pair.a, pair.b)) << k;
    EXPECT_NEAR(shown[2], 1000 * overlap.volume / 2 * overlap.area.norm() / largest, 0.5 + 1e-9) << k;
    most = std::max(most, shown[2]);
    const auto& turn = packing.poses[static_cast<std::size_t>(pair.a)].orientation;
    const Eigen::Vector3d place = turn.conjugate() * Eigen::Vector3d(shown[3] / 100., shown[4] / 100., shown[5] / 100.);
    // A force has no torque about its own line.
    const Eigen::Vector3d along = overlap.area.normalized(),
                          torque = overlap.moment - along * along.dot(overlap.moment);
    EXPECT_LE((place.cross(overlap.area) - torque).norm(), 1.01 * rounding * overlap.area.norm()) << k;
    const Eigen::Vector3d seen_from_b = pose.rotation.transpose() * (place - pose.displacement);
    for (const auto& face : packing.solids.unit(0).faces()) {
      EXPECT_LE(face.normal.dot(place), face.offset + rounding) << k << ": outside of a";
      EXPECT_LE(face.normal.dot(seen_from_b), face.offset + rounding) << k << ": outside of b";
    }
  }
  EXPECT_EQ(most, 1000);
}

TEST(ReportViews, ModesAreThoseOfTheHessian) {
  const auto packing = dense_packing();
  const auto view = packing_view(packing, 3);
  PackingEnergy energy;
  const auto all = dense_modes(energy.hessian(packing, Precision::double_double)).eigenvalues;
  ASSERT_EQ(view["modes"].size(), 6U);
  const auto& stiffest = view["modes"].back();
  EXPECT_EQ(stiffest["end"], "highest");
  EXPECT_NEAR(stiffest["omega"].get<double>(), std::sqrt(all[all.size() - 1]), 1e-6 * std::sqrt(all[all.size() - 1]));
  for (const auto& mode : view["modes"]) {
    double greatest = 0;
    for (const auto& u : mode["u"]) greatest = std::max(greatest, std::abs(u.get<double>()));
    EXPECT_EQ(greatest, 1);
    EXPECT_EQ(mode["u"].size(), 6 * packing.poses.size());
  }
}

TEST(ReportViews, ClustersStayConnectedInSpace) {
  // A row of cubes through the boundary, and one separate cube.
  Packing packing{platonic(SolidKind::cube), PeriodicCell(6), {}};
  for (const double x : {4.6, 5.58, 0.56, 1.54}) packing.poses.push_back({.position = {x, 3, 3}});
  packing.poses.push_back({.position = {3, 0.5, 0.5}});
  PackingEnergy energy;
  std::vector<NeighbourPair> bonds;
  for (const auto& contact : energy.contacts(packing)) bonds.push_back(contact.pair);
  ASSERT_EQ(bonds.size(), 3U);
  const auto shown = unwrapped_cluster(packing, find_clusters(packing, bonds).front());
  EXPECT_EQ(shown["members"], Json({0, 1, 2, 3}));
  const auto at = [&](std::size_t k, std::size_t c) { return shown["positions"][k][c].get<double>(); };
  double mean = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    mean += at(k, 0) / 4;
    if (k > 0) {
      EXPECT_NEAR(at(k, 0) - at(k - 1, 0), 0.98, 2e-5) << k;
    }
    EXPECT_NEAR(at(k, 1), 3, 1e-5);
  }
  EXPECT_NEAR(mean, 3, 1e-5);
}

class ReportCommandTest : public ::testing::Test {
 protected:
  /// Writes made-up results as a run would leave them.
  void write_results() {
    auto json = test::good_manifest();
    json["replicates"] = 2;
    const auto manifest = parse_manifest(json.dump(), "m");
    const Store store(directory_ / "results", manifest, test::unheard);
    const Plan all(manifest);
    for (std::size_t k = 0; k < all.size(); ++k) store.write(test::made_up_outcome(all[k]));
  }

  test::TemporaryDirectory directory_;
};

TEST_F(ReportCommandTest, WritesOnlyTheRequestedFile) {
  write_results();
  const auto before = test::files_below(directory_.path());
  for (const std::string name : {"a.html", "b.html"}) {
    const auto run = test::isojam({"report", "results", "-o", name}, directory_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, name + "\n");
    EXPECT_EQ(run.err, "");
  }
  auto after = test::files_below(directory_.path());
  EXPECT_EQ(after["a.html"], after["b.html"]);
  EXPECT_EQ(after["a.html"].rfind("<!doctype html>", 0), 0U);
  after.erase("a.html");
  after.erase("b.html");
  EXPECT_EQ(after, before);
  EXPECT_EQ(test::isojam({"report", "results"}, directory_.path()).out, "results/report.html\n");
}

TEST_F(ReportCommandTest, RejectsMissingOrDamagedResults) {
  EXPECT_EQ(test::isojam({"report", "."}, directory_.path()).exit_code, 2);
  write_results();
  for (const auto* folder : {"packings", "records"}) {
    const auto path = std::filesystem::directory_iterator(directory_ / "results" / folder)->path();
    auto text = read_text(path.string());
    text[text.size() / 2] ^= 1;
    test::write_text(path, text);
    const auto run = test::isojam({"report", "results", "-o", "a.html"}, directory_.path());
    EXPECT_EQ(run.exit_code, 65) << folder << ": " << run.err;
    EXPECT_NE(run.err.find(path.filename().string()), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "a.html")) << folder;
  }
}

}  // namespace
}  // namespace isojam
