#include <gtest/gtest.h>

#include <algorithm>

#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/store.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

class ExcludeTest : public ::testing::Test {
 protected:
  /// Replicate 1 is a crystal, replicate 2 did not reach final_distance, and replicate 3 failed.
  static Outcome outcome_of(const ReplicateSpec& spec) {
    auto outcome = test::made_up_outcome(spec);
    if (spec.replicate == 1) {
      outcome.measured.at(Measure::contacts).flags = {"crystalline"};
      outcome.jam.phi_j->density += 0.05;
      for (auto& step : outcome.jam.path) step.density += 0.05;
    }
    if (spec.replicate == 2) outcome.jam.status = JamStatus::goal_not_reached;
    if (spec.replicate == 3) outcome.failure = Failure{"jam", "made up"};
    return outcome;
  }

  void write(const std::string& name, const std::function<void(Json&)>& change = {}) {
    auto json = test::good_manifest();
    json["replicates"] = 6;
    if (change) change(json);
    const auto manifest = parse_manifest(json.dump(), "m.json");
    const Store store(directory_ / name, manifest, test::unheard);
    for (const auto& spec : test::make_plan(manifest)) {
      phi_j_.push_back(outcome_of(spec).jam.phi_j->density);
      store.write(outcome_of(spec));
    }
  }

  std::string aggregate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "aggregate");
    const auto run = test::isojam(arguments, directory_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  }

  Json table(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--format", "json"});
    return parse_json(aggregate(arguments), "table");
  }

  double mean_of(const std::vector<std::size_t>& replicates) const {
    double sum = 0;
    for (const auto r : replicates) sum += phi_j_.at(r);
    return sum / static_cast<double>(replicates.size());
  }

  test::TemporaryDirectory directory_;
  std::vector<double> phi_j_;
};

TEST_F(ExcludeTest, BothMeansArePrinted) {
  write("r");
  const auto json = table({"r"});
  EXPECT_EQ(test::violations("tables", json), "") << json.dump(1);
  EXPECT_EQ(json.value("exclude", Json()), (Json{"crystalline", "not_balanced"}));
  const auto& row = json.at("rows").at(0);
  EXPECT_EQ(row.value("excluded", -1), 1);
  EXPECT_EQ(row.at("flagged"), 2);
  EXPECT_NEAR(row.at("phi_j").at("mean").get<double>(), mean_of({0, 2, 4, 5}), 1e-14);
  ASSERT_TRUE(row.contains("all")) << row.dump(1);
  EXPECT_NEAR(row.at("all").at("phi_j").at("mean").get<double>(), mean_of({0, 1, 2, 4, 5}), 1e-14);
  for (const auto& point : row.at("series")) {
    EXPECT_EQ(point.at("Z").at("n"), 4) << point;
    EXPECT_EQ(point.at("all").at("Z").at("n"), 5) << point;
  }
}

TEST_F(ExcludeTest, TheStatusNamesTheFlagsAndADryRunOfAFinishedStudyNeedsNothing) {
  write("r");
  const auto status = test::isojam({"status", "r"}, directory_.path()).out;
  EXPECT_NE(status.find("1 failed, 2 flagged (crystalline 1, goal_not_reached 1), 0 running\n"), std::string::npos)
      << status;
  const auto plan = test::isojam({"run", "r/manifest.json", "-o", "r", "--dry-run"}, directory_.path()).out;
  EXPECT_NE(plan.find("remaining: nothing\n"), std::string::npos) << plan;
  EXPECT_EQ(plan.find("0 B"), std::string::npos) << plan;
}

