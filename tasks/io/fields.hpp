#pragma once

#include <string>
#include <vector>

#include "tasks/io/describe.hpp"

// What follows from a description besides writing and reading: schemas, lists of fields for people, columns of tables.

namespace isojam {

/// The draft-07 schema of a document with these fields. Types with a name are among its definitions.
Json schema_of(const Fields& fields, std::string_view title);
/// The schema of an object with these fields, for the schema of a Custom field.
Json object_schema(const Fields& fields);

/// A field for people.
struct FieldRow {
  std::string key, kind, unit, meaning;
  std::string inner;  ///< title of the section with the fields inside this one; empty if there are none
};
/// The fields of one object, or of a type that several fields have.
struct FieldSection {
  std::string title;    ///< path with dots, or the name of the type
  std::string meaning;  ///< empty if the field that contains the object states it
  std::vector<FieldRow> rows;
};
/// The sections of an object and of everything inside it. Each type appears once.
std::vector<FieldSection> sections_of(const Fields& fields, const std::string& title);

/// A scalar field that is not inside a list: its name in tables, or else its path with dots, and its JSON pointer.
struct FlatColumn {
  std::string name, pointer;
  FieldEntry field;
  bool can_be_absent = false;  ///< true if the field or an object around it can be absent
};
std::vector<FlatColumn> columns_of(const Fields& fields, const std::string& pointer = "");
/// True if the values of a field are texts.
bool is_text(const FieldEntry& field);

}  // namespace isojam
