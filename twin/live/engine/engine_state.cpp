#include "twin/live/compare/stored_object.h"
#include "twin/live/engine/engine.h"
#include "twin/records/known_channel.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

// What of the engine is stored, and read again.
namespace mill::live {
namespace {
using Json = nlohmann::json;

constexpr std::int64_t state_format = 2;
constexpr std::size_t most_channels = 4096;  // a CSV file may have more columns than a line of JSON

Json numbers(const Eigen::VectorXd &values)
{
  return std::vector<double>(values.begin(), values.end());
}

Json channels_json(const LiveSource &source, const AccountBook &book)
{
  Json list = Json::array();
  for (std::size_t c = 0; c < source.channels.size(); ++c) {
    const ChannelAccount &a = book.channels()[c];
    list.push_back({{"name", source.channels[c].name},
                    {"unit", source.channels[c].unit},
                    {"factor", source.factor[c]},
                    {"offered", a.offered},
                    {"processed", a.processed},
                    {"missing", a.missing},
                    {"rejected", a.rejected},
                    {"overrun", a.overrun}});
  }
  return list;
}

Json adopted_json(const TwinModel &model)
{
  Json springs = Json::array();
  for (std::size_t i = 0; i < model.chain.K.size(); ++i) {
    const Parameter &K = model.chain.K[i];
    springs.push_back({{"value", K.value},
                       {"error", K.error_estimate},
                       {"measured", K.source == Source::measured},
                       {"method", K.method},
                       {"at", K.at.text()}});
  }
  return {{"file", model.adopted},
          {"source", model.source},
          {"damping", model.dynamics.modal_damping},
          {"springs", springs}};
}

// Springs and damping of an adopted proposal in place of the case's own.
void adopt_stored(const StoredObject &stored, TwinModel &model)
{
  model.adopted                = stored.text("file");
  model.source                 = stored.text("source");
  model.dynamics.modal_damping = stored.number("damping", 1e-6, 0.9);
  const auto springs           = stored.list("springs", model.chain.K.size());
  if (springs.size() != model.chain.K.size() || model.adopted.empty())
    stored.refuse("has not the springs of a chain");
  for (std::size_t i = 0; i < springs.size(); ++i) {
    Parameter &K       = model.chain.K[i];
    const double value = springs[i].number_or_unknown("value", 0, any_size);
    if ((value > 0) != (K.value > 0))
      stored.refuse("has other springs than the case");
    const bool unchanged = !(value > 0) || value == K.value;
    if (unchanged)
      continue;
    K.value          = value;
    K.error_estimate = springs[i].number_or_unknown("error", 0, any_size);
    K.source         = springs[i].flag("measured") ? Source::measured : K.source;
    K.method         = springs[i].text("method");
    K.at             = operating_point_of(springs[i].text("at"));
  }
}

ChannelAccount stored_account(const StoredObject &channel)
{
  const auto count = [&](const char *key) { return channel.count(key, 0, largest_number); };
  const ChannelAccount account{count("offered"), count("processed"), count("missing"), count("rejected"),
                               count("overrun")};
  if (!balanced(account))
    channel.refuse("has an account that does not balance");
  return account;
}
}  // namespace

/// A state as it was stored, read to its end before any of it is used.
struct Engine::Stored {
  TwinModel model;
  Tuning tuning;
  SteppedStand stand;
  std::optional<LiveSource> source;  ///< nothing of what follows without one
  std::optional<SourceFile> file;
  std::optional<AccountBook> book;
  std::unique_ptr<TwinStepper> stepper;
  bool start_known = false, stepping = false;
  double mean          = 0;  ///< N
  std::int64_t refused = 0, settled = 0, stepped = 0;
};

nlohmann::json Engine::state()
{
  flush();
  Json state{{"format", state_format}, {"case_hash", model_.hash}, {"model", name_of_model(model_)}};
  state["tuning"] = {{"spring", tuning_.spring}, {"damping", tuning_.damping}};
  if (!model_.adopted.empty())
    state["adopted"] = adopted_json(model_);
  if (!source_ || !is_numbered())
    return state;
  state["source"] = {{"name", source_->name},
                     {"rate", source_->rate},
                     {"start", source_->start_time},
                     {"start_known", start_known_}};
  if (file_)
    state["source"]["file"] = {{"print", file_->print}, {"first", file_->first}};
  state["channels"] = channels_json(*source_, *book_);
  state["next"]     = book_->next();
  state["doubled"]  = book_->doubled();
  state["gaps"]     = book_->gaps();
  state["refused"]  = refused_lines_;
  state["stepping"] = stepping_;
  state["settled"]  = settled_at_;
  state["stepped"]  = stepped_;
  if (stepping_)
    state["motion"] = {{"displacement", numbers(stepper_->displacement())},
                       {"velocity", numbers(stepper_->velocity())},
                       {"reference", stepper_->reference()},
                       {"force", stepper_->last_force()},
                       {"mean", mean_}};
  return state;
}

Engine::Stored Engine::read_state(const nlohmann::json &json) const
{
  const StoredObject state(json, "it");
  Stored stored;
  stored.model              = model_;
  const StoredObject tuning = state.object("tuning");
  const auto factors        = tuning.numbers("spring", Eigen::Index(stored.tuning.spring.size()), 0.5, 1.5);
  std::copy(factors.begin(), factors.end(), stored.tuning.spring.begin());
  stored.tuning.damping = tuning.number("damping", 0.5, 1.5);
  if (state.has("adopted"))
    adopt_stored(state.object("adopted"), stored.model);
  stored.stand = stepped(stored.model, stored.tuning);
  if (!state.has("source"))
    return stored;
  const StoredObject from = state.object("source");
  LiveSource source;
  source.name        = from.text("name");
  source.rate        = from.number("rate", 1e-3, 1e9);
  source.start_time  = from.number("start", earliest_time, latest_time);
  source.places      = places_;
  stored.start_known = from.flag("start_known");
  if (from.has("file")) {
    const StoredObject file = from.object("file");
    stored.file             = SourceFile{file.text("print"), file.count("first", -largest_number, largest_number)};
  }
  std::vector<ChannelAccount> accounts;
  int forces = 0;
  for (const StoredObject &channel : state.list("channels", most_channels)) {
    source.channels.push_back({channel.text("name"), channel.text("unit")});
    source.factor.push_back(channel.number("factor", -any_size, any_size));
    accounts.push_back(stored_account(channel));
    forces += twin::is_driving_force(source.channels.back().name);
  }
  if (forces > 1)
    state.refuse("has more than one channel of the force");
  const std::int64_t next = state.count("next", -largest_number, largest_number);
  stored.book.emplace(Eigen::Index(accounts.size()));
  stored.book->resume(accounts, next, state.count("doubled", 0, largest_number),
                      state.count("gaps", 0, largest_number));
  stored.refused       = state.count("refused", 0, largest_number);
  stored.settled       = state.count("settled", -largest_number, 2 * largest_number);
  stored.stepped       = state.count("stepped", -largest_number, largest_number);
  stored.stepping      = state.flag("stepping");
  const double settles = settling_time(stored.stand) * source.rate;
  if (double(stored.settled) - double(stored.stepped) > settles + 1)
    state.refuse("has a \"settled\" that lies too far ahead");
  stored.stepper = std::make_unique<TwinStepper>(stored.stand, source.rate, 0);
  stored.source  = std::move(source);
  if (!stored.stepping)
    return stored;
  // no more rows than those whose force is not known yet are ever left behind
  if (stored.stepped > next || next - stored.stepped > most_bridged)
    state.refuse("has a \"stepped\" that does not go with its \"next\"");
  const StoredObject motion = state.object("motion");
  const auto unknowns       = stored.stand.shape.rows();
  const double most         = model_.detailed ? 1e4 : 10;  // kg^0.5 m of a mode, m of a mass
  stored.mean               = motion.number("mean", -any_size, any_size);
  stored.stepper->resume(motion.numbers("displacement", unknowns, -most, most),
                         motion.numbers("velocity", unknowns, -100 * most, 100 * most),
                         motion.number("reference", -any_size, any_size),
                         motion.number("force", -any_size, any_size));
  return stored;
}

void Engine::take_stored(Stored stored)
{
  model_  = std::move(stored.model);
  tuning_ = stored.tuning;
  stand_  = std::move(stored.stand);
  if (!stored.source)
    return;
  start_known_   = stored.start_known;
  file_          = std::move(stored.file);
  refused_lines_ = stored.refused;
  settled_at_    = stored.settled;
  stepped_       = stored.stepped;
  stepping_      = stored.stepping;
  mean_          = stored.mean;
  stepper_       = std::move(stored.stepper);
  source_        = std::move(stored.source);
  book_          = std::move(stored.book);
  resumed_at_    = book_->next();
  forget_        = -std::expm1(-1 / (source_->rate * mean_over));
  for (std::size_t c = 0; c < source_->channels.size(); ++c)
    if (twin::is_driving_force(source_->channels[c].name))
      force_column_ = Eigen::Index(c);
  // rows whose force was not known yet when this was stored: their numbers come again as missing
  const std::int64_t open = book_->next() - stepped_;
  if (stepping_ && open > 0) {
    waiting_.push_back(Eigen::MatrixXd::Constant(open, Eigen::Index(source_->channels.size()),
                                                 std::numeric_limits<double>::quiet_NaN()));
    n_waiting_     = open;
    first_waiting_ = stepped_;
  }
}

std::string Engine::resume(const nlohmann::json &state)
{
  Stored stored;
  try {
    const StoredObject head(state, "it");
    if (head.count("format", 0, 1 << 20) != state_format)
      return "the stored state is of another version of this program; the twin starts without it";
    if (const std::string hash = head.text("case_hash"); hash != model_.hash)
      return "the stored state belongs to another case, or to other values of this one; the twin starts without "
             "it";
    // a state without the name is of a program that knew six masses alone
    if (const std::string name = head.has("model") ? head.text("model") : "six-mass";
        name != name_of_model(model_))
      return fmt::format(
          "the stored state is of the model {}, the twin is of the model {}; it starts without the state", name,
          name_of_model(model_));
    stored = read_state(state);
  } catch (const std::exception &error) {  // also of a chain that its springs do not hold
    return fmt::format("the stored state cannot be used: {}; the twin starts without it", error.what());
  }
  take_stored(std::move(stored));
  std::string message;
  if (!model_.adopted.empty())
    message = fmt::format("springs and damping as adopted in {}; --fresh goes back to those of the case",
                          model_.adopted);
  if (!source_)
    return message;
  for (const auto &begun : hooks_.sources)
    begun(*source_);
  return fmt::format("{}{}goes on at s = {} of source \"{}\"", message, message.empty() ? "" : "\n", resumed_at_,
                     source_->name);
}
}  // namespace mill::live
