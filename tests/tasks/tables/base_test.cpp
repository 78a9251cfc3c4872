#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tasks/io/parse.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/store.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

std::size_t index_of(std::string_view name) { return quantity_index(name).value(); }

RecordSummary record_of(const Json& parameters, int replicate, double phi_j) {
  RecordSummary record;
  record.particles = 100;
  record.parameters = parameters;
  record.replicate = replicate;
  record.spec_digest = "one";
  record.values[index_of("phi_j")] = phi_j;
  record.result_digest = parameters.dump() + std::to_string(replicate);
  return record;
}

Json fraction(double value) { return Json{{"step_fraction", value}}; }

const Row& row_with(const Table& table, const Json& parameters) {
  const auto found =
      std::find_if(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row.parameters == parameters; });
  EXPECT_NE(found, table.rows.end()) << parameters;
  return *found;
}

Estimate difference_of(const std::vector<RecordSummary>& records, const Json& row, const Json& base) {
  const auto table = aggregate(records, {}, usually_excluded(), base);
  const auto& differences = row_with(table, row).differences;
  EXPECT_TRUE(differences) << row;
  return differences ? differences->estimates[index_of("phi_j")] : Estimate{};
}

/// Six replicates at the fractions .2 and .35. For the numbers 0, 1 and 2, the first is .010, .014 and .012 larger than
/// the other.
std::vector<RecordSummary> six() {
  const std::vector<double> base{0.70, 0.66, 0.68, 0.61, 0.72, 0.65}, others{0.710, 0.674, 0.692, 0.9, 0.1, 0.3};
  std::vector<RecordSummary> records;
  for (int r = 0; r < 6; ++r) {
    records.push_back(record_of(fraction(0.35), r, base[static_cast<std::size_t>(r)]));
    records.push_back(record_of(fraction(0.2), r, others[static_cast<std::size_t>(r)]));
  }
  return records;
}

TEST(Base, DifferencesAgreeWithACalculationByHand) {
  auto records = six();
  // Number 3 failed in the base, 4 is excluded in the other row, and 5 was never run in the base.
  for (auto& record : records) {
    const bool base = record.parameters == fraction(0.35);
    if (record.replicate == 3 && base) {
      record.failed = true;
      record.values = no_values();
    }
    if (record.replicate == 4 && !base) {
      record.flagged = true;
      record.flags = {Flag::crystalline};
    }
  }
  std::erase_if(records, [](const auto& r) { return r.replicate == 5 && r.parameters == fraction(0.35); });
  const auto table = aggregate(records, {}, usually_excluded(), fraction(0.35));
  EXPECT_FALSE(row_with(table, fraction(0.35)).differences);
  const auto& differences = row_with(table, fraction(0.2)).differences;
  ASSERT_TRUE(differences);
  EXPECT_EQ(differences->pairs, 3);
  const auto& phi_j = differences->estimates[index_of("phi_j")];
  EXPECT_EQ(phi_j.n, 3);
  EXPECT_NEAR(phi_j.mean.value(), 0.012, 1e-15);
  EXPECT_NEAR(phi_j.sd.value(), 0.002, 1e-15);
  // Student's t for two degrees of freedom is 4.302653.
  EXPECT_NEAR(phi_j.half_width.value(), 4.302652729911275 * 0.002 / std::sqrt(3), 1e-12);
  EXPECT_EQ(differences->estimates[index_of("Z")].n, 0);
  // The result is the same if they are excluded in the base and failed in the other row.
  for (auto& record : records) {
    if (record.replicate == 3) record.failed = !record.failed;
    if (record.replicate == 4)
      record.flags = record.flags.empty() ? std::vector{Flag::crystalline} : std::vector<Flag>{};
  }
  EXPECT_EQ(row_with(aggregate(records, {}, usually_excluded(), fraction(0.35)), fraction(0.2)).differences->pairs, 3);
  // If nothing is excluded, number 4 counts.
  EXPECT_EQ(row_with(aggregate(records, {}, {}, fraction(0.35)), fraction(0.2)).differences->pairs, 4);
}

TEST(Base, APairNeedsTheQuantityOnBothSides) {
  auto records = six();
  for (auto& record : records) {
    if (record.replicate < 4) record.values[index_of("Z")] = 9 + 0.1 * record.replicate;
    if (record.replicate == 2 && record.parameters == fraction(0.2)) record.values[index_of("Z")].reset();
  }
  const auto table = aggregate(records, {}, usually_excluded(), fraction(0.35));
  const auto& differences = row_with(table, fraction(0.2)).differences;
  EXPECT_EQ(differences->pairs, 6);
  EXPECT_EQ(differences->estimates[index_of("Z")].n, 3);
  EXPECT_NEAR(*differences->estimates[index_of("Z")].mean, 0, 1e-15);
}

