// The oracle of schemas is valijson: what read_document() accepts, a schema accepts, and the reverse.

#include "tasks/io/describe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "tasks/io/fields.hpp"
#include "tests/tasks/support/schema.hpp"

namespace isojam {

enum class Colour { red, green };
template <>
inline constexpr std::array enum_names<Colour>{EnumName{Colour::red, "red"}, EnumName{Colour::green, "green"}};

namespace {

constexpr QuantityGroup group{"sizes", "Sizes of everything."};

struct Bins {
  long below = 0;
  std::vector<double> counts;
};
void describe(Fields& field, Bins& bins) {
  field.type("bins", "A histogram.");
  field("below", bins.below, "Number of values below the first bin.");
  field("counts", bins.counts, "Numbers of values in each bin.").range(not_negative);
}

struct Sample {
  double length = 0, ratio = 0;
  int count = 0;
  bool lost = false;
  Colour colour = Colour::red;
  std::string note;
  Reasoned<> slope;
  Reasoned<long> rank;
  std::optional<Bins> bins;
  std::vector<Bins> list;
  std::array<int, 2> pair{};
  std::vector<std::array<int, 2>> pairs;
  double step = 0.5;
  std::optional<double> limit;
  std::optional<Reasoned<>> width;
  std::vector<std::optional<double>> means;
  std::vector<Bins> numbered;
  std::vector<std::vector<double>> matrix;
};
void describe(Fields& field, Sample& sample) {
  field("length", sample.length, "Length.").unit("V_p^(1/3)").column({"l", group, "\\ell"});
  field("ratio", sample.ratio, "Ratio.").range({0, 1, true}).finite();
  field("count", sample.count, "Count.");
  field("lost", sample.lost, "True if the branch was lost.").if_true();
  field("colour", sample.colour, "Colour.");
  field("note", sample.note, "Note.");
  field("slope", sample.slope, "Slope.");
  field("rank", sample.rank, "Rank.");
  field("bins", sample.bins, "");
  field("list", sample.list, "Histograms.");
  field("pair", sample.pair, "Two numbers.");
  field("pairs", sample.pairs, "Pairs.");
  field("step", sample.step, "Step.").optional().finite();
  field("limit", sample.limit, "Limit.");
  field("width", sample.width, "Width.");
  field("means", sample.means, "Means.");
  field("bins_*", sample.numbered, "");
  field("M_*_*", sample.matrix, "Matrix.").range(not_negative).finite().column({"M_**", group, "M_{**}"});
  field.renamed = {{"hue", "colour"}};
}

/// Samples with special numbers, empty lists and absent values among them.
class Samples {
 public:
  Sample next() {
    Sample sample;
    sample.length = number();
    sample.ratio = std::uniform_real_distribution(0.1, 1.0)(random_);
    sample.count = integer(1000000);
    sample.lost = coin();
    sample.colour = coin() ? Colour::green : Colour::red;
    sample.note = coin() ? "a \"note\"\n\xce\xb1" : "";
    if (coin()) {
      sample.slope.value = number();
    } else {
      sample.slope.reason = "no states";
    }
    sample.rank = reasoned(coin() ? std::optional<long>(integer(99)) : std::nullopt, "too large");
    if (coin()) sample.bins = bins();
    for (int k = integer(3); k > 0; --k) sample.list.push_back(bins());
    sample.pair = {integer(9), integer(9)};
    for (int k = integer(3); k > 0; --k) sample.pairs.push_back({k, integer(9)});
    if (coin()) sample.limit = number();
    if (coin()) sample.width = reasoned(coin() ? std::optional(number()) : std::nullopt, "none");
    for (int k = integer(3); k > 0; --k) sample.means.push_back(coin() ? std::optional(0.5) : std::nullopt);
    for (int k = integer(most_numbered); k > 0; --k) sample.numbered.push_back(bins());
    sample.matrix.assign(static_cast<std::size_t>(integer(most_numbered)),
                         std::vector(static_cast<std::size_t>(most_numbered), 0.25));
    return sample;
  }
  bool coin() { return integer(1) == 1; }
  int most_numbered = 3;
  int integer(int most) { return std::uniform_int_distribution(0, most)(random_); }

 private:
  double number() {
    const int kind = integer(5);
    if (kind == 0) return std::numeric_limits<double>::infinity();
    if (kind == 1) return std::numeric_limits<double>::quiet_NaN();
    return std::normal_distribution()(random_) * std::pow(10.0, integer(60) - 30);
  }
  Bins bins() { return {integer(9), std::vector<double>(static_cast<std::size_t>(integer(3)), 0.25)}; }

