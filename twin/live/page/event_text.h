#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

// Events of the page as plain structs, and their JSON texts, which docs/live-page.md describes.
// who read them.  SI everywhere; NaN means unknown and becomes null.
namespace mill::live {
/// Names of the events, written once.
namespace event_names {
constexpr const char *numbers    = "numbers";     ///< 20 Hz
constexpr const char *motion     = "motion";      ///< 1 Hz at most
constexpr const char *levels     = "levels";      ///< 1 Hz
constexpr const char *spectrum   = "spectrum";    ///< 4 Hz
constexpr const char *account    = "account";     ///< 1 Hz
constexpr const char *modes      = "modes";       ///< every 10 s
constexpr const char *chatter    = "chatter";     ///< 1 Hz
constexpr const char *alarm      = "alarm";       ///< when it happens, and again when it is acknowledged or over
constexpr const char *proposal   = "proposal";    ///< when it happens, and again when it is adopted or out of date
constexpr const char *parameters = "parameters";  ///< at the start and after every change
constexpr const char *advice     = "advice";      ///< on demand
}  // namespace event_names

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// /stand: what does not change while the program runs ------------------------------------------------------------
struct StandPlace {
  std::string place;          ///< "upper_work_roll", as in records
  std::string label;          ///< "upper work roll"
  double mass     = unknown;  ///< kg
  double diameter = unknown;  ///< m; NaN: drawn as a block (frame) or by its mass
  double length   = unknown;  ///< m, of the barrel
  bool measured   = false;    ///< the source has a channel of this name
  bool drawn      = true;     ///< one of the six of the picture; false: another place of a detailed stand
};
struct StandSpring {
  std::string key;    ///< "K3"
  double value = 0;   ///< N/m, of the model; 0: not part of this chain
  int from     = -1;  ///< index of a place; -1: ground
  int to       = -1;
};
struct StandMode {
  double frequency = 0;  ///< Hz, of the model
  double damping   = 0;  ///< -, ratio of critical
  std::string name;      ///< "third octave", may be empty
};
/// A parameter that may be changed on the run between 0.5 and 1.5 times the model's own value.
struct StandSlider {
  std::string key;    ///< "K1".."K7", "damping"
  std::string label;  ///< "upper roll contact"
  std::string unit;   ///< "N/m", "-"
  double value = 0;   ///< the model's own, in that unit
};
struct PageStand {
  std::string name;                  ///< of the case
  std::string source;                ///< what the model was made from: "six masses as given"
  std::string version;               ///< of the program
  double rate            = 0;        ///< Hz, of the samples
  double strip_width     = unknown;  ///< m
  double force_limit     = unknown;  ///< N, of the case
  double amplitude_limit = unknown;  ///< m/s2, 0-peak in a band, own limit of the mill; NaN: none
  std::vector<StandPlace> places;
  std::vector<StandSpring> springs;
  std::vector<StandMode> modes;
  std::vector<StandSlider> sliders;
};
std::string stand_text(const PageStand &stand);

// Events ---------------------------------------------------------------------------------------------------------
/// Lowest and highest value in each of at most 32 equal pieces of time: no vibration is lost between the points.
struct Trace {
  std::vector<float> low, high;  ///< m/s2
};
/// Trace of n samples in at most `pieces` pieces; NaN samples are skipped, a piece of NaN alone is NaN.
Trace trace(const double *samples, std::int64_t n, int pieces = 32);

struct PageNumbers {
  std::int64_t s    = 0;             ///< number of the last sample
  double utc        = 0;             ///< s since 1970, of that sample
  std::string state = "waiting";     ///< running, settling, gap, waiting
  double force      = unknown;       ///< N, mean since the last event
  double speed      = unknown;       ///< m/s
  double latency    = unknown;       ///< s, from the last sample in to this event
  std::vector<double> displacement;  ///< (places) m, of the model, from its mean state, up
  std::vector<double> acceleration;  ///< (places) m/s2, of the model, rms since the last event
  std::vector<Trace> measured;       ///< (places) since the last event; empty traces where nothing is measured
  std::vector<Trace> simulated;      ///< (places)
};
std::string numbers_text(const PageNumbers &numbers);

/// A short piece of the model's motion that the page plays slowly.
struct PageMotion {
  double utc  = 0;                               ///< s since 1970, of the first instant
  double step = 0;                               ///< s between instants; 1/4000 s shows modes up to 1 kHz
  std::vector<std::vector<float>> displacement;  ///< (places) of (instants, at most 256) m, up
};
std::string motion_text(const PageMotion &motion);

struct BandShare {
  double frequency = 0;        ///< Hz, centre of a third octave
  double share     = unknown;  ///< -, part of the measured that is not coherent with the simulated
};
struct PlaceLevel {
  std::string place;
  double measured_rms = unknown, measured_peak = unknown, measured_crest = unknown;     ///< m/s2, m/s2, -
  double simulated_rms = unknown, simulated_peak = unknown, simulated_crest = unknown;  ///< m/s2, m/s2, -
  double baseline_rms = unknown;  ///< m/s2, measured while the mill was calm
  double ratio_db     = unknown;  ///< dB, measured over simulated
  double delay        = unknown;  ///< s, measured behind simulated
  double delay_sd     = unknown;  ///< s
  std::vector<BandShare> incoherent;
};
struct PageLevels {
  double utc     = 0;  ///< s since 1970
  double seconds = 1;  ///< s of record behind each number
  std::vector<PlaceLevel> places;
};
std::string levels_text(const PageLevels &levels);

/// One-sided amplitude density of one place; at most 1024 points from 0 on.
struct PageSpectrum {
  std::string place;
  double utc         = 0;        ///< s since 1970
  double df          = 0;        ///< Hz between points
  std::string window = "Hann";   ///< by name
  int segments       = 1;        ///< averaged
  double enbw        = 0;        ///< Hz, equivalent noise bandwidth
  std::vector<float> measured;   ///< m/s2 per sqrt(Hz); empty: not measured
  std::vector<float> simulated;  ///< m/s2 per sqrt(Hz)
  std::vector<float> latest;     ///< the same of the last piece alone, of what is measured, else simulated
  double wave_step = 0;          ///< s between the points of the waves; 0: none
  std::vector<float> wave_measured, wave_simulated;  ///< m/s2, at most 512 consecutive samples
};
std::string spectrum_text(const PageSpectrum &spectrum);

struct AccountRow {
  std::string channel;
  std::int64_t offered = 0, processed = 0, missing = 0, rejected = 0, overrun = 0;
};
struct PageAccount {
  double utc = 0;      ///< s since 1970
  std::string source;  ///< "file pass-1.csv", "tcp 127.0.0.1:8461, daq-1"
  bool connected     = false;
  double queue       = 0;            ///< s of samples waiting
  double queue_limit = 2;            ///< s
  std::string recording;             ///< folder; empty: not recorded
  double recorded = 0;               ///< s of record on the disk
  std::string trouble;               ///< "disk full: recording stopped"; empty: none
  double load            = unknown;  ///< -, share of one core
  std::int64_t forgotten = 0;        ///< alarms and proposals that are over and not kept any more
  std::vector<AccountRow> channels;
};
std::string account_text(const PageAccount &account);

struct PageMode {
  std::string name;                 ///< "third octave"; empty: by number
  double twin_frequency = 0;        ///< Hz, of the twin at the present load
  double measured       = unknown;  ///< Hz
  double sd             = unknown;  ///< Hz
  double deviation      = unknown;  ///< -, (measured - twin) / sd
  double up = 0, down = 0;          ///< -, CUSUM
  double limit = 12;                ///< -, of CUSUM
  std::string state;                ///< calm, drifting, drifted, not identified, no data
  std::string because;              ///< one sentence, may be empty
};
struct PageModes {
  double utc = 0;               ///< s since 1970
  std::vector<PageMode> modes;  ///< in the order of the modes of the stand
};
std::string modes_text(const PageModes &modes);

struct ChatterBand {
  std::string name;              ///< "third octave"
  double frequency   = unknown;  ///< Hz
  double amplitude   = unknown;  ///< m/s2, 0-peak, of the envelope
  double baseline    = unknown;  ///< m/s2
  double growth      = unknown;  ///< 1/s, negative: dies away
  double growth_high = unknown;  ///< 1/s, upper end of its 95 % interval
  std::string state;             ///< calm, warning, alarm, unknown
};
struct PageChatter {
  double utc      = 0;                   ///< s since 1970
  double speed    = unknown;             ///< m/s, of the mill
  double critical = unknown;             ///< m/s, computed
  double low = unknown, high = unknown;  ///< m/s, interval of the critical speed
  double distance     = unknown;         ///< -, (critical - speed) / speed
  double growth       = unknown;         ///< 1/s, of the least damped band
  double growth_limit = -0.5;            ///< 1/s, warning above
  double alarm_ratio  = 5;               ///< -, amplitude over baseline
  std::string because;                   ///< why the critical speed is not known; empty when it is
  std::vector<ChatterBand> bands;
};
std::string chatter_text(const PageChatter &chatter);

struct PageAlarm {
  std::int64_t id = 0;  ///< an event with the same id replaces the earlier one
  double utc      = 0;  ///< s since 1970, when it began
  std::string kind;     ///< "chatter", "drift", "gap", "recording", "source"
  std::string text;     ///< one sentence
  std::string level;    ///< note, warning, alarm
  bool acknowledged = false;
  bool over         = false;  ///< its cause is gone
};
std::string alarm_text(const PageAlarm &alarm);

struct ProposedValue {
  std::string key;                       ///< "K3"
  std::string unit;                      ///< "N/m"
  double from = unknown, to = unknown;   ///< in that unit
  double low = unknown, high = unknown;  ///< 95 % interval of `to`
  bool identified = true;                ///< by the data
};
struct PageProposal {
  std::int64_t id = 0;
  double utc      = 0;         ///< s since 1970
  std::string text;            ///< what happened and what is proposed
  std::string state = "open";  ///< open, adopted, out of date
  std::string file;            ///< written when adopted
  std::vector<ProposedValue> values;
};
std::string proposal_text(const PageProposal &proposal);

struct ParameterNow {
  std::string key;    ///< of a slider
  double factor = 1;  ///< -, times the model's own value
};
struct PageParameters {
  std::string origin;  ///< "the case", "calibrated-....toml"
  std::vector<ParameterNow> sliders;
  std::vector<double> frequencies;  ///< (modes) Hz, of the twin as it now stands
  std::string place;                ///< whose spectrum is sent
};
std::string parameters_text(const PageParameters &parameters);

struct AdviceRow {
  std::string action;            ///< "oil viscosity x 0.8"
  double change      = unknown;  ///< -, of the goal, simulated again: -0.186
  double first_order = unknown;  ///< -, the same by slopes
  std::string cost;              ///< "speed -5 %"; empty: none
  std::string side_effects;      ///< "force +10.8 %"
  std::string mark;              ///< "chain only", "rests on K2, not identified"
  std::string against;           ///< reason why it is below the line; empty: allowed
};
struct PageAdvice {
  double utc        = 0;       ///< s since 1970
  std::string state = "done";  ///< computing, done, failed
  std::string goal;            ///< "rms of the upper work roll, 100 .. 1000 Hz"
  std::string text;            ///< what has to be said to all rows
  std::vector<AdviceRow> rows;
};
std::string advice_text(const PageAdvice &advice);
}  // namespace mill::live
