#include "twin/live/page/event_text.h"
#include "twin/web/server/json_writer.h"
#include <algorithm>
#include <cmath>

namespace mill::live {
using web::JsonWriter;
namespace {
constexpr int short_digits = 4;  // of what is only drawn

template <class T, class Write>
void list(JsonWriter &out, const char *name, const std::vector<T> &values, Write write)
{
  out.key(name).open('[');
  for (const T &value : values)
    write(value);
  out.close(']');
}

// [low, high, low, high, ..]
void traces(JsonWriter &out, const char *name, const std::vector<Trace> &values)
{
  list(out, name, values, [&](const Trace &trace) {
    out.open('[');
    for (std::size_t i = 0; i < trace.low.size() && i < trace.high.size(); ++i) {
      out.number(trace.low[i], short_digits);
      out.number(trace.high[i], short_digits);
    }
    out.close(']');
  });
}

// "measured":[rms, peak, crest]
void level(JsonWriter &out, const char *name, const double rms, const double peak, const double crest)
{
  out.member(name, std::vector<double>{rms, peak, crest}, 6);
}
}  // namespace

std::string stand_text(const PageStand &stand)
{
  JsonWriter out;
  out.open('{').member("name", stand.name).member("source", stand.source).member("version", stand.version);
  out.member("rate", stand.rate).member("strip_width", stand.strip_width).member("force_limit", stand.force_limit);
  out.member("amplitude_limit", stand.amplitude_limit);
  list(out, "places", stand.places, [&](const StandPlace &p) {
    out.open('{').member("place", p.place).member("label", p.label).member("mass", p.mass);
    out.member("diameter", p.diameter).member("length", p.length).flag("drawn", p.drawn);
    out.flag("measured", p.measured).close('}');
  });
  list(out, "springs", stand.springs, [&](const StandSpring &s) {
    out.open('{').member("key", s.key).member("value", s.value).whole("from", s.from).whole("to", s.to).close('}');
  });
  list(out, "modes", stand.modes, [&](const StandMode &m) {
    out.open('{').member("frequency", m.frequency).member("damping", m.damping).member("name", m.name).close('}');
  });
  list(out, "sliders", stand.sliders, [&](const StandSlider &s) {
    out.open('{').member("key", s.key).member("label", s.label).member("unit", s.unit);
    out.member("value", s.value).close('}');
  });
  return out.close('}').str();
}

Trace trace(const double *samples, const std::int64_t n, const int pieces)
{
  Trace out;
  const std::int64_t count = std::min<std::int64_t>(pieces, n);
  for (std::int64_t k = 0; k < count; ++k) {
    float low = NAN, high = NAN;  // of NaN and a number the comparison below takes the number
    for (std::int64_t i = k * n / count; i < (k + 1) * n / count; ++i) {
      const float value = float(samples[i]);
      if (!(low <= value) && !std::isnan(value))
        low = value;
      if (!(high >= value) && !std::isnan(value))
        high = value;
    }
    out.low.push_back(low);
    out.high.push_back(high);
  }
  return out;
}

std::string numbers_text(const PageNumbers &numbers)
{
  JsonWriter out;
  out.open('{').whole("s", numbers.s).member("utc", numbers.utc, 15).member("state", numbers.state);
  out.member("force", numbers.force).member("speed", numbers.speed).member("latency", numbers.latency, 4);
  out.member("displacement", numbers.displacement, 6).member("acceleration", numbers.acceleration, 6);
  traces(out, "measured", numbers.measured);
  traces(out, "simulated", numbers.simulated);
  return out.close('}').str();
}

std::string motion_text(const PageMotion &motion)
{
  JsonWriter out;
  out.open('{').member("utc", motion.utc, 15).member("step", motion.step);
  list(out, "displacement", motion.displacement, [&](const std::vector<float> &y) { out.floats(y); });
  return out.close('}').str();
}

std::string levels_text(const PageLevels &levels)
{
  JsonWriter out;
  out.open('{').member("utc", levels.utc, 15).member("seconds", levels.seconds);
  list(out, "places", levels.places, [&](const PlaceLevel &p) {
    out.open('{').member("place", p.place);
    level(out, "measured", p.measured_rms, p.measured_peak, p.measured_crest);
    level(out, "simulated", p.simulated_rms, p.simulated_peak, p.simulated_crest);
    out.member("baseline", p.baseline_rms, 6).member("ratio_db", p.ratio_db, 5);
    out.member("delay", p.delay, 6).member("delay_sd", p.delay_sd, 4);
    list(out, "incoherent", p.incoherent, [&](const BandShare &band) {
      out.open('[').number(band.frequency, 6).number(band.share, short_digits).close(']');
    });
    out.close('}');
  });
  return out.close('}').str();
}

std::string spectrum_text(const PageSpectrum &spectrum)
{
  JsonWriter out;
  out.open('{').member("place", spectrum.place).member("utc", spectrum.utc, 15).member("df", spectrum.df, 12);
  out.member("window", spectrum.window).whole("segments", spectrum.segments).member("enbw", spectrum.enbw);
  out.floats("measured", spectrum.measured).floats("simulated", spectrum.simulated);
  out.floats("latest", spectrum.latest);
  out.member("wave_step", spectrum.wave_step).floats("wave_measured", spectrum.wave_measured);
  out.floats("wave_simulated", spectrum.wave_simulated);
  return out.close('}').str();
}

std::string account_text(const PageAccount &account)
{
  JsonWriter out;
  out.open('{').member("utc", account.utc, 15).member("source", account.source);
  out.flag("connected", account.connected).member("queue", account.queue, 4);
  out.member("queue_limit", account.queue_limit, 4).member("recording", account.recording);
  out.member("recorded", account.recorded).member("trouble", account.trouble).member("load", account.load, 4);
  out.whole("forgotten", account.forgotten);
  list(out, "channels", account.channels, [&](const AccountRow &row) {
    out.open('{').member("channel", row.channel).whole("offered", row.offered).whole("processed", row.processed);
    out.whole("missing", row.missing).whole("rejected", row.rejected).whole("overrun", row.overrun).close('}');
  });
  return out.close('}').str();
}

std::string modes_text(const PageModes &modes)
{
  JsonWriter out;
  out.open('{').member("utc", modes.utc, 15);
  list(out, "modes", modes.modes, [&](const PageMode &m) {
    out.open('{').member("name", m.name).member("twin", m.twin_frequency).member("measured", m.measured);
    out.member("sd", m.sd, 4).member("deviation", m.deviation, 4).member("up", m.up, 4).member("down", m.down, 4);
    out.member("limit", m.limit, 4).member("state", m.state).member("because", m.because).close('}');
  });
  return out.close('}').str();
}

std::string chatter_text(const PageChatter &chatter)
{
  JsonWriter out;
  out.open('{').member("utc", chatter.utc, 15).member("speed", chatter.speed).member("critical", chatter.critical);
  out.member("low", chatter.low).member("high", chatter.high).member("distance", chatter.distance, 6);
  out.member("growth", chatter.growth, 6).member("growth_limit", chatter.growth_limit);
  out.member("alarm_ratio", chatter.alarm_ratio).member("because", chatter.because);
  list(out, "bands", chatter.bands, [&](const ChatterBand &b) {
    out.open('{').member("name", b.name).member("frequency", b.frequency).member("amplitude", b.amplitude, 6);
    out.member("baseline", b.baseline, 6).member("growth", b.growth, 6).member("growth_high", b.growth_high, 6);
    out.member("state", b.state).close('}');
  });
  return out.close('}').str();
}

std::string alarm_text(const PageAlarm &alarm)
{
  JsonWriter out;
  out.open('{').whole("id", alarm.id).member("utc", alarm.utc, 15).member("kind", alarm.kind);
  out.member("text", alarm.text).member("level", alarm.level).flag("acknowledged", alarm.acknowledged);
  return out.flag("over", alarm.over).close('}').str();
}

std::string proposal_text(const PageProposal &proposal)
{
  JsonWriter out;
  out.open('{').whole("id", proposal.id).member("utc", proposal.utc, 15).member("text", proposal.text);
  out.member("state", proposal.state).member("file", proposal.file);
  list(out, "values", proposal.values, [&](const ProposedValue &v) {
    out.open('{').member("key", v.key).member("unit", v.unit).member("from", v.from).member("to", v.to);
    out.member("low", v.low).member("high", v.high).flag("identified", v.identified).close('}');
  });
  return out.close('}').str();
}

std::string parameters_text(const PageParameters &parameters)
{
  JsonWriter out;
  out.open('{').member("origin", parameters.origin).member("place", parameters.place);
  list(out, "sliders", parameters.sliders,
       [&](const ParameterNow &p) { out.open('{').member("key", p.key).member("factor", p.factor).close('}'); });
  return out.member("frequencies", parameters.frequencies).close('}').str();
}

std::string advice_text(const PageAdvice &advice)
{
  JsonWriter out;
  out.open('{').member("utc", advice.utc, 15).member("state", advice.state).member("goal", advice.goal);
  out.member("text", advice.text);
  list(out, "rows", advice.rows, [&](const AdviceRow &row) {
    out.open('{').member("action", row.action).member("change", row.change, 6);
    out.member("first_order", row.first_order, 6)
        .member("cost", row.cost)
        .member("side_effects", row.side_effects);
    out.member("mark", row.mark).member("against", row.against).close('}');
  });
  return out.close('}').str();
}
}  // namespace mill::live