  std::mt19937 random_{7};
};

TEST(Describe, ReadsEveryBitOfWhatItWrote) {
  Samples samples;
  for (int k = 0; k < 1000; ++k) {
    const auto json = written(samples.next());
    const auto text = json.dump();
    EXPECT_EQ(written(read_document<Sample>(parsed(text), "f")).dump(), text);
  }
}

std::vector<std::string> errors_of(const Json& json) {
  try {
    read_document<Sample>(json, "f");
    return {};
  } catch (const InputError& error) {
    std::vector<std::string> list;
    for (const auto& details : error.all())
      list.push_back(details.pointer + ": " + details.problem + "; " + details.allowed + "; " + details.suggestion);
    return list;
  }
}

TEST(Describe, ReportsAllErrorsAtOnceWithPlaceAndRemedy) {
  auto json = written(Samples().next());
  json["ratio"] = 2;
  json["count"] = 1e300;
  json["colour"] = "gren";
  json["hue"] = "red";
  json["lenght"] = 1;
  json["list"] = {{{"below", "x"}, {"counts", {-1}}}};
  json.erase("note");
  const auto errors = errors_of(json);
  std::string all;
  for (const auto& error : errors) all += error + '\n';
  std::cout << all;
  EXPECT_EQ(errors.size(), 8U);
  for (const auto* part :
       {"/ratio: 2 is not accepted; a number in (0, 1]", "/count: 1e+300 is not accepted; an integer from 0 to",
        "/colour: unknown value \"gren\"; one of \"red\", \"green\"; green", "/hue: unknown key", "; colour\n",
        "/lenght: unknown key", "; length\n", "/list/0/below: \"x\" is not accepted; an integer",
        "/list/0/counts/0: -1 is not accepted", "/note: the required key is missing"})
    EXPECT_NE(all.find(part), std::string::npos) << part;
}

/// Changes one value somewhere in the document.
void mutate(Json& json, Samples& samples) {
  std::vector<Json*> places{&json};
  for (std::size_t k = 0; k < places.size(); ++k)
    for (auto& child : *places[k])
      if (places[k]->is_structured()) places.push_back(&child);
  Json& place = *places[static_cast<std::size_t>(samples.integer(static_cast<int>(places.size()) - 1))];
  const Json values[] = {nullptr, true, false, -1, 0, 2, 0.5, 1e300, "red", "x", Json::array(), Json::object(), {1, 2}};
  if (place.is_object() && !place.empty() && samples.coin()) {
    place.erase(std::next(place.begin(), samples.integer(static_cast<int>(place.size()) - 1)).key());
  } else if (place.is_object() && samples.coin()) {
    place["new"] = 1;
  } else {
    place = values[samples.integer(12)];
  }
}

TEST(Describe, SchemaAcceptsWhatTheReaderAccepts) {
  const auto schema = schema_of(fields_of<Sample>(), "sample");
  Samples samples;
  // A schema cannot say that the numbers in keys have no gaps.
  samples.most_numbered = 1;
  int accepted = 0, refused = 0, disagree = 0;
  for (int k = 0; k < 3000; ++k) {
    auto json = written(samples.next());
    mutate(json, samples);
    const auto errors = errors_of(json);
    const auto violations = test::violations_of(schema, json);
    // A schema cannot say that a null has a reason, and which reasons a number may have.
    const bool only_reason =
        std::all_of(errors.begin(), errors.end(), [](const auto& e) { return e.find("_reason") != std::string::npos; });
    if (errors.empty() != violations.empty() && !(violations.empty() && only_reason)) {
      ++disagree;
      std::cout << json.dump() << '\n' << (errors.empty() ? "accepted" : errors.front()) << '\n' << violations << '\n';
    }
    ++(errors.empty() ? accepted : refused);
  }
  std::cout << accepted << " accepted, " << refused << " refused, " << disagree << " disagree\n";
  EXPECT_EQ(disagree, 0);
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 1000);
}

TEST(Describe, SectionsAndColumnsHaveEveryField) {
  const auto sections = sections_of(fields_of<Sample>(), "sample");
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_EQ(sections[0].rows.size(), fields_of<Sample>().list.size());
  EXPECT_EQ(sections[1].title, "bins");
  EXPECT_EQ(sections[0].rows[1].kind, "number > 0, ≤ 1");
  EXPECT_EQ(sections[0].rows[12].kind, "number, default 0.5");
  std::string names;
  for (const auto& column : columns_of(fields_of<Sample>())) names += column.name + ' ' + column.pointer + '\n';
  std::cout << names;
  EXPECT_NE(names.find("l /length\n"), std::string::npos);
  EXPECT_NE(names.find("bins.below /bins/below\n"), std::string::npos);
  EXPECT_NE(names.find("bins_4.below /bins_4/below\n"), std::string::npos);
  EXPECT_NE(names.find("M_43 /M_4_3\n"), std::string::npos);
  EXPECT_EQ(names.find("counts"), std::string::npos);
}

}  // namespace
}  // namespace isojam
