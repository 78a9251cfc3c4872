#include "tasks/packings/mixture_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "tasks/io/fields.hpp"
#include "tasks/io/hash.hpp"
#include "tasks/packings/content_error.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {

constexpr Range size_range{0, 1000, true}, fraction_range{0, 1, true}, sigma_range{0, 3, true};

static void describe(Fields& field, SizeShare& share) {
  field("size", share.size, "Size of these particles, as a length.").range(size_range).finite();
  field("fraction", share.fraction,
        "Number of particles of this size, divided by the number of particles of this kind.")
      .range(fraction_range)
      .finite();
}

namespace {

constexpr std::array distributions{SizeLaw::discrete, SizeLaw::uniform, SizeLaw::log_normal, SizeLaw::values};
constexpr std::string_view allowed_sizes =
    "a number in (0, 1000], {\"discrete\": [{\"size\": s, \"fraction\": f}, ...]}, {\"uniform\": [from, to]}, "
    "{\"log_normal\": {\"median\": s, \"sigma\": standard deviation of ln volume}}, {\"values\": [s, ...]} or "
    "{\"file\": \"sizes.txt\"}";
constexpr std::string_view allowed_size_file = "a text file of sizes";
/// Tolerance of the sum of fractions: less than one particle of the largest possible number.
constexpr double fraction_rounding = 1e-9;
constexpr std::size_t most_kinds = 32, most_shares = 1000, most_sizes = 100000;

template <class List, class Fraction>
void expect_whole(const JsonPlace& place, const List& list, const Fraction& fraction) {
  double sum = 0;
  for (const auto& each : list) sum += fraction(each);
  if (!(std::abs(sum - 1) <= fraction_rounding))
    place.refuse(fmt::format("the fractions sum to {}", sum), "a sum of 1");
}

/// The key of a distribution of sizes. A fixed size has none.
Fields fields_of(Sizes& sizes, SizeLaw law) {
  Fields field;
  if (law == SizeLaw::discrete)
    field("discrete", sizes.list,
          "Discrete distribution: several sizes with their fractions. The sum of the fractions is 1.")
        .length(1, most_shares);
  if (law == SizeLaw::values)
    field("values", sizes.values,
          "Sizes of measured particles, in any number and order. In place of this key, `file` may name a text file of "
          "these numbers, with a path relative to the manifest.")
        .range(size_range)
        .length(1, most_sizes);
  if (law == SizeLaw::uniform) {
    const auto end = [&sizes](std::size_t k) -> MemberRef { return k == 0 ? &sizes.from : &sizes.to; };
    field
        .member("uniform", Many{[] { return 2; }, [](std::size_t) {}, end, [end] { return end(0); }, 2, 2},
                "Uniform distribution of the size: the smallest and the largest size.")
        .range(size_range)
        .finite();
  }
  if (law == SizeLaw::log_normal) {
    const auto parameters = [&sizes](Fields& of) {
      of("median", sizes.from, "Median of the size. The median of V is the volume of a particle of this size.")
          .range(size_range)
          .optional()
          .finite();
      of("sigma", sizes.sigma, "Standard deviation of ln V.").range(sigma_range).finite();
    };
    field.nested("log_normal", parameters, "Log-normal distribution of the particle volume V.");
  }
  field("take", sizes.take,
        "Choice of the sizes of n particles. `quantiles`: quantiles of the distribution, so that its moments hardly "
        "fluctuate. `drawn`: independent random sizes, which are the same in all replicates. `in_order`: the `values` "
        "one after another, from the first one again after the last.")
      .optional();
  field("seed", sizes.seed, "Seed of the sizes that are drawn.").optional();
  return field;
}

FieldEntry field_of_file(std::string& path) {
  Fields field;
  return field("file", path, "Text file of sizes, with a path relative to the manifest.");
}

/// The numbers in a text file, which blanks, commas or line ends separate.
std::vector<double> read_size_file(const JsonPlace& place) {
  const auto path = (std::filesystem::path(place.file()).parent_path() / place.text(allowed_size_file)).string();
  auto text = read_named_file(place, path, allowed_size_file);
  std::replace(text.begin(), text.end(), ';', ' ');
  try {
    TextLines raw(text, '#');
    for (auto word = raw.next_word(); !word.empty(); word = raw.next_word()) {
      const auto comma = word.find(',');
      if (comma < word.size() - 1 && word.find('.') > word.size() && word.find(',', comma + 1) >= word.size() - 1)
        raw.refuse(fmt::format("\"{}\" may be one size or two", word),
                   "write a decimal point, or a blank after the comma");
    }
    std::replace(text.begin(), text.end(), ',', ' ');
    TextLines lines(text, '#');
    std::vector<double> sizes;
    for (auto word = lines.next_word(); !word.empty(); word = lines.next_word()) {
      sizes.push_back(lines.real(word));
      if (!(sizes.back() > 0 && sizes.back() <= size_range.high))
        lines.refuse(fmt::format("the size {} is not in (0, {:g}]", word, size_range.high),
                     "use another unit of length");
    }
    if (sizes.empty() || sizes.size() > most_sizes)
      throw ContentError(fmt::format("it contains {} numbers", sizes.size()),
                         fmt::format("write 1 to {} sizes", most_sizes));
    return sizes;
  } catch (const ContentError& error) {
    refuse_content(place, path, error, allowed_size_file);
  }
}

Sizes read_sizes(const JsonPlace& place) {
  if (!place.value().is_object()) return {.from = place.number(size_range)};
  std::vector<std::string_view> names{"file"};
  for (const auto law : distributions) names.push_back(to_string(law));
  const auto is_given = [&](std::string_view name) { return place.has(std::string(name)); };
  const auto several = std::count_if(names.begin(), names.end(), is_given);
  const std::string key(several == 0 ? "" : *std::find_if(names.begin(), names.end(), is_given));
  names.insert(names.end(), {"take", "seed"});
  place.expect_keys(names);
  if (several != 1) place.refuse("the sizes need exactly one distribution", std::string(allowed_sizes));
  Sizes sizes;
  std::string path;
  sizes.law = from_string<SizeLaw>(key).value_or(SizeLaw::values);
  auto fields = fields_of(sizes, sizes.law);
  if (key == "file") {
    sizes.values = read_size_file(place.at("file"));
    fields.list.front() = field_of_file(path);
  }
  read_into(place, fields);
  if (!place.is_sound()) return {};
  if (sizes.take == SizeChoice::in_order && sizes.law != SizeLaw::values)
    place.at("take").refuse("only values can be taken in order", "\"quantiles\" or \"drawn\"");
  if (sizes.law == SizeLaw::values && sizes.take != SizeChoice::in_order)
    std::sort(sizes.values.begin(), sizes.values.end());
  if (sizes.law == SizeLaw::discrete)
    expect_whole(place.at(key), sizes.list, [](const SizeShare& each) { return each.fraction; });
  if (sizes.law == SizeLaw::uniform && !(sizes.from < sizes.to))
    place.at(key).refuse("the sizes do not ascend", "two sizes in ascending order");
  return sizes;
}

Json to_json(const Sizes& sizes) {
  if (sizes.law == SizeLaw::fixed) return sizes.from;
  auto copy = sizes;
  auto json = written(fields_of(copy, sizes.law));
  if (sizes.take != SizeChoice::drawn) json.erase("seed");
  if (sizes.take == SizeChoice::quantiles) json.erase("take");
  return json;
}

Json sizes_schema() {
  Sizes sizes;
  Json json{{"description",
             "Size of the particles of this kind, as a length relative to the solid at unit volume. If it is a "
             "distribution of sizes, the sizes of the particles are quantiles of this distribution, unless `take` "
             "requests another choice. isojam scales all "
             "sizes so that the mean particle volume is 1."},
            {"oneOf", {{{"type", "number"}, {"exclusiveMinimum", size_range.low}, {"maximum", size_range.high}}}}};
  for (const auto law : distributions) json["oneOf"].push_back(object_schema(fields_of(sizes, law)));
  std::string file;
  auto of_file = fields_of(sizes, SizeLaw::values);
  of_file.list.front() = field_of_file(file);
  json["oneOf"].push_back(object_schema(of_file));
  return {{"$ref", "#/definitions/sizes"}, {"definitions", {{"sizes", std::move(json)}}}};
}

void describe_kind(Fields& field, MixtureKind& kind, Custom solid) {
  field.custom("solid", std::move(solid), "");
  field("fraction", kind.fraction,
        "Number of particles of this kind, divided by the number of all particles. The sum over all kinds is 1.")
      .range(fraction_range)
      .finite();
  field
      .custom("size",
              {[&kind] { return to_json(kind.sizes); }, [&kind](const JsonPlace& at) { kind.sizes = read_sizes(at); },
               sizes_schema(), "number or a distribution of sizes"},
              "")
      .optional();
}

/// A mixture in a manifest.
struct MixtureEntry {
  std::string name;
  std::vector<MixtureKind> kinds;
};

Fields fields_of(MixtureEntry& entry, const SolidDefinitions& definitions) {
  Fields field;
  field
      .custom("name",
              {[&entry] { return entry.name.empty() ? Json() : Json(entry.name); },
               [&](const JsonPlace& place) {
                 entry.name = place.text();
                 check_solid_name(place, entry.name);
                 if (definitions.contains(entry.name))
                   place.refuse_with_remedy("a solid has this name", "choose another name");
               },
               {{"type", "string"}, {"pattern", solid_name_pattern}},
               "text"},
              "Name of the mixture. Without this key, isojam makes a name from the kinds.")
      .optional();
  const auto kind_of = [&definitions](MixtureKind& kind) {
    return Nested{[&](Fields& of) {
      describe_kind(of, kind,
                    {[&kind] { return Json(to_string(kind.solid)); },
                     [&](const JsonPlace& place) { kind.solid = read_solid_name(place, definitions); }, solid_schema(),
                     "name of a solid"});
    }};
  };
  field.member("mixture",
               Many{[&entry] { return entry.kinds.size(); }, [&entry](std::size_t n) { entry.kinds.resize(n); },
                    [&entry, kind_of](std::size_t k) { return kind_of(entry.kinds[k]); },
                    [kind_of] {
                      static MixtureKind example;
                      return kind_of(example);
                    },
                    1, most_kinds},
               "Kinds of particles in the mixture.");
  return field;
}

double fraction_of(const MixtureKind& kind) { return kind.fraction; }

/// A name that is too long for file names is replaced by its hash.
Mixture named(std::vector<MixtureKind> kinds, std::string name) {
  Mixture mixture(std::move(kinds), std::move(name));
  if (mixture.name().size() <= longest_solid_name) return mixture;
  return {mixture.kinds(), fmt::format("mixture_{}", hex_hash(mixture.name()))};
}

}  // namespace

Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions) {
  if (!place.value().is_object()) return read_solid_name(place, definitions);
  MixtureEntry entry;
  read_into(place, fields_of(entry, definitions));
  if (!place.is_sound()) return SolidKind::tetrahedron;
  expect_whole(place.at("mixture"), entry.kinds, fraction_of);
  return entry.name.empty() ? named(std::move(entry.kinds), "") : Mixture(std::move(entry.kinds), entry.name);
}