TEST_F(ExcludeTest, TheManifestChoosesAndTheCommandOverrides) {
  write("r", [](Json& manifest) { manifest["exclude"] = Json{"goal_not_reached"}; });
  const auto chosen = table({"r"});
  EXPECT_EQ(chosen.at("exclude"), Json{"goal_not_reached"});
  EXPECT_NEAR(chosen.at("rows").at(0).at("phi_j").at("mean").get<double>(), mean_of({0, 1, 4, 5}), 1e-14);
  const auto both = table({"r", "--exclude", "goal_not_reached,crystalline"});
  EXPECT_EQ(both.at("rows").at(0).at("excluded"), 2);
  EXPECT_EQ(both.at("rows").at(0).at("phi_j").at("n"), 3);
  const auto none = table({"r", "--exclude", "none"});
  EXPECT_EQ(none.at("exclude"), Json::array());
  EXPECT_EQ(none.at("rows").at(0).at("phi_j").at("n"), 5);
  EXPECT_FALSE(none.at("rows").at(0).contains("all"));
  const auto wrong = test::isojam({"aggregate", "r", "--exclude", "cristalline"}, directory_.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"crystalline\"?"), std::string::npos) << wrong.err;
}

TEST_F(ExcludeTest, DirectoriesThatDisagreeAreRejectedByName) {
  write("default");
  write("same", [](Json& manifest) { manifest["seed"] = 8; });
  write("other", [](Json& manifest) {
    manifest["seed"] = 9;
    manifest["exclude"] = {"not_stable"};
  });
  EXPECT_EQ(table({"default", "same"}).at("rows").at(0).at("excluded"), 2);
  const auto refused = test::isojam({"aggregate", "default", "same", "other"}, directory_.path());
  EXPECT_EQ(refused.exit_code, 65) << refused.err;
  for (const auto* part : {"other/manifest.json: /exclude", "default", "not_stable", "--exclude"})
    EXPECT_NE(refused.err.find(part), std::string::npos) << part << ": " << refused.err;
  EXPECT_EQ(table({"default", "other", "--exclude", "none"}).at("rows").at(0).at("phi_j").at("n"), 10);
  // Without a manifest, the default flags are used.
  std::filesystem::remove(directory_ / "same" / "manifest.json");
  EXPECT_EQ(table({"default", "same"}).at("rows").at(0).at("excluded"), 2);
  EXPECT_EQ(test::isojam({"aggregate", "same", "other"}, directory_.path()).exit_code, 65);
}

TEST_F(ExcludeTest, EveryFormatHasBothAndStatesWhatIsExcluded) {
  write("r");
  const std::string told = "excluded from means: crystalline (1), not_balanced (0)";
  const auto text = aggregate({"r"});
  EXPECT_EQ(text.rfind(told + "\nsolid ", 0), 0U) << text;
  EXPECT_EQ(text.find("excluded from means", told.size()), std::string::npos)
      << "once, above the first table: " << text;
  EXPECT_NE(text.find("\n  all "), std::string::npos) << text;
  EXPECT_NE(text.find("\nexcluded: replicates that the means leave out because of the flags above the table\n"
                      "all: means that include the excluded replicates\nflagged: replicates with a warning"),
            std::string::npos)
      << text;
  const auto latex = aggregate({"r", "--format", "latex"});
  EXPECT_EQ(latex.rfind("% " + told + "\n% jamming: ", 0), 0U) << latex;
  EXPECT_NE(latex.find("\\quad all "), std::string::npos) << latex;
  for (const std::string option : {"--format=csv", "--series"}) {
    const auto csv = aggregate({"r", "--format", "csv", option == "--series" ? option : "--color=never"});
    EXPECT_NE(csv.find(",over,"), std::string::npos) << csv.substr(0, 200);
    EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 2) << csv;
    EXPECT_NE(csv.find(",kept,"), std::string::npos);
    EXPECT_NE(csv.find(",all,"), std::string::npos);
  }
  EXPECT_EQ(aggregate({"r", "--exclude", "none"}).rfind("solid ", 0), 0U);
  EXPECT_EQ(aggregate({"r", "--exclude", "goal_not_reached"}).rfind("excluded from means: goal_not_reached (1)\n", 0),
            0U);
}

/// Cells of a CSV file whose fields contain no commas.
std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> lines(1, {""});
  for (const char c : csv) {
    if (c == '\n') lines.push_back({""});
    if (c == ',') lines.back().emplace_back();
    if (c != '\n' && c != ',') lines.back().back() += c;
  }
  lines.pop_back();
  return lines;
}

