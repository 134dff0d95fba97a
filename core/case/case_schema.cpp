#include "core/case/input_reference.h"
#include "core/case/stand_rows.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
namespace {
using nlohmann::ordered_json;
using Repeat = SectionRows::Repeat;

const char *const quantity_pattern = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*([^\s0-9]|1/).*$)";

ordered_json quantity()
{
  return {{"type", "string"}, {"pattern", quantity_pattern}};
}

ordered_json element(const std::string &form)
{
  return form == "1" ? ordered_json{{"type", "number"}} : quantity();
}

ordered_json list_of(const std::string &form, const int items)
{
  return {{"type", "array"}, {"items", element(form)}, {"minItems", items}, {"maxItems", items}};
}

ordered_json type_of(const Row &row)
{
  switch (row.kind) {
  case Kind::quantity:
  case Kind::number: {
    ordered_json json = element(row.form);
    if (row.form == "1" && std::isfinite(row.range.min) && std::isfinite(row.range.max)) {
      json["minimum"] = row.range.min;
      json["maximum"] = row.range.max;
    }
    return json;
  }
  case Kind::count: {
    ordered_json json{{"type", "integer"}};
    if (std::isfinite(row.range.min)) {
      json["minimum"] = row.range.min;
      json["maximum"] = row.range.max;
    }
    return json;
  }
  case Kind::flag:
    return {{"type", "boolean"}};
  case Kind::choice:
    return {{"enum", split(row.form, " | ")}};
  case Kind::text:
  case Kind::path:
    return {{"type", "string"}};
  case Kind::pair:
    return list_of(row.form, 2);
  case Kind::six:
    return list_of(row.form, 6);
  case Kind::list:
    return {{"anyOf", ordered_json::array({element(row.form),
                                           {{"type", "array"}, {"items", element(row.form)}, {"minItems", 1}}})}};
  case Kind::triples:
    return {{"type", "array"}, {"items", list_of(row.form, 3)}, {"minItems", 1}};
  case Kind::words:
    if (row.form == "names")
      return {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}, {"minProperties", 1}};
    if (row.form == "text")
      return {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 1}, {"uniqueItems", true}};
    return {
        {"type", "array"}, {"items", {{"enum", split(row.form, " | ")}}}, {"minItems", 1}, {"uniqueItems", true}};
  case Kind::table: {
    const auto forms = split(row.form, ", ");
    const ordered_json pair{{"type", "array"},
                            {"items", ordered_json::array({element(forms[0]), element(forms[1])})},
                            {"minItems", 2},
                            {"maxItems", 2}};
    return {{"type", "array"}, {"items", pair}, {"minItems", 2}};
  }
  }
  return {};
}

std::string description(const Row &row)
{
  std::string text = row.meaning;
  if (const std::string limits = range_text(row); !limits.empty())
    text += "; " + limits;
  if (const std::string value = default_toml(row); !value.empty())
    text += "; default " + value;
  return text;
}

// A value of [given] or [published]: a quantity, or a table that keeps where it comes from.
ordered_json given_type()
{
  const ordered_json text{{"type", "string"}};
  const ordered_json table{
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"value"}},
      {"properties",
       {{"value", quantity()},
        {"source", {{"type", "string"}, {"pattern", "^(given|published|measured|assumed|computed)(: .*)?$"}}},
        {"method", text},
        {"at", text},
        {"error_estimate", {{"type", "number"}}},
        {"inputs", {{"type", "array"}, {"items", text}}}}}};
  return {{"anyOf", ordered_json::array({quantity(), table})}};
}

ordered_json closed_object()
{
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", ordered_json::object()}};
}

// What is missing is not marked here: given values, drawings, a designation and estimates make keys needless,
// which `millstand check` knows, and a mistyped key is marked once, where it stands.
void add_rows(ordered_json &object, const SectionRows &section)
{
  for (const Row &row : section.rows) {
    ordered_json type   = (section.name == "given" || section.name == "published") && !is_tolerance(row.key)
                              ? given_type()
                              : type_of(row);
    type["description"] = description(row);
    object["properties"][row.key] = std::move(type);
  }
}

// Object of a section that may lie deeper: "contact.upper" becomes properties.contact.properties.upper.
ordered_json &object_at(ordered_json &root, const std::string &name)
{
  ordered_json *object = &root;
  for (const std::string &part : split(name, ".")) {
    ordered_json &properties = (*object)["properties"];
    if (!properties.contains(part))
      properties[part] = closed_object();
    object = &properties[part];
    if (object->contains("items"))  // a section of each of a list, [roll.saddles]
      object = &(*object)["items"];
    if (!object->contains("properties")) {  // a key that may also be a section: friction = 0.2 or { law = ... }
      const ordered_json plain = *object;
      *object                  = {{"anyOf", ordered_json::array({plain, closed_object()})},
                                  {"description", plain.at("description")}};
      object                   = &(*object)["anyOf"][1];
    }
  }
  return *object;
}

ordered_json schema_of(const std::string &kind)
{
  ordered_json root = closed_object();
  root["title"]     = kind;
  for (const SectionRows &section : sections_of(kind)) {
    if (section.name.empty()) {
      add_rows(root, section);
      root["properties"]["schema"]["const"] = 1;
      root["properties"]["kind"]["const"]   = kind;
    } else if (section.repeat == Repeat::once) {
      ordered_json &object  = object_at(root, section.name);
      object["description"] = section.meaning;
      add_rows(object, section);
    } else {
      ordered_json item = closed_object();
      add_rows(item, section);
      const std::size_t dot    = section.name.rfind('.');
      const std::string name   = section.name.substr(dot + 1);  // npos + 1 is the whole
      ordered_json &properties = dot == std::string::npos
                                     ? root["properties"]
                                     : object_at(root, section.name.substr(0, dot))["properties"];
      if (properties.contains(name)) {  // another type of the same section
        ordered_json &items = properties[name]["additionalProperties"];
        items =
            ordered_json{{"if", {{"properties", {{"type", {{"const", section.type}}}}}, {"required", {"type"}}}},
                         {"then", item},
                         {"else", items}};
        continue;
      }
      properties[name] =
          section.repeat == Repeat::list
              ? ordered_json{{"type", "array"}, {"items", item}, {"description", section.meaning}}
              : ordered_json{{"type", "object"}, {"additionalProperties", item}, {"description", section.meaning}};
    }
  }
  return root;
}
}  // namespace

std::string case_schema()
{
  // By if and then, so that a typo is marked at its own place and not for every kind that the case does not have.
  ordered_json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                      {"title", "millstand case file"},
                      {"type", "object"},
                      {"required", {"schema", "kind"}},
                      {"properties", {{"kind", ordered_json{{"enum", case_kinds()}}}}}};
  schema["allOf"] = ordered_json::array();
  for (const std::string &kind : case_kinds())
    schema["allOf"].push_back(
        {{"if", {{"properties", {{"kind", ordered_json{{"const", kind}}}}}, {"required", {"kind"}}}},
         {"then", schema_of(kind)}});
  return schema.dump(2) + "\n";
}
}  // namespace mill