Json sweep_entry(const Mixture& mixture) {
  if (mixture.is_one_solid()) return to_string(mixture.solid());
  MixtureEntry entry{mixture.name(), mixture.kinds()};
  // A name derived from the mixture need not be stored.
  if (named(mixture.kinds(), "").name() == mixture.name()) entry.name.clear();
  return written(fields_of(entry, {}));
}

Json sweep_entry_schema() {
  MixtureEntry entry;
  Json mixture{{"description",
                "Several kinds of particles in one packing. Fractions are by number of particles, and their sum is 1. "
                "The number of particles of each kind is exact except for rounding. Sizes are relative lengths; isojam "
                "scales them so that the mean volume of all particles is 1."}};
  mixture.update(object_schema(fields_of(entry, {})));
  return {{"anyOf",
           {solid_schema(), {{"$ref", "#/definitions/mixture"}, {"definitions", {{"mixture", std::move(mixture)}}}}}}};
}

void put_mixture(Json& json, const Mixture& mixture) {
  if (mixture.is_one_solid()) return put_solid(json, mixture.solid());
  json["solid"] = to_string(mixture);
  for (const auto& kind : mixture.kinds()) {
    Json& entry = json["mixture"].emplace_back();
    put_solid(entry, kind.solid);
    entry["fraction"] = kind.fraction;
    entry["size"] = to_json(kind.sizes);
  }
}

Mixture read_mixture(const JsonPlace& place) {
  if (!place.has("mixture")) return read_solid(place);
  const auto list = place.at("mixture");
  std::vector<MixtureKind> kinds(list.expect_entries(most_kinds, fmt::format("a list of 1 to {} kinds", most_kinds)));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const auto entry = list.at(k);
    Fields field;
    describe_kind(field, kinds[k], {{}, [&](const JsonPlace&) { kinds[k].solid = read_solid(entry); }, {}, ""});
    field.custom("vertices", {{}, [](const JsonPlace&) {}, {}, ""}, "").optional();  // read_solid() reads them
    read_into(entry, field);
  }
  expect_whole(list, kinds, fraction_of);
  return {std::move(kinds), place.at("solid").text()};
}

}  // namespace isojam
