#include "tasks/packings/mixture_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "tasks/io/hash.hpp"

namespace isojam {
namespace {

using ReadSolid = std::function<Solid(const JsonPlace&)>;

constexpr Range size_range{0, 1000, true}, fraction_range{0, 1, true}, sigma_range{0, 3, true};
constexpr std::string_view allowed_sizes =
    "a number in (0, 1000], {\"discrete\": [{\"size\": s, \"fraction\": f}, ...]}, {\"uniform\": [from, to]} or "
    "{\"log_normal\": {\"median\": s, \"sigma\": standard deviation of ln volume}}";
/// Tolerance of the sum of fractions: less than one particle of the largest possible number.
constexpr double fraction_rounding = 1e-9;
constexpr std::size_t most_kinds = 32;

template <class List, class Fraction>
void expect_whole(const JsonPlace& place, const List& list, const Fraction& fraction) {
  double sum = 0;
  for (const auto& each : list) sum += fraction(each);
  if (!(std::abs(sum - 1) <= fraction_rounding))
    place.refuse(fmt::format("the fractions sum to {}", sum), "a sum of 1");
}

std::size_t expect_some(const JsonPlace& place, std::string_view of_what) {
  const auto allowed = fmt::format("a list of 1 to {} {}", most_kinds, of_what);
  return place.expect_entries(most_kinds, allowed);
}

Sizes read_discrete(const JsonPlace& place) {
  Sizes sizes{.law = SizeLaw::discrete};
  const auto count = expect_some(place, "sizes, each {\"size\": s, \"fraction\": f}");
  for (std::size_t k = 0; k < count; ++k) {
    const auto entry = place.at(k);
    entry.expect_keys(std::array<std::string_view, 2>{"size", "fraction"});
    sizes.list.push_back({entry.at("size").number(size_range), entry.at("fraction").number(fraction_range)});
  }
  expect_whole(place, sizes.list, [](const SizeShare& each) { return each.fraction; });
  return sizes;
}

Sizes read_uniform(const JsonPlace& place) {
  constexpr std::string_view allowed = "two sizes in ascending order";
  place.expect_length(2, allowed);
  Sizes sizes{.law = SizeLaw::uniform, .from = place.at(0).number(size_range), .to = place.at(1).number(size_range)};
  if (!(sizes.from < sizes.to)) place.refuse("the sizes do not ascend", std::string(allowed));
  return sizes;
}

Sizes read_log_normal(const JsonPlace& place) {
  place.expect_keys(std::array<std::string_view, 2>{"median", "sigma"});
  return {.law = SizeLaw::log_normal,
          .from = place.has("median") ? place.at("median").number(size_range) : 1,
          .sigma = place.at("sigma").number(sigma_range)};
}

Sizes read_sizes(const JsonPlace& place) {
  if (!place.value().is_object()) return {.from = place.number(size_range)};
  place.expect_keys(std::array<std::string_view, 3>{"discrete", "uniform", "log_normal"});
  if (place.value().size() != 1) place.refuse("the sizes need exactly one distribution", std::string(allowed_sizes));
  if (place.has("discrete")) return read_discrete(place.at("discrete"));
  if (place.has("uniform")) return read_uniform(place.at("uniform"));
  return read_log_normal(place.at("log_normal"));
}

Json to_json(const Sizes& sizes) {
  Json json;
  switch (sizes.law) {
    case SizeLaw::fixed: return sizes.from;
    case SizeLaw::uniform: json["uniform"] = {sizes.from, sizes.to}; break;
    case SizeLaw::log_normal:
      json["log_normal"]["median"] = sizes.from;
      json["log_normal"]["sigma"] = sizes.sigma;
      break;
    case SizeLaw::discrete:
      for (const auto& each : sizes.list) {
        Json entry;
        entry["size"] = each.size;
        entry["fraction"] = each.fraction;
        json["discrete"].push_back(std::move(entry));
      }
      break;
  }
  return json;
}

std::vector<MixtureKind> read_kinds(const JsonPlace& place, const ReadSolid& read) {
  const auto count = expect_some(place, "kinds, each {\"solid\": ..., \"fraction\": f, \"size\": s}");
  std::vector<MixtureKind> kinds;
  for (std::size_t k = 0; k < count; ++k) {
    const auto entry = place.at(k);
    entry.expect_object("{\"solid\": ..., \"fraction\": f, \"size\": s}");
    entry.expect_keys(std::array<std::string_view, 4>{"solid", "fraction", "size", "vertices"});
    kinds.push_back({read(entry), entry.at("fraction").number(fraction_range),
                     entry.has("size") ? read_sizes(entry.at("size")) : Sizes{}});
  }
  expect_whole(place, kinds, [](const MixtureKind& kind) { return kind.fraction; });
  return kinds;
}

/// A name that is too long for file names is replaced by its hash.
Mixture named(std::vector<MixtureKind> kinds, std::string name) {
  Mixture mixture(std::move(kinds), std::move(name));
  if (mixture.name().size() <= longest_solid_name) return mixture;
  return {mixture.kinds(), fmt::format("mixture_{}", hex_hash(mixture.name()))};
}

template <class PutSolid>
Json kinds_json(const Mixture& mixture, const PutSolid& put) {
  Json list;
  for (const auto& kind : mixture.kinds()) {
    Json entry;
    put(entry, kind.solid);
    entry["fraction"] = kind.fraction;
    entry["size"] = to_json(kind.sizes);
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions) {
  if (!place.value().is_object()) return read_solid_name(place, definitions);
  place.expect_keys(std::array<std::string_view, 2>{"mixture", "name"});
  const auto kinds = read_kinds(place.at("mixture"), [&](const JsonPlace& entry) {
    if (entry.has("vertices"))
      entry.at("vertices").refuse_with_remedy("vertices are not accepted here", "define the solid in /solids");
    return read_solid_name(entry.at("solid"), definitions);
  });
  if (!place.has("name")) return named(kinds, "");
  const auto name = place.at("name").text();
  check_solid_name(place.at("name"), name);
  if (definitions.contains(name)) place.at("name").refuse_with_remedy("a solid has this name", "choose another name");
  return {kinds, name};
}

Json sweep_entry(const Mixture& mixture) {
  if (mixture.is_one_solid()) return to_string(mixture.solid());
  Json json;
  // A name derived from the mixture need not be stored.
  if (named(mixture.kinds(), "").name() != mixture.name()) json["name"] = mixture.name();
  json["mixture"] = kinds_json(mixture, [](Json& entry, const Solid& solid) { entry["solid"] = to_string(solid); });
  return json;
}

void put_mixture(Json& json, const Mixture& mixture) {
  if (mixture.is_one_solid()) return put_solid(json, mixture.solid());
  json["solid"] = to_string(mixture);
  json["mixture"] = kinds_json(mixture, put_solid);
}

Mixture read_mixture(const JsonPlace& place) {
  if (!place.has("mixture")) return read_solid(place);
  return {read_kinds(place.at("mixture"), read_solid), place.at("solid").text()};
}

}  // namespace isojam
