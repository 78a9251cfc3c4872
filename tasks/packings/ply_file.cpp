#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "tasks/packings/content_error.hpp"
#include "tasks/packings/mesh.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// The types of PLY: their two names, the numbers of bytes, and whether they are signed integers or real numbers.
struct Type {
  std::string_view name, other;
  std::size_t size;
  char kind;
};
constexpr std::array types{Type{"char", "int8", 1, 'i'},     Type{"uchar", "uint8", 1, 'u'},
                           Type{"short", "int16", 2, 'i'},   Type{"ushort", "uint16", 2, 'u'},
                           Type{"int", "int32", 4, 'i'},     Type{"uint", "uint32", 4, 'u'},
                           Type{"float", "float32", 4, 'f'}, Type{"double", "float64", 8, 'f'}};

const Type& type_of(const TextLines& lines, std::string_view name) {
  const auto found =
      std::find_if(types.begin(), types.end(), [&](const Type& t) { return name == t.name || name == t.other; });
  if (found == types.end()) lines.refuse(fmt::format("{} is not a type of PLY files", in_quotes(name)));
  return *found;
}

struct Property {
  std::string name;
  const Type* type;
  const Type* count;  ///< type of the length of a list; null for a number
};

struct Element {
  std::string name;
  std::size_t size;
  std::vector<Property> properties;
};

/// The numbers after the header, as text or as bytes.
class Values {
 public:
  Values(TextLines& lines, std::optional<std::string_view> bytes, bool swapped)
      : lines_(lines), bytes_(bytes), swapped_(swapped) {}

  double next(const Type& type) {
    if (!bytes_) {
      const auto word = lines_.next_word();
      if (word.empty()) lines_.refuse("the file ends before the last element", "copy or save it again");
      return lines_.real(word);
    }
    if (bytes_->size() < type.size)
      throw ContentError("the file ends before the last element", "copy or save it again");
    std::array<char, 8> raw{};
    std::copy_n(bytes_->begin(), type.size, raw.begin());
    bytes_->remove_prefix(type.size);
    if (swapped_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(type.size));
    return number(type, raw);
  }

  /// Ends an element. Some programs write more numbers to its line than the header states.
  void end_line() {
    if (!bytes_) lines_.skip_line();
  }
  std::size_t line() const { return bytes_ ? 0 : lines_.number(); }

 private:
  template <class T>
  static double as(const std::array<char, 8>& raw) {
    T value;
    std::memcpy(&value, raw.data(), sizeof value);
    return static_cast<double>(value);
  }

  static double number(const Type& type, const std::array<char, 8>& raw) {
    if (type.kind == 'f') return type.size == 4 ? as<float>(raw) : as<double>(raw);
    if (type.size == 1) return type.kind == 'u' ? as<std::uint8_t>(raw) : as<std::int8_t>(raw);
    if (type.size == 2) return type.kind == 'u' ? as<std::uint16_t>(raw) : as<std::int16_t>(raw);
    return type.kind == 'u' ? as<std::uint32_t>(raw) : as<std::int32_t>(raw);
  }

  TextLines& lines_;
  std::optional<std::string_view> bytes_;
  bool swapped_;
};

/// Reads the header. Returns the format, for example "ascii".
std::string read_header(TextLines& lines, std::vector<Element>& elements) {
  std::string format;
  lines.next();
  while (lines.next() && lines.words()[0] != "end_header") {
    const auto& words = lines.words();
    const auto& keyword = words[0];
    if (keyword == "comment" || keyword == "obj_info") continue;
    const bool is_list = keyword == "property" && words.size() == 5 && words[1] == "list";
    if (keyword == "format" && words.size() == 3) {
      format = words[1];
    } else if (keyword == "element" && words.size() == 3) {
      const long most = static_cast<long>(words[1] == "face" ? most_faces : most_points);
      elements.push_back({std::string(words[1]),
                          static_cast<std::size_t>(lines.integer(words[2], 0, most, "number of elements")),
                          {}});
    } else if (!elements.empty() && (is_list || (keyword == "property" && words.size() == 3))) {
      elements.back().properties.push_back({std::string(words.back()), &type_of(lines, words[is_list ? 3 : 1]),
                                            is_list ? &type_of(lines, words[2]) : nullptr});
    } else {
      lines.refuse(fmt::format("{} is not a line of a PLY header", in_quotes(lines.text())));
    }
  }
  if (lines.words().empty()) lines.refuse("the header has no end_header", "copy or save the file again");
  return format;
}

std::size_t index_in(const Values& values, double x, std::size_t points) {
  if (!(x >= 0 && x < static_cast<double>(points)) || x != std::floor(x))
    throw ContentError(fmt::format("the face refers to vertex {}, but there are {} vertices", x, points),
                       "correct the index", values.line());
  return static_cast<std::size_t>(x);
}

void read_element(Values& values, const Element& element, std::size_t points, Mesh& mesh) {
  Eigen::Vector3d point(NAN, NAN, NAN);
  for (const auto& [name, type, count] : element.properties) {
    if (!count) {
      const double x = values.next(*type);
      if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') point[name[0] - 'x'] = x;
      continue;
    }
    const double length = values.next(*count);
    if (!(length >= 0 && length <= static_cast<double>(most_points)))
      throw ContentError(fmt::format("a list has {} entries", length), "copy or save the file again", values.line());
    Mesh::Face face{{}, values.line()};
    const bool is_face = element.name == "face" && (name == "vertex_indices" || name == "vertex_index");
    for (int k = 0; k < static_cast<int>(length); ++k) {
      const double x = values.next(*type);
      if (is_face) face.points.push_back(index_in(values, x, points));
    }
    if (is_face) mesh.faces.push_back(std::move(face));
  }
  if (element.name != "vertex") return;
  // Written so that NaN is refused too.
  if (!(point.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_coordinate))
    throw ContentError(
        fmt::format("vertex {} has no coordinates x, y and z up to {:g}", mesh.points.size(), largest_coordinate),
        "save the file with finite coordinates, or use a larger unit of length", values.line());
  mesh.points.push_back(point);
}

}  // namespace

Mesh read_ply(std::string_view bytes) {
  TextLines lines(bytes);
  std::vector<Element> elements;
  const auto format = read_header(lines, elements);
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
    throw ContentError(fmt::format("{} is not a format of PLY files", in_quotes(format)),
                       "save the file with the format ascii");
  std::optional<std::string_view> data;
  if (format != "ascii") data = bytes.substr(bytes.find('\n', bytes.find("end_header")) + 1);
  lines.skip_line();
  Values values(lines, data, (format == "binary_big_endian") == (std::endian::native == std::endian::little));
  Mesh mesh;
  const auto vertices = std::find_if(elements.begin(), elements.end(), [](auto& e) { return e.name == "vertex"; });
  if (vertices == elements.end()) throw ContentError("the file has no vertices");
  for (const auto& element : elements) {
    for (std::size_t k = 0; k < element.size; ++k) {
      read_element(values, element, vertices->size, mesh);
      values.end_line();
    }
  }
  return mesh;
}

}  // namespace isojam
