#include "model_data.h"
#include "json_reader.h"
#include <cmath>
#include <stdexcept>

namespace mill::fmu {
namespace {
class MemberReader {
public:
  explicit MemberReader(const Json &from) : from_(from) {}

  void operator()(const char *name, std::string &value)
  {
    value = member(name, Json::Kind::text).text;
  }
  void operator()(const char *name, double &value)
  {
    value = member(name, Json::Kind::number).number;
  }
  void operator()(const char *name, int &value)
  {
    const double number = member(name, Json::Kind::number).number;
    if (!(std::abs(number) < 1e6))
      throw std::runtime_error(std::string(name) + " is out of range");
    value = int(number);
  }
  void operator()(const char *name, bool &value)
  {
    value = member(name, Json::Kind::boolean).truth;
  }
  void operator()(const char *name, std::vector<double> &values)
  {
    for (const Json &item : member(name, Json::Kind::list).items)
      values.push_back(checked(name, item, Json::Kind::number).number);
  }
  void operator()(const char *name, std::vector<std::string> &values)
  {
    for (const Json &item : member(name, Json::Kind::list).items)
      values.push_back(checked(name, item, Json::Kind::text).text);
  }
  template <class Part> void operator()(const char *name, std::vector<Part> &values)
  {
    for (const Json &item : member(name, Json::Kind::list).items) {
      Part part;
      MemberReader inside(checked(name, item, Json::Kind::object));
      each_member(inside, part, &part);
      values.push_back(part);
    }
  }

  template <class Part> auto operator()(const char *name, Part &part) -> decltype(each_member(*this, part, &part))
  {
    MemberReader inside(member(name, Json::Kind::object));
    each_member(inside, part, &part);
  }

private:
  static const Json &checked(const char *name, const Json &value, const Json::Kind kind)
  {
    if (value.kind != kind)
      throw std::runtime_error(std::string(name) + " is of the wrong type");
    return value;
  }
  const Json &member(const char *name, const Json::Kind kind) const
  {
    const Json *value = from_.find(name);
    if (!value)
      throw std::runtime_error(std::string(name) + " is missing");
    return checked(name, *value, kind);
  }
  const Json &from_;
};

void require_size(const char *name, const std::size_t size, const std::size_t wanted)
{
  if (size != wanted)
    throw std::runtime_error(std::string(name) + " has " + std::to_string(size) + " entries in place of " +
                             std::to_string(wanted));
}

void require_chain(const ModelData &model)
{
  const std::size_t m = model.points.size();
  require_size("mass", model.mass.size(), m);
  require_size("bite_row", model.bite_row.size(), m);
  for (const SpringData &spring : model.springs)
    for (const int end : {spring.from, spring.to})
      if (end < fixed_end || end >= int(m))
        throw std::runtime_error("spring " + spring.name + " ends at a mass that is not there");
  if (model.load_cell_spring < 0 || model.load_cell_spring >= int(model.springs.size()))
    throw std::runtime_error("load_cell_spring is out of range");
}

void require_modal(const ModelData &model)
{
  const std::size_t n = model.frequency.size();
  require_size("shape", model.shape.size(), n * model.points.size());
  require_size("bite_mode", model.bite_mode.size(), n);
  require_size("load_cell_mode", model.load_cell_mode.size(), n);
  if (n > 0)
    require_size("damper_rows", model.damper_rows.size() % n, 0);
  for (const double f : model.frequency)
    if (!(f > 0))
      throw std::runtime_error("a frequency is not above zero");
}

void require_curves(const ModelData &model)
{
  const CurveData &c = model.curves;
  for (const CurveSpringData &spring : c.springs) {
    require_size("row", spring.row.size(), model.frequency.size());
    if (spring.law < 0 || spring.law >= int(c.laws.size()))
      throw std::runtime_error("spring " + spring.name + " follows a curve that is not there");
    if (!(spring.share > 0 && spring.rest > 0 && spring.force > 0 && spring.stiffness > 0))
      throw std::runtime_error("spring " + spring.name + " carries no load at rest");
  }
  if (!(c.longest_step > 0))
    throw std::runtime_error("longest_step is not above zero");
}

void require_chatter(const ModelData &model)
{
  const ChatterData &c = model.chatter;
  const std::size_t n = c.gap_row.size(), contacts = c.contact_stiffness.size();
  require_size("stiffness", c.stiffness.size(), n * n);
  require_size("damping", c.damping.size(), n * n);
  require_size("force_row", c.force_row.size(), n);
  require_size("displaced", c.displaced.size(), n);
  require_size("point", c.point.size(), n * model.points.size());
  require_size("contact_row", c.contact_row.size(), n * contacts);
  require_size("contact_force_row", c.contact_force_row.size(), n * contacts);
  require_size("magnitude", c.magnitude.size(), 2 * n + 2);
  for (const double motion : c.magnitude)
    if (!(motion > 0))
      throw std::runtime_error("a magnitude is not above zero");
  if (row_of(c.pass.flow.law).tabled && c.pass.flow.table.size() < 2)
    throw std::runtime_error("a table of the flow stress needs two rows");
  if (!(c.longest_step > 0 && c.entry_distance > 0 && c.exit_distance > 0))
    throw std::runtime_error("a length or a step is not above zero");
}
}  // namespace

const char *name_of(const StandKind kind)
{
  switch (kind) {
  case StandKind::chain:
    return "chain";
  case StandKind::modal:
    return "modal";
  case StandKind::curves:
    return "curves";
  case StandKind::chatter:
    return "chatter";
  }
  return nullptr;
}

StandKind stand_kind(const std::string &name)
{
  for (int i = 0; const char *known = name_of(StandKind(i)); ++i)
    if (name == known)
      return StandKind(i);
  throw std::runtime_error("kind " + name + " is unknown");
}

ModelData read_model(const std::string &json)
{
  const Json text = read_json(json);
  ModelData model;
  MemberReader reader(text);
  each_member(reader, model, &model);
  if (model.runtime != runtime_version)
    throw std::runtime_error("it was written for runtime " + model.runtime + ", this is runtime " +
                             runtime_version);
  if (model.points.empty() || model.n_modes() == 0)
    throw std::runtime_error("the model has no masses");
  switch (model.kind) {
  case StandKind::chain:
    require_chain(model);
    break;
  case StandKind::modal:
    require_modal(model);
    break;
  case StandKind::curves:
    require_modal(model);
    require_curves(model);
    break;
  case StandKind::chatter:
    require_chatter(model);
    break;
  }
  return model;
}
}  // namespace mill::fmu