/// Every combination of two parameters and two sizes, each with different values.
std::vector<RecordSummary> grid() {
  std::vector<RecordSummary> records;
  for (const int particles : {100, 200}) {
    for (const double value : {0.2, 0.35, 0.5}) {
      for (const std::string method : {"multipliers", "newton"}) {
        for (int r = 0; r < 3; ++r) {
          auto parameters = Json{{"method", method}, {"step_fraction", value}};
          const double shift = value + (method == "newton" ? 0.01 : 0);
          records.push_back(record_of(parameters, r, particles * shift + std::pow(10, -r)));
          records.back().particles = particles;
        }
      }
    }
  }
  return records;
}

TEST(Base, EveryRowIsComparedWithTheOneOfItsSolidAndSize) {
  const auto i = index_of("phi_j");
  const auto shift = [](const Row& row) {
    return row.parameters.at("step_fraction").get<double>() + (row.parameters.at("method") == "newton" ? 0.01 : 0);
  };
  for (const auto& [base, expected] : {std::pair{Json{{"step_fraction", 0.35}}, 8U},
                                       {Json{{"method", "newton"}}, 6U},
                                       {Json{{"method", "newton"}, {"step_fraction", 0.35}}, 10U}}) {
    std::size_t compared = 0;
    for (const auto& row : aggregate(grid(), {}, usually_excluded(), base).rows) {
      auto of_base = row;
      of_base.parameters.update(base);
      EXPECT_EQ(row.differences.has_value(), of_base.parameters != row.parameters) << base << row.parameters;
      if (!row.differences) continue;
      ++compared;
      EXPECT_EQ(row.differences->pairs, 3);
      EXPECT_NEAR(*row.differences->estimates[i].mean, row.particles * (shift(row) - shift(of_base)), 1e-12);
      EXPECT_NEAR(*row.differences->estimates[i].sd, 0, 1e-12) << "of one number";
    }
    EXPECT_EQ(compared, expected) << base;
  }
  for (const auto& row : aggregate(grid()).rows) EXPECT_FALSE(row.differences) << "no base";
}

TEST(Base, ManifestsPairWithinEach) {
  auto records = six();
  for (auto record : six()) {
    record.study = "another";
    record.values[index_of("phi_j")] = *record.values[index_of("phi_j")] + 5;
    records.push_back(record);
  }
  const auto one = difference_of(six(), fraction(0.2), fraction(0.35));
  const auto both = difference_of(records, fraction(0.2), fraction(0.35));
  EXPECT_EQ(both.n, 12);
  EXPECT_NEAR(*both.mean, *one.mean, 1e-14);
  EXPECT_NEAR(*both.sd, *one.sd * std::sqrt(10.0 / 11), 1e-12);
}

class BaseTest : public ::testing::Test {
 protected:
  /// Writes made-up outcomes at the fractions .2, .35 and .5. At .2, number 1 is a crystal.
  void write(const std::string& name, const std::function<void(Json&)>& change = {}) {
    auto json = test::good_manifest();
    json["replicates"] = 4;
    json["sweep"]["step_fraction"] = {0.2, 0.35, 0.5};
    if (change) change(json);
    const auto manifest = parse_manifest(json.dump(), "m.json");
    const Store store(directory_ / name, manifest, test::unheard);
    for (const auto& spec : test::make_plan(manifest)) {
      auto outcome = test::made_up_outcome(spec);
      if (spec.replicate == 1 && spec.options.decompression.step_fraction == 0.2)
        outcome.measured.at(Measure::contacts).flags = {"crystalline"};
      store.write(outcome);
    }
  }

  test::Finished run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "aggregate");
    return test::isojam(arguments, directory_.path());
  }
  std::string aggregated(const std::vector<std::string>& arguments) {
    const auto finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished.out;
  }
  Json table(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--format", "json"});
    return parse_json(aggregated(arguments), "table");
  }

  test::TemporaryDirectory directory_;
};

TEST_F(BaseTest, TheManifestNamesItAndTheCommandOverrides) {
  write("r", [](Json& manifest) { manifest["base"] = fraction(0.35); });
  const auto named = table({"r"});
  EXPECT_EQ(test::violations("tables", named), "") << named.dump(1);
  EXPECT_EQ(named.at("base"), fraction(0.35));
  EXPECT_EQ(named.at("rows").at(0).at("differences").at("pairs"), 3) << "one is excluded";
  EXPECT_FALSE(named.at("rows").at(1).contains("differences"));
  EXPECT_EQ(named.at("rows").at(2).at("differences").at("Z").at("n"), 4);
  const auto other = table({"r", "--base", "step_fraction=2e-1"});
  EXPECT_EQ(other.at("base"), fraction(0.2));
  EXPECT_FALSE(other.at("rows").at(0).contains("differences"));
  EXPECT_EQ(other.at("rows").at(2).at("differences").at("pairs"), 3);
  const auto none = table({"r", "--base", "none"});
  EXPECT_EQ(none.dump().find("differences"), std::string::npos);
  EXPECT_FALSE(none.contains("base"));
  EXPECT_EQ(table({"r", "--exclude", "none"}).at("rows").at(0).at("differences").at("pairs"), 4);
}

