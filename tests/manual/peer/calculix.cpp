#include "tests/manual/peer/calculix.h"
#include "core/base/errors.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace mill::verify::peer {
namespace {
namespace fs = std::filesystem;

// What a command prints.
std::string printed(const std::string &command)
{
  std::string text;
  if (std::FILE *pipe = ::popen((command + " 2>&1").c_str(), "r")) {
    std::array<char, 4096> part{};
    while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
      text.append(part.data(), n);
    ::pclose(pipe);
  }
  return text;
}

std::string version()
{
  static const std::string result = [] {
    const std::string text = printed("ccx -v");
    std::smatch match;
    return std::regex_search(text, match, std::regex(R"(Version ([0-9.]+))")) ? match[1].str() : std::string();
  }();
  if (result.empty())
    throw Skipped("needs CalculiX: apt-get install calculix-ccx");
  return result;
}

std::string contents(const fs::path &path)
{
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}
}  // namespace

std::string program_and_date()
{
  const std::string program = "CalculiX " + version();
  const std::time_t now     = std::time(nullptr);
  std::tm date{};
  ::localtime_r(&now, &date);
  return fmt::format("{}, run on {:04}-{:02}-{:02}", program, date.tm_year + 1900, date.tm_mon + 1, date.tm_mday);
}

Deck::Deck(const Mesh &mesh, const Material &material) : n_nodes_(Eigen::Index(mesh.nodes.size()))
{
  version();
  static std::atomic<int> number{0};
  folder_ = (fs::temp_directory_path() / fmt::format("millstand-peer-{}-{}", ::getpid(), ++number)).string();
  fs::create_directory(folder_);
  file_ = std::fopen((folder_ + "/deck.inp").c_str(), "w");
  if (!file_)
    throw SystemError("the deck of the peer cannot be written: " + folder_);
  line("*NODE, NSET=NALL");
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    line(fmt::format("{},{:.12e},{:.12e},{:.12e}", i + 1, mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]));
  line("*ELEMENT, TYPE=C3D20, ELSET=EALL");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    std::string text = std::to_string(e + 1);
    for (std::size_t n = 0; n < 20; ++n)
      text += (n == 14 ? ",\n" : ",") + std::to_string(mesh.elements[e][n] + 1);  // 16 entries a line
    line(text);
  }
  line(fmt::format("*MATERIAL, NAME=STEEL\n*ELASTIC\n{:.12e},{:.12e}\n*DENSITY\n{:.12e}", material.youngs_modulus,
                   material.poisson_ratio, material.density));
  line("*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL");
}

