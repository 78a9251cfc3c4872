// The checksum is tested only with the unchanged text, because a fuzzer would never find the checksum of a changed one.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/aggregate.hpp"
#include "tasks/tables/tables.hpp"

namespace {

template <class Read>
void refused_or_read(const Read& read) {
  try {
    read();
  } catch (const isojam::InputError& refused) {
    if (*refused.what() == '\0') std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isojam;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  refused_or_read([&] { parse_sealed(text, "fuzz"); });
  refused_or_read([&] {
    const auto summary = summarise_record(parse_json(text, "fuzz"), "fuzz");
    const auto table = aggregate(std::span(&summary, 1));
    to_json(table).dump();
    to_text(table);
    to_csv(table, View::series);
    to_long_csv(table);
  });
  return 0;
}
