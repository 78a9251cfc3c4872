#include "tasks/tables/fitted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isojam {
namespace {

constexpr std::size_t space = 3;  // between two columns

/// Number of characters of a UTF-8 text.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::size_t> widths_of(const std::vector<Cells>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
  }
  return widths;
}

/// A text that may be wider than requested.
struct Fit {
  std::string text;
  std::size_t width = 0, lines = 0, blocks = 1;
};

/// Appends the columns of a block. The first column is left-aligned, the other columns are right-aligned.
void append(Fit& fit, const std::vector<Cells>& lines, const std::vector<std::size_t>& widths,
            const std::vector<std::size_t>& block) {
  for (const auto& line : lines) {
    std::string text;
    for (const auto i : block) {
      const std::string padding(widths[i] - width(line[i]), ' ');
      text += i == block.front() ? line[i] + padding : std::string(space, ' ') + padding + line[i];
    }
    fit.width = std::max(fit.width, width(text));
    fit.text += text + '\n';
    ++fit.lines;
  }
}

/// Divides the table into as few blocks of columns as possible.
Fit in_blocks(const std::vector<Cells>& lines, std::size_t keys, std::size_t columns) {
  const auto widths = widths_of(lines);
  Fit fit;
  std::vector<std::size_t> block;
  std::size_t wide = 0;
  const auto add = [&](std::size_t i) {
    wide += widths[i] + (block.empty() ? 0 : space);
    block.push_back(i);
  };
  const auto begin = [&] {
    block.clear();
    wide = 0;
    for (std::size_t i = 0; i < keys; ++i) add(i);
  };
  begin();
  for (std::size_t i = keys; i < widths.size(); ++i) {
    if (columns > 0 && block.size() > keys && wide + space + widths[i] > columns) {
      append(fit, lines, widths, block);
      fit.text += '\n';
      ++fit.lines;
      ++fit.blocks;
      begin();
    }
    add(i);
  }
  append(fit, lines, widths, block);
  return fit;
}

/// Exchanges the lines with the columns. The old heading becomes the first column.
std::vector<Cells> transposed(const std::vector<Cells>& lines) {
  std::vector<Cells> result(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      result[i].push_back(line[i].substr(std::min(line[i].size(), line[i].find_first_not_of(' '))));
  }
  return result;
}

}  // namespace

std::string fitted(const std::vector<Cells>& lines, std::size_t keys, std::size_t columns) {
  auto whole = in_blocks(lines, keys, 0);
  if (columns == 0 || whole.width <= columns) return whole.text;
  auto blocks = in_blocks(lines, keys, columns), turned = in_blocks(transposed(lines), 1, columns);
  const auto excess = [&](const Fit& fit) { return fit.width > columns ? fit.width - columns : 0; };
  if (turned.blocks == 1 && turned.width <= columns) return turned.text;
  const auto order = [&](const Fit& fit) { return std::pair(excess(fit), fit.lines); };
  return order(turned) < order(blocks) ? turned.text : blocks.text;
}

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  std::size_t wide = 0;
  while (!text.empty()) {
    const auto word = text.substr(0, text.find(' '));
    if (columns > 0 && wide > 0 && wide + 1 + width(word) > columns) {
      result += '\n';
      wide = 0;
    } else if (!result.empty()) {
      result += ' ';
      ++wide;
    }
    result += word;
    wide += width(word);
    text.remove_prefix(std::min(text.size(), word.size() + 1));
  }
  return result;
}

}  // namespace isojam
