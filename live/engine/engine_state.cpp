#include "live/engine/engine.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

// What of the engine is stored, and read again.
namespace mill::live {
namespace {
using Json = nlohmann::json;

Json numbers(const Eigen::VectorXd &values)
{
  return std::vector<double>(values.begin(), values.end());
}

Eigen::VectorXd vector_of(const Json &json)
{
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

Json channels_json(const LiveSource &source, const AccountBook &book)
{
  Json list = Json::array();
  for (std::size_t c = 0; c < source.channels.size(); ++c) {
    const ChannelAccount &a = book.channels()[c];
    list.push_back({
        {"name",    source.channels[c].name                                   },
        {"unit",    source.channels[c].unit                                   },
        {"factor",  source.factor[c]                                          },
        {"account", {a.offered, a.processed, a.missing, a.rejected, a.overrun}}
    });
  }
  return list;
}
}  // namespace

nlohmann::json Engine::state()
{
  flush();
  Json state{
      {"format",    1          },
      {"case_hash", model_.hash}
  };
  state["tuning"] = {
      {"spring",  tuning_.spring },
      {"damping", tuning_.damping}
  };
  if (!source_ || !book_->begun() || book_->next() == std::numeric_limits<std::int64_t>::min())
    return state;
  state["source"] = {
      {"name",        source_->name      },
      {"rate",        source_->rate      },
      {"start",       source_->start_time},
      {"start_known", start_known_       }
  };
  state["channels"] = channels_json(*source_, *book_);
  state["next"]     = book_->next();
  state["doubled"]  = book_->doubled();
  state["gaps"]     = book_->gaps();
  state["refused"]  = refused_lines_;
  state["stepping"] = stepping_;
  state["settled"]  = settled_at_;
  state["stepped"]  = stepped_;
  if (stepping_)
    state["motion"] = {
        {"displacement", numbers(stepper_->displacement())},
        {"velocity",     numbers(stepper_->velocity())    },
        {"reference",    stepper_->reference()            },
        {"force",        stepper_->last_force()           },
        {"mean",         mean_                            }
    };
  return state;
}

std::string Engine::resume(const nlohmann::json &state)
{
  try {
    if (state.at("format") != 1)
      return "the stored state is of another version of this program; the twin starts anew";
    if (state.at("case_hash") != model_.hash)
      return "the stored state belongs to another case, or to other values of this one; the twin starts anew";
    if (!state.contains("source"))
      return "";
    Tuning tuning;
    state.at("tuning").at("spring").get_to(tuning.spring);
    tuning.damping = state.at("tuning").at("damping");
    LiveSource source;
    source.name       = state.at("source").at("name");
    source.rate       = state.at("source").at("rate");
    source.start_time = state.at("source").at("start");
    source.places     = places_;
    std::vector<ChannelAccount> accounts;
    for (const Json &channel : state.at("channels")) {
      source.channels.push_back({channel.at("name"), channel.at("unit")});
      source.factor.push_back(channel.at("factor"));
      const auto a = channel.at("account").get<std::array<std::int64_t, 5>>();
      accounts.push_back({a[0], a[1], a[2], a[3], a[4]});
    }
    AccountBook book(Eigen::Index(accounts.size()));
    book.resume(accounts, state.at("next"), state.at("doubled"), state.at("gaps"));
    const dynamics::MillModel chain = tuned(model_, tuning);
    auto stepper                    = std::make_unique<TwinStepper>(chain, source.rate, 0);
    if (state.at("stepping").get<bool>()) {
      const Json &motion = state.at("motion");
      stepper->resume(vector_of(motion.at("displacement")), vector_of(motion.at("velocity")),
                      motion.at("reference"), motion.at("force"));
      mean_ = motion.at("mean");
    }
    start_known_   = state.at("source").at("start_known");
    refused_lines_ = state.at("refused");
    settled_at_    = state.at("settled");
    stepped_       = state.at("stepped");
    stepping_      = state.at("stepping");
    tuning_        = tuning;
    chain_         = chain;
    stepper_       = std::move(stepper);
    forget_        = -std::expm1(-1 / source.rate);
    for (std::size_t c = 0; c < source.channels.size(); ++c)
      if (source.channels[c].name == "force")
        force_column_ = Eigen::Index(c);
    source_     = std::move(source);
    book_       = std::move(book);
    resumed_at_ = book_->next();
    // rows whose force was not known yet when this was stored: their numbers come again as missing
    const std::int64_t open = book_->next() - stepped_;
    if (stepping_ && open > 0) {
      waiting_.push_back(Eigen::MatrixXd::Constant(open, Eigen::Index(source_->channels.size()),
                                                   std::numeric_limits<double>::quiet_NaN()));
      n_waiting_     = open;
      first_waiting_ = stepped_;
    }
    for (const auto &begun : hooks_.sources)
      begun(*source_);
    return fmt::format("goes on at s = {} of source \"{}\"", resumed_at_, source_->name);
  } catch (const Json::exception &) {
    return "the stored state cannot be read; the twin starts anew";
  }
}
}  // namespace mill::live
