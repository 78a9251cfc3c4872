#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tasks/chart/conclusion.hpp"
#include "tasks/chart/data.hpp"

namespace isojam {
namespace {

using Row = std::array<std::string, 9>;

const Row heading{"case", "method", "setting", "seconds", "n", "error", "greatest", "n", "stopped"};

std::string number(double x) { return fmt::format("{:.2e}", x); }

Row row_of(const ChartPoint& point) {
  Row row{point.task, point.method, point.setting, "-", "", "-", "", "", point.stopped};
  if (point.seconds) {
    row[3] = number(point.seconds->median);
    row[4] = std::to_string(point.seconds->n);
  }
  if (point.error) {
    row[5] = number(point.error->median);
    row[6] = number(point.error->greatest);
    row[7] = std::to_string(point.error->n);
  }
  if (point.failed) row.back() += "  FAILED";
  return row;
}

/// Characters as a terminal shows them: bytes that continue a UTF-8 sequence take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += row[k] + std::string(widths[k] - width(row[k]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string ended_text(FamilyEnd end) {
  switch (end) {
    case FamilyEnd::complete: return "";
    case FamilyEnd::cut: return " (CUT: the time was over)";
    case FamilyEnd::interrupted: return " (CUT: interrupted)";
  }
  return "";
}

}  // namespace

std::string text_table(std::span<const ChartFamily> families) {
  std::string text;
  for (const ChartFamily& family : families) {
    text += fmt::format("{}{}: seconds of one thread, {}\n", family.name, ended_text(family.ended), family.error_is);
    std::vector<Row> rows{heading};
    for (const ChartPoint& point : family.points) rows.push_back(row_of(point));
    text += aligned(rows) + "\n";
  }
  for (const auto& line : conclusion(points_of(families, "equilibrium"), points_of(families, "bias")))
    text += line + "\n";
  return text;
}

}  // namespace isojam
