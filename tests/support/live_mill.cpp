#include "tests/support/live_mill.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "tests/support/published_stand.h"
#include "twin/spectra/fourier.h"
#include <algorithm>
#include <cmath>
#include <ctime>
#include <unsupported/Eigen/MatrixFunctions>

namespace live = mill::live;

namespace {
constexpr int second                    = int(LiveMill::rate);
constexpr double w0                     = 2 * M_PI * 300;  // 1/s: brings displacements to the size of velocities
const char *const names[]               = {"upper_frame",     "upper_backup_roll", "upper_work_roll",
                                           "lower_work_roll", "lower_backup_roll", "lower_frame"};
const char *const what[]                = {"frame, upper", "backup bearing, upper", "roll contact, upper",
                                           "strip",        "roll contact, lower",   "backup bearing, lower",
                                           "frame, lower", "modal damping"};
constexpr std::size_t measured_places[] = {2, 3};

double uniform(std::uint64_t &state)  // splitmix64, upper 53 bits
{
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z               = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z               = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return double((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

bool is_measured(const std::size_t place)
{
  return place == measured_places[0] || place == measured_places[1];
}

double rms(const std::vector<double> &values)
{
  double sum = 0;
  for (const double value : values)
    sum += value * value;
  return std::sqrt(sum / double(std::max<std::size_t>(1, values.size())));
}

double peak(const std::vector<double> &values)
{
  double largest = 0;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  return largest;
}

// Lines at whole frequencies, equal amplitudes, phases at random: 5 .. 1000 Hz, 9 kN rms in all.
std::vector<double> made_force()
{
  std::vector<std::complex<double>> lines(second);
  std::uint64_t seed = 20260105;
  for (int f = 5; f <= 1000; ++f) {
    lines[std::size_t(f)]          = std::polar(0.5 * second * 400, 2 * M_PI * uniform(seed));
    lines[std::size_t(second - f)] = std::conj(lines[std::size_t(f)]);
  }
  std::vector<std::complex<double>> samples;
  mill::twin::Fourier().inverse(lines, samples);
  std::vector<double> force;
  for (const auto &sample : samples)
    force.push_back(976000 + sample.real());
  return force;
}

mill::dynamics::MillModel chain(const Eigen::VectorXd &M, const Eigen::VectorXd &K, const double damping)
{
  auto set = parameter_set("R1");
  for (std::size_t i = 0; i < 6; ++i)
    set.stand.M[i].value = M[Eigen::Index(i)];
  for (std::size_t i = 0; i < 7; ++i)
    set.stand.K[i].value = K[Eigen::Index(i)];
  set.dynamics.modal_damping = damping;
  return mill::dynamics::mill_model(set.stand, set.dynamics);
}
}  // namespace

LiveMill::LiveMill(const double damping) : damping_(damping), M_(6), K_(7), begin_(double(std::time(nullptr)))
{
  const auto set = parameter_set("R1");
  for (std::size_t i = 0; i < 6; ++i)
    M_[Eigen::Index(i)] = set.stand.M[i].value;
  for (std::size_t i = 0; i < 7; ++i)
    K_[Eigen::Index(i)] = set.stand.K[i].value;
  factor_.fill(1);
  force_ = made_force();
  simulated_.assign(6, std::vector<double>(second, 0));
  measured_.assign(6, std::vector<double>(second, 0));
  slow_.resize(6);
  Eigen::VectorXd softer = K_;
  softer[2] *= 0.97;  // the mill is not quite its twin
  build(mill_, softer);
  build(twin_, K_);
  const auto model              = chain(M_, K_, damping_);
  const Eigen::VectorXd at_rest = model.K.ldlt().solve(model.b) * force_[0];
  twin_.state                   = Eigen::VectorXd::Zero(12);
  twin_.state.head(6)           = w0 * at_rest;
  mill_.state                   = twin_.state;
}

// Exact over one sample while the force runs straight: exponential of the model with the force as two more states.
void LiveMill::build(Model &model, const Eigen::VectorXd &K) const
{
  const auto made           = chain(M_, K, damping_ * factor_[7]);
  const double h            = 1 / rate;
  const Eigen::MatrixXd inv = made.M.cwiseInverse().asDiagonal();
  Eigen::MatrixXd A         = Eigen::MatrixXd::Zero(14, 14);
  A.block(0, 6, 6, 6)       = Eigen::MatrixXd::Identity(6, 6) * w0 * h;
  A.block(6, 0, 6, 6)       = -inv * made.K / w0 * h;
  A.block(6, 6, 6, 6)       = -inv * made.C * h;
  A.block(6, 12, 6, 1)      = inv * made.b * h;
  A(12, 13)                 = 1;
  model.step                = A.exp();
  model.acceleration        = A.block(6, 0, 6, 13) / h;
}

Eigen::VectorXd LiveMill::stiffness() const
{
  Eigen::VectorXd K = K_;
  for (Eigen::Index j = 0; j < 7; ++j)
    K[j] *= factor_[std::size_t(j)];
  return K;
}

Eigen::VectorXd LiveMill::frequencies() const
{
  return mill::dynamics::modes(chain(M_, stiffness(), damping_)).frequency;
}

live::PageStand LiveMill::stand() const
{
  live::PageStand out;
  out.name                = "four-high 1400";
  out.source              = "six masses as given";
  out.version             = "test";
  out.rate                = rate;
  const double diameter[] = {live::unknown, 1.45, 0.42, 0.42, 1.45, live::unknown};
  const auto model        = chain(M_, K_, damping_);
  for (std::size_t i = 0; i < 6; ++i)
    out.places.push_back({names[i], model.labels[i], M_[Eigen::Index(i)], diameter[i], 1.4, is_measured(i)});
  for (const auto &spring : model.springs)
    out.springs.push_back({spring.name, spring.stiffness, spring.from, spring.to});
  const auto modes           = frequencies();
  const char *const called[] = {"stand",        "backup rolls", "third octave", "work rolls, in phase",
                                "fifth octave", "work rolls"};
  for (Eigen::Index i = 0; i < modes.size(); ++i)
    out.modes.push_back({modes[i], damping_, called[i]});
  for (std::size_t j = 0; j < 7; ++j)
    if (j != 3)
      out.sliders.push_back({"K" + std::to_string(j + 1), what[j], "N/m", K_[Eigen::Index(j)]});
  out.sliders.push_back({"damping", what[7], "-", damping_});
  return out;
}

void LiveMill::advance(const double seconds)
{
  Eigen::VectorXd extended(14);
  for (auto n = std::int64_t(std::llround(seconds * rate)); n > 0; --n) {
    const auto index = std::size_t(s_ % second), next = std::size_t((s_ + 1) % second);
    for (Model *model : {&twin_, &mill_}) {
      extended << model->state, force_[index], force_[next] - force_[index];
      model->state = (model->step * extended).head(12);
    }
    ++s_;
    Eigen::VectorXd twin(13), mill(13);
    twin << twin_.state, force_[next];
    mill << mill_.state, force_[next];
    const Eigen::VectorXd a = twin_.acceleration * twin, b = mill_.acceleration * mill;
    for (std::size_t i = 0; i < 6; ++i) {
      simulated_[i][next] = a[Eigen::Index(i)];
      measured_[i][next]  = b[Eigen::Index(i)] + 0.2 * (uniform(noise_) - 0.5);
      if (s_ % 10 == 0)
        slow_[i].push_back(float((twin_.state[Eigen::Index(i)]) / w0));
      if (slow_[i].size() > 120)
        slow_[i].erase(slow_[i].begin());
    }
  }
}

void LiveMill::tell(const Tell &to)
{
  tell_numbers(to);
  const int turn = turn_++;
  if (turn % 5 == 0)
    tell_spectrum(to);
  if (turn % 20 == 0) {
    tell_levels(to);
    tell_account(to);
    tell_chatter(to);
    tell_motion(to);
  }
  if (turn % 200 == 0)
    tell_modes(to);
  if (changed_)
    tell_parameters(to);
  changed_ = false;
}

void LiveMill::tell_all(const Tell &to)
{
  turn_    = 0;
  changed_ = true;
  tell(to);
}

void LiveMill::tell_numbers(const Tell &to)
{
  live::PageNumbers out;
  const auto n = std::min<std::int64_t>(s_ - sent_, second);
  out.s        = s_;
  out.utc      = begin_ + double(s_) / rate;
  out.state    = "running";
  out.speed    = 14.62;
  out.latency  = 0.012;
  out.force    = 0;
  const Eigen::VectorXd rest =
      w0 * (chain(M_, stiffness(), damping_).K.ldlt().solve(chain(M_, K_, damping_).b) * 976000);
  for (std::size_t i = 0; i < 6; ++i) {
    std::vector<double> simulated, measured;
    for (auto k = s_ - n + 1; k <= s_; ++k) {
      simulated.push_back(simulated_[i][std::size_t(k % second)]);
      measured.push_back(measured_[i][std::size_t(k % second)]);
      out.force += i == 0 ? force_[std::size_t(k % second)] / double(n) : 0;
    }
    out.displacement.push_back((twin_.state[Eigen::Index(i)] - rest[Eigen::Index(i)]) / w0);
    out.acceleration.push_back(rms(simulated));
    out.simulated.push_back(live::trace(simulated.data(), n));
    out.measured.push_back(is_measured(i) ? live::trace(measured.data(), n) : live::Trace{});
  }
  if (!held.empty())
    out.displacement = held;
  sent_ = s_;
  to(live::event_names::numbers, live::numbers_text(out));
}

void LiveMill::tell_motion(const Tell &to)
{
  live::PageMotion out{begin_ + double(s_) / rate, 10 / rate, slow_};
  for (auto &place : out.displacement) {
    float mean = 0;
    for (const float y : place)
      mean += y / float(place.size());
    for (float &y : place)
      y -= mean;
  }
  to(live::event_names::motion, live::motion_text(out));
}

void LiveMill::tell_levels(const Tell &to)
{
  live::PageLevels out;
  out.utc = begin_ + double(s_) / rate;
  for (std::size_t i = 0; i < 6; ++i) {
    live::PlaceLevel level;
    level.place           = names[i];
    level.simulated_rms   = rms(simulated_[i]);
    level.simulated_peak  = peak(simulated_[i]);
    level.simulated_crest = level.simulated_peak / level.simulated_rms;
    if (is_measured(i)) {
      level.measured_rms   = rms(measured_[i]);
      level.measured_peak  = peak(measured_[i]);
      level.measured_crest = level.measured_peak / level.measured_rms;
      level.baseline_rms   = level.measured_rms / (1.1 + 0.15 * std::sin(double(s_) / rate / 7));
      level.ratio_db       = 20 * std::log10(level.measured_rms / level.simulated_rms);
      level.delay          = 0.00012;
      level.delay_sd       = 0.00002;
      for (int k = -8; k <= 17; ++k)
        level.incoherent.push_back({100 * std::pow(2, k / 3.0), 0.04 + 0.3 / (1 + std::pow((k - 11) / 2.0, 2))});
    }
    out.places.push_back(level);
  }
  to(live::event_names::levels, live::levels_text(out));
}

std::vector<float> LiveMill::spectrum_of(const std::vector<std::vector<double>> &history,
                                         const std::size_t place) const
{
  std::vector<std::complex<double>> lines;
  mill::twin::Fourier().forward(history[place], lines);
  std::vector<float> out;
  for (std::size_t k = 0; k < 1024; ++k)  // amplitude density of one second without a window
    out.push_back(float(std::abs(lines[k]) * std::sqrt(2.0) / second));
  return out;
}

void LiveMill::tell_spectrum(const Tell &to)
{
  live::PageSpectrum out;
  out.place     = names[place_];
  out.utc       = begin_ + double(s_) / rate;
  out.df        = 1;
  out.window    = "none";
  out.enbw      = 1;
  out.simulated = spectrum_of(simulated_, place_);
  out.latest    = is_measured(place_) ? spectrum_of(measured_, place_) : out.simulated;
  out.wave_step = 1 / rate;
  for (auto k = s_ - 511; k <= s_; ++k)
    out.wave_simulated.push_back(float(simulated_[place_][std::size_t((k + second) % second)]));
  if (is_measured(place_)) {
    out.measured = spectrum_of(measured_, place_);
    for (auto k = s_ - 511; k <= s_; ++k)
      out.wave_measured.push_back(float(measured_[place_][std::size_t((k + second) % second)]));
  }
  to(live::event_names::spectrum, live::spectrum_text(out));
}

void LiveMill::tell_account(const Tell &to)
{
  live::PageAccount out;
  out.utc       = begin_ + double(s_) / rate;
  out.source    = "tcp 127.0.0.1:8461, daq-1";
  out.connected = true;
  out.queue     = 0.02;
  out.recording = "rec";
  out.recorded  = double(s_) / rate;
  out.load      = 0.021;
  for (const char *channel : {"force", "upper_work_roll", "lower_work_roll", "speed"})
    out.channels.push_back({channel, s_ + 60, s_, 40, 20, 0});
  to(live::event_names::account, live::account_text(out));
}

void LiveMill::tell_modes(const Tell &to)
{
  live::PageModes out;
  out.utc         = begin_ + double(s_) / rate;
  const auto twin = frequencies();
  const auto page = stand();
  for (std::size_t i = 0; i < 6; ++i) {
    live::PageMode mode;
    mode.name           = page.modes[i].name;
    mode.twin_frequency = twin[Eigen::Index(i)];
    if (i == 1) {
      mode.state   = "not identified";
      mode.because = "";
    } else {
      mode.sd        = 0.0008 * mode.twin_frequency;
      mode.deviation = i == 4 ? -4.2 : i == 5 ? -2.3 : 0.3 * double(i) - 0.5;
      mode.measured  = mode.twin_frequency + mode.deviation * mode.sd;
      mode.down      = i == 4 ? 13.1 : i == 5 ? 6.2 : 0.4;
      mode.up        = i < 4 ? 0.8 : 0;
      mode.state     = i == 4 ? "drifted" : i == 5 ? "drifting" : "calm";
    }
    out.modes.push_back(mode);
  }
  to(live::event_names::modes, live::modes_text(out));
}

void LiveMill::tell_chatter(const Tell &to)
{
  live::PageChatter out;
  out.utc      = begin_ + double(s_) / rate;
  out.speed    = 14.62;
  out.critical = 18.2;
  out.low      = 17.1;
  out.high     = 19.4;
  out.distance = out.critical / out.speed - 1;
  out.growth   = -1.85;
  out.bands    = {{"third octave", 218.3, 0.31, 0.26, -1.85, -1.42, "calm"},
                  {"fifth octave", 611.7, 0.2, 0.19, -6.1, -5.2, "calm"}};
  if (!held_bands.empty())
    out.bands = held_bands;
  to(live::event_names::chatter, live::chatter_text(out));
}

void LiveMill::tell_parameters(const Tell &to)
{
  live::PageParameters out;
  out.origin      = "the case";
  out.place       = names[place_];
  const auto now  = frequencies();
  out.frequencies = {now.data(), now.data() + now.size()};
  for (const auto &slider : stand().sliders)
    out.sliders.push_back({slider.key, factor_[slider.key == "damping" ? 7 : std::size_t(slider.key[1] - '1')]});
  to(live::event_names::parameters, live::parameters_text(out));
}

void LiveMill::take(const live::PageCommand &command)
{
  if (command.kind == live::PageCommandKind::set)
    factor_[command.key == "damping" ? 7 : std::size_t(command.key.at(1) - '1')] = command.factor;
  if (command.kind == live::PageCommandKind::reset)
    factor_.fill(1);
  for (std::size_t i = 0; i < 6; ++i)
    if (command.kind == live::PageCommandKind::place && command.place == names[i])
      place_ = i;
  build(twin_, stiffness());
  changed_ = true;
}
