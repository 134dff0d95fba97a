#include "dynamics/exchange/matlab.h"
#include "core/records/mat_file.h"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
std::string upper_case(std::string text)
{
  for (char &c : text)
    c = char(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// One line of a comment.
std::string one_line(std::string text)
{
  std::replace_if(
      text.begin(), text.end(), [](const char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

// Doubled braces are one brace of fmt.
constexpr const char *body = R"(  folder = fileparts(mfilename('fullpath'));
  model = load(fullfile(folder, '{0}.mat'));
  n = size(model.M, 1);
  m = size(model.point, 1);
  stiffness = model.M \ model.K;
  damping = model.M \ model.C;
  model.first_order.A = [zeros(n), eye(n); -stiffness, -damping];
  model.first_order.B = [zeros(n, 1); model.M \ model.b];
  model.first_order.C = [-model.point * [stiffness, damping]; model.point, zeros(m, n); model.load_cell', zeros(1, n)];
  model.first_order.D = [model.point * (model.M \ model.b); zeros(m + 1, 1)];
  if nargin == 0
    return
  end
  time = time(:);
  force = force(:) - model.F_mean;
  h = (time(end) - time(1)) / (numel(time) - 1);
  if numel(force) ~= numel(time) || any(abs(diff(time) - h) > 1e-6 * h)
    error('{0}: time and force must have equal lengths, and time equal steps');
  end
  % States in like units, then one matrix exponential for a force that is linear over a step.
  w = sqrt(max(sum(abs(stiffness), 2)));
  scale = [w * ones(n, 1); ones(n, 1)];
  A = diag(scale) * model.first_order.A * diag(1 ./ scale);
  B = scale .* model.first_order.B;
  step = expm([A * h, B * h, zeros(2 * n, 1); zeros(1, 2 * n + 1), 1; zeros(1, 2 * n + 2)]);
  x = zeros(2 * n, numel(time));
  x(1:n, 1) = w * (model.K \ (model.b * force(1)));  % at rest under the first force
  for k = 1:numel(time) - 1
    x(:, k + 1) = step(1:2*n, 1:2*n) * x(:, k) + step(1:2*n, 2*n+1) * force(k) ...
        + step(1:2*n, 2*n+2) * (force(k + 1) - force(k));
  end
  output = model.first_order.C * diag(1 ./ scale) * x + model.first_order.D * force';
  response.time = time;
  response.acceleration = output(1:m, :)';
  response.displacement = output(m+1:2*m, :)';
  response.load_cell = output(2*m+1, :)' + model.load_cell_share * model.F_mean;
end
)";
}  // namespace

std::string matlab_function(const ExchangedStand &stand)
{
  std::string text = fmt::format("function [model, response] = {}(time, force)\n", stand.name);
  text += fmt::format("%{}  {}\n%   {}, {}, written by {}.\n%\n", upper_case(stand.name), one_line(stand.title),
                      stand.method, one_line(stand.origin), stand.program);
  text += fmt::format(
      "%   MODEL = {0} returns  M q'' + C q' + K q = b (F - F_mean)  and its first-order form\n"
      "%   in first_order.A .. D: states (q, q'), input F - F_mean in N, outputs accelerations in m/s^2,\n"
      "%   displacements in m, change of the load-cell force in N; names and units in state_names, "
      "output_names.\n%\n"
      "%   [MODEL, RESPONSE] = {0}(TIME, FORCE) drives it with a force in N at equal steps of TIME in s,\n"
      "%   linear between them, from rest in the equilibrium under the first one: time, acceleration (times, "
      "points),\n"
      "%   displacement, load_cell.\n%\n",
      upper_case(stand.name));
  text += fmt::format("%   F is the {}.\n%   Displacements count from the state of rest under F_mean = {} N.\n",
                      one_line(stand.force_text), stand.mean_force);
  for (const auto &[name, from] : stand.source)
    text += fmt::format("%   {}: {}\n", name, one_line(from));
  return text + fmt::format(body, stand.name);
}

std::string matlab_data(const ExchangedStand &stand)
{
  const auto number = [](const double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const auto names  = [](const std::vector<Signal> &signals) {
    std::vector<std::string> texts;
    for (const Signal &signal : signals)
      texts.push_back(signal.name + " [" + signal.unit + "]");
    return texts;
  };
  return mat_file({
      {"M", stand.M, {}},
      {"C", stand.C, {}},
      {"K", stand.K, {}},
      {"b", stand.b, {}},
      {"point", stand.point, {}},
      {"load_cell", stand.load_cell, {}},
      {"load_cell_share", number(stand.load_cell_share), {}},
      {"F_mean", number(stand.mean_force), {}},
      {"frequency", stand.frequency, {}},
      {"modal_damping", number(stand.modal_damping), {}},
      {"gap_damper", number(stand.gap_damper), {}},
      {"state_names", {}, names(states_of(stand))},
      {"output_names", {}, names(outputs_of(stand))},
      {"input_names", {}, names({input_of(stand)})},
  });
}
}  // namespace mill::dynamics