TEST_F(BaseTest, EveryFormatHasTheDifferences) {
  write("r", [](Json& manifest) { manifest["base"] = fraction(0.35); });
  const auto json = table({"r"});
  const auto text = aggregated({"r"});
  const std::string told = "differences from step_fraction = 0.35";
  EXPECT_NE(text.find("\n" + told + ": Mean differences"), std::string::npos) << text;
  const auto below = text.substr(text.find(told));
  EXPECT_NE(below.find("step_fraction   pairs "), std::string::npos) << below;
  EXPECT_NE(below.find(" 0.2       3 "), std::string::npos) << below;
  EXPECT_EQ(below.substr(0, below.find("\n\n")).find(" 0.35 "), std::string::npos) << below;
  const auto latex = aggregated({"r", "--format", "latex"});
  const auto told_at = latex.find("% " + told + ": Mean differences");
  ASSERT_NE(told_at, std::string::npos) << latex;
  EXPECT_EQ(latex.find("\n\\begin{tabular}{lrrrrrrr}", told_at), latex.find('\n', told_at)) << latex;
  EXPECT_EQ(aggregated({"r", "--series"}).find("differences"), std::string::npos);
  const auto csv = aggregated({"r", "--format", "csv"});
  const auto mean = json.at("rows").at(0).at("differences").at("phi_j").at("mean").dump();
  EXPECT_NE(csv.find(",difference," + mean + ","), std::string::npos) << csv;
  EXPECT_EQ(aggregated({"r", "--format", "csv", "--series"}).find("difference"), std::string::npos);
  // The heading, two lines (kept and all) of the row with a crystal, one line each of the two other rows, and two lines
  // of differences.
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7) << csv;
  const auto& z = json.at("rows").at(2).at("differences").at("Z");
  const auto line = ",difference,Z," + z.at("mean").dump() + "," + z.at("ci95").at(0).dump() + "," +
                    z.at("ci95").at(1).dump() + "," + z.at("sd").dump() + ",4,";
  const auto long_csv = aggregated({"r", "--format", "csv-long"});
  EXPECT_NE(long_csv.find(line), std::string::npos) << line << "\n" << long_csv;
}

TEST_F(BaseTest, DirectoriesThatDisagreeAreRejectedByName) {
  write("one", [](Json& manifest) { manifest["base"] = fraction(0.35); });
  write("same", [](Json& manifest) {
    manifest["seed"] = 8;
    manifest["base"] = fraction(0.35);
  });
  write("none", [](Json& manifest) { manifest["seed"] = 9; });
  EXPECT_EQ(table({"one", "same"}).at("rows").at(2).at("differences").at("pairs"), 8);
  const auto refused = run({"one", "same", "none"});
  EXPECT_EQ(refused.exit_code, 65) << refused.err;
  for (const auto* part : {"none/manifest.json: /base: not given here, but {\"step_fraction\":0.35} in one", "--base"})
    EXPECT_NE(refused.err.find(part), std::string::npos) << part << ": " << refused.err;
  EXPECT_EQ(table({"one", "none", "--base", "step_fraction=0.5"}).at("rows").at(1).at("differences").at("pairs"), 8);
}

TEST_F(BaseTest, AnInvalidBaseIsRejectedWithTheAllowedValues) {
  write("r");
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"step_fracton=0.35", "did you mean \"step_fraction\"?"},
      {"solid=cube", "unknown parameter \"solid\"; expected \"none\" or one of \"initial_density\""},
      {"step_fraction", "PARAMETER=VALUE separated by commas"},
      {"step_fraction=much", "\"much\" is not accepted; expected a number in (0, 1)"},
      {"step_fraction=0.2,step_fraction=0.35", "given twice"},
      {"step_fraction=0.3", "0.3 is not a swept value; expected one of 0.2, 0.35, 0.5"},
      {"method=newton", "--base: /method: the parameter is not swept; expected \"step_fraction\""}};
  for (const auto& [text, says] : wrong) {
    const auto refused = run({"r", "-o", "t.json", "--base", text});
    EXPECT_EQ(refused.exit_code, 2) << text << ": " << refused.err;
    EXPECT_NE(refused.err.find(says), std::string::npos) << text << ": " << refused.err;
    EXPECT_EQ(refused.out, "");
    EXPECT_FALSE(std::filesystem::exists(directory_ / "t.json"));
  }
}

}  // namespace
}  // namespace isojam