TEST_F(ExcludeTest, TheWideCsvHasNoEmptyColumnsAndTheLongOneARowForEachQuantity) {
  // The bootstrap interval needs eight values.
  write("r", [](Json& manifest) { manifest["replicates"] = 10; });
  const auto wide = cells_of(aggregate({"r", "--format", "csv"}));
  ASSERT_EQ(wide.size(), 3U);
  const auto has = [&](const std::string& name) {
    return std::find(wide[0].begin(), wide[0].end(), name) != wide[0].end();
  };
  EXPECT_TRUE(has("Z_mean"));
  EXPECT_FALSE(has("omega_l_mean")) << "not measured";
  EXPECT_TRUE(has("Z_bootstrap_low"));
  for (std::size_t c = 0; c < wide[0].size(); ++c) {
    // Values that are equal in most replicates have no bootstrap interval.
    if (wide[0][c].find("_bootstrap_") != std::string::npos) continue;
    EXPECT_NE(wide[1][c] + wide[2][c], "") << wide[0][c];
  }
  for (const std::string view : {"nearest", "series"}) {
    std::vector<std::string> arguments{"r", "--format", "csv-long"};
    if (view == "series") arguments.emplace_back("--series");
    const auto json = table({"r"}).at("rows").at(0);
    const auto text = aggregate(arguments);
    const auto rows = cells_of(text);
    const auto column = [&](const std::string& name) {
      const auto place = std::find(rows[0].begin(), rows[0].end(), name);
      EXPECT_NE(place, rows[0].end()) << name << " in " << text.substr(0, 200);
      return static_cast<std::size_t>(place - rows[0].begin());
    };
    std::size_t expected = 0;
    for (const auto& quantity : all_quantities()) {
      const auto& places = view == "nearest" ? Json::array({json}) : json.at("series");
      for (const auto& place : places) {
        const auto name = std::string(quantity.name);
        if (place.contains(name) && place.at(name).at("n") > 0) expected += 2;
      }
    }
    EXPECT_EQ(rows.size(), 1 + expected) << text;
    int checked = 0;
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const auto& row = rows[r];
      ASSERT_EQ(row.size(), rows[0].size());
      if (row[column("quantity")] != "Z") continue;
      auto place = json;
      if (view == "series") {
        for (const auto& point : json.at("series")) {
          if (point.at("delta_phi").dump() == row[column("delta_phi")]) place = point;
        }
      }
      const auto& z = row[column("over")] == "all" ? place.at("all").at("Z") : place.at("Z");
      EXPECT_EQ(row[column("n")], z.at("n").dump());
      EXPECT_EQ(row[column("mean")], z.at("mean").dump());
      EXPECT_EQ(row[column("low")], z.at("ci95").at(0).dump());
      EXPECT_EQ(row[column("high")], z.at("ci95").at(1).dump());
      EXPECT_EQ(row[column("sd")], z.at("sd").dump());
      EXPECT_EQ(row[column("bootstrap_high")], z.at("bootstrap95").at(1).dump());
      ++checked;
    }
    EXPECT_EQ(checked, 2 * static_cast<int>(view == "nearest" ? 1 : json.at("series").size()));
  }
}

TEST_F(ExcludeTest, TheGoalOfATableIgnoresExcludedReplicates) {
  // The crystal is .05 above the others, so the interval over all replicates is wider.
  write("r", [](Json& manifest) {
    manifest["replicates"] = {{"min", 6}, {"max", 6}, {"quantity", "phi_j"}, {"half_width", 0.03}};
  });
  const auto row = table({"r"}).at("rows").at(0);
  EXPECT_TRUE(row.at("goal").at("met").get<bool>()) << row.at("goal");
  EXPECT_NEAR(row.at("goal").at("reached").get<double>(), row.at("phi_j").at("half_width").get<double>(), 1e-15);
  EXPECT_FALSE(table({"r", "--exclude", "none"}).at("rows").at(0).at("goal").at("met").get<bool>());
}

}  // namespace
}  // namespace isojam
