#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/runtime/variables.h"
#include <cstdint>
#include <fmt/format.h>

namespace mill::fmu {
namespace {
std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : c == '\n' ? "\\n" : std::string(1, c);
  return out + "\"";
}

class JsonWriter {
public:
  explicit JsonWriter(std::string gap) : gap_(std::move(gap)) {}
  void operator()(const char *name, const std::string &value)
  {
    add(name, quoted(value));
  }
  void operator()(const char *name, const double value)
  {
    add(name, exact_number(value));
  }
  void operator()(const char *name, const int value)
  {
    add(name, std::to_string(value));
  }
  void operator()(const char *name, const bool value)
  {
    add(name, value ? "true" : "false");
  }
  void operator()(const char *name, const std::vector<double> &values)
  {
    add(name, "[" + joined(values, exact_number, ", ") + "]");
  }
  void operator()(const char *name, const std::vector<std::string> &values)
  {
    add(name, "[" + joined(values, quoted, ", ") + "]");
  }
  template <class Part> void operator()(const char *name, const std::vector<Part> &values)
  {
    const auto one = [](const Part &part) {
      JsonWriter inside(" ");
      each_member(inside, part, &part);
      return "    {" + inside.members_ + "}";
    };
    add(name, values.empty() ? "[]" : "[\n" + joined(values, one, ",\n") + "\n  ]");
  }
  template <class Part>
  auto operator()(const char *name, const Part &part) -> decltype(each_member(*this, part, &part))
  {
    JsonWriter inside("\n    ");
    each_member(inside, part, &part);
    add(name, "{\n    " + inside.members_ + "\n  }");
  }
  const std::string &members() const
  {
    return members_;
  }

private:
  template <class List, class Text>
  static std::string joined(const List &list, const Text &text, const std::string &between)
  {
    std::string all;
    for (const auto &item : list)
      all += (all.empty() ? "" : between) + text(item);
    return all;
  }
  void add(const char *name, const std::string &value)
  {
    members_ += (members_.empty() ? "" : "," + gap_) + quoted(name) + ": " + value;
  }
  std::string gap_, members_;
};

std::uint64_t fnv(const std::string &text, std::uint64_t hash)
{
  for (const char c : text)
    hash = (hash ^ std::uint64_t(static_cast<unsigned char>(c))) * 1099511628211u;
  return hash;
}
}  // namespace

std::string exact_number(const double value)
{
  return fmt::format("{}", value);  // shortest text that gives the number back; no locale
}

std::string model_json(const ModelData &model)
{
  JsonWriter writer("\n  ");
  each_member(writer, model, &model);
  return "{\n  " + writer.members() + "\n}\n";
}

std::string series_csv(const ForceRecord &force)
{
  std::string text = "time [s],force [N]\n";
  for (Eigen::Index i = 0; i < force.time.size(); ++i)
    text += exact_number(force.time[i]) + "," + exact_number(force.force[i]) + "\n";
  return text;
}

std::string identity_of(const ExportedModel &model)
{
  ModelData unnamed = model.data;
  unnamed.guid      = "";
  std::string all   = model.identifier + "\n" + model_json(unnamed);
  for (const Variable &v : variables_of(unnamed))
    all += fmt::format("{} {} {} {} {} {} {} {}\n", v.name, int(v.type), int(v.causality), int(v.variability),
                       v.unit, v.low, v.high, v.start);
  if (unnamed.has_series)
    all += series_csv(model.series);
  const std::uint64_t high = fnv(all, 14695981039346656037u), low = fnv(all, 0x9e3779b97f4a7c15u);
  return fmt::format("{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}", high >> 32, high >> 16 & 0xffff, high & 0xffff,
                     low >> 48, low & 0xffffffffffffu);
}
}  // namespace mill::fmu