Deck::~Deck()
{
  if (file_)
    std::fclose(file_);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Deck::line(const std::string &text)
{
  std::fputs((text + "\n").c_str(), file_);
}

void Deck::hold(const std::vector<int> &nodes, const int direction)
{
  line("*BOUNDARY");
  for (const int node : nodes)
    line(fmt::format("{},{},{}", node + 1, direction, direction));
}

void Deck::hold_mean(const Weights &weights, const int direction)
{
  // The first node is the dependent one: the heaviest, so that no coefficient is large.
  const auto heaviest = std::max_element(weights.begin(), weights.end(),
                                         [](const auto &a, const auto &b) { return a.second < b.second; });
  std::vector<std::pair<int, double>> terms{*heaviest};
  for (const auto &entry : weights)
    if (entry.first != heaviest->first)
      terms.push_back(entry);
  line(fmt::format("*EQUATION\n{}", terms.size()));
  for (std::size_t i = 0; i < terms.size(); i += 4) {
    std::string text;
    for (std::size_t j = i; j < std::min(i + 4, terms.size()); ++j)
      text += fmt::format("{}{},{},{:.12e}", j > i ? "," : "", terms[j].first + 1, direction,
                          terms[j].second / heaviest->second);
    line(text);
  }
}

void Deck::touch(const std::vector<Face> &slave, const std::vector<Face> &master, const double stiffness)
{
  const int number = ++contacts_;
  for (const auto &[name, faces] : {std::pair{"SLAVE", &slave}, std::pair{"MASTER", &master}}) {
    line(fmt::format("*SURFACE, NAME={}{}, TYPE=ELEMENT", name, number));
    for (const Face &face : *faces)
      line(fmt::format("{},S{}", face.element + 1, face.face));
  }
  line(fmt::format("*SURFACE INTERACTION, NAME=TOUCH{}\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", number));
  line(fmt::format("{:.12e}", stiffness));
  line(fmt::format("*CONTACT PAIR, INTERACTION=TOUCH{0}, TYPE=SURFACE TO SURFACE\nSLAVE{0},MASTER{0}", number));
}

double Deck::force_to_move(const std::vector<int> &nodes, const int direction, const double motion)
{
  line("*NSET, NSET=MOVED");
  for (const int node : nodes)
    line(fmt::format("{},", node + 1));
  // Without DIRECT the increment stops a millionth short of its end and a second one costs as much as the first.
  line("*STEP, INC=200\n*STATIC, DIRECT\n1.,1.");
  line(fmt::format("*BOUNDARY\nMOVED,{},{},{:.12e}", direction, direction, motion));
  line("*NODE PRINT, NSET=MOVED, TOTALS=ONLY\nRF\n*END STEP");
  const std::string text = run();
  // " total force (fx,fy,fz) for set MOVED and time  0.1000000E+01", a blank line, three numbers
  const auto head = text.rfind("total force");
  const auto row  = head == std::string::npos ? head : text.find('\n', head);
  std::istringstream fields(row == std::string::npos ? "" : text.substr(row));
  std::array<double, 3> force{};
  if (!(fields >> force[0] >> force[1] >> force[2]))
    throw SolverError({"CalculiX printed no reaction", folder_, "", "", ""});
  return force[std::size_t(direction - 1)];
}

std::string Deck::run()
{
  std::fclose(file_);
  file_                     = nullptr;
  const std::string message = printed("cd '" + folder_ + "' && ccx -i deck");
  const std::string text    = contents(folder_ + "/deck.dat");
  if (message.find("Job finished") == std::string::npos || text.empty())
    throw SolverError({"CalculiX did not finish",
                       message.substr(message.size() - std::min<std::size_t>(message.size(), 400)), "", "", ""});
  return text;
}

Eigen::MatrixXd Deck::displacement(const Weights &forces, const int direction)
{
  line("*STEP\n*STATIC\n*CLOAD");
  for (const auto &[node, force] : forces)
    line(fmt::format("{},{},{:.12e}", node + 1, direction, force));
  line("*NODE PRINT, NSET=NALL\nU\n*END STEP");
  std::istringstream text(run());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(n_nodes_, 3);
  Eigen::Index read = 0;
  for (std::string row; std::getline(text, row);) {
    std::istringstream fields(row);
    Eigen::Index node = 0;
    Eigen::Vector3d value;
    if (fields >> node >> value[0] >> value[1] >> value[2] && node >= 1 && node <= n_nodes_) {
      u.row(node - 1) = value;
      ++read;
    }
  }
  if (read != n_nodes_)
    throw SolverError(
        {"CalculiX printed too few displacements", fmt::format("{} of {}", read, n_nodes_), "", "", ""});
  return u;
}

Eigen::VectorXd Deck::frequencies(const int n)
{
  line(fmt::format("*STEP\n*FREQUENCY\n{}\n*END STEP", n));
  const std::string all = run();
  // "MODE NO  EIGENVALUE  (RAD/TIME)  (CYCLES/TIME)  imaginary part": up to the next table.
  const auto end = all.find("P A R T I C I P A T I O N");
  std::istringstream text(all.substr(0, end));
  Eigen::VectorXd frequency(n);
  int read = 0;
  for (std::string row; read < n && std::getline(text, row);) {
    std::istringstream fields(row);
    int mode = 0;
    double eigenvalue, angular, cycles;
    if (fields >> mode >> eigenvalue >> angular >> cycles && mode == read + 1)
      frequency[read++] = cycles;
  }
  if (read != n)
    throw SolverError({"CalculiX printed too few frequencies", fmt::format("{} of {}", read, n), "", "", ""});
  return frequency;
}

double mean(const Weights &weights, const Eigen::MatrixXd &displacement, const int direction)
{
  double sum = 0;
  for (const auto &[node, weight] : weights)
    sum += weight * displacement(node, direction - 1);
  return sum / total(weights);
}

Weights spread(const Weights &weights, const double force)
{
  const double each = force / total(weights);
  Weights forces    = weights;
  for (auto &[node, weight] : forces)
    weight *= each;
  return forces;
}
}  // namespace mill::verify::peer
