#include "app/studio/page/embedded.h"
#include "report/page/run.h"
#include "report/page/sections.h"
#include "tests/support/near.h"
#include "tests/support/web_driver.h"
#include "twin/web/server/page_server.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

// The drawing that a browser makes is that of the report, shape by shape.
namespace {
using Lengths = std::map<std::string, double>;

Lengths demo_stand()
{
  return {{"work_roll_diameter", 0.42},  {"work_roll_length", 1.4},      {"work_neck_diameter", 0.2667},
          {"work_total_length", 2.32},   {"work_bearing_span", 2.0},     {"backup_diameter", 1.45},
          {"backup_length", 1.4},        {"backup_neck_diameter", 0.95}, {"backup_neck_length", 0.95},
          {"backup_bearing_span", 2.45}, {"strip_width", 1.0},           {"entry_thickness", 0.008},
          {"exit_thickness", 0.005}};
}

Lengths with_housing()
{
  Lengths l = demo_stand();
  l.insert({{"housing_thickness", 0.6},
            {"housing_post_width", 0.7},
            {"housing_window_width", 1.5},
            {"housing_window_height", 5.2},
            {"housing_upper_beam_height", 1.1},
            {"housing_lower_beam_height", 1.2},
            {"screw_diameter", 0.4},
            {"screw_length", 0.9},
            {"nut_outside_diameter", 0.7},
            {"nut_height", 0.8},
            {"piston_diameter", 0.9},
            {"piston_length", 0.2},
            {"stroke", 0.05},
            {"load_cell_diameter", 0.5},
            {"load_cell_height", 0.15}});
  return l;
}

// "rect steel 1 2 3 4": kind, class and numbers of every shape, and the numbers of the texts' places.
std::vector<std::string> shapes_of(const std::string &svg, std::vector<double> &numbers)
{
  static const std::regex shape("<(rect|circle|line|text) class=\"([^\"]*)\"([^>]*)>([^<]*)"),
      number("(\\w+)=\"(-?[0-9.]+)\"");
  std::vector<std::string> out;
  for (std::sregex_iterator it(svg.begin(), svg.end(), shape), end; it != end; ++it) {
    const std::string attributes = (*it)[3];
    const bool is_text           = (*it)[1] == "text";
    std::string words            = (*it)[1].str() + " " + (*it)[2].str() + (is_text ? " " + (*it)[4].str() : "");
    for (std::sregex_iterator n(attributes.begin(), attributes.end(), number); n != end; ++n) {
      words += " " + (*n)[1].str();
      numbers.push_back(std::stod((*n)[2]));
    }
    out.push_back(words);
  }
  return out;
}

const char *const page =
    "<!doctype html><title>drawing</title><script type=\"module\" src=\"/ready.js\"></script>";
const char *const ready = R"(import { standToScale } from "./stand_to_scale.js";
window.shapes = length => {
  const d = standToScale(length);
  if (!d) return null;
  const order = { rect: ["x", "y", "width", "height"], circle: ["cx", "cy", "r"], line: ["x1", "y1", "x2", "y2"], text: ["x", "y"] };
  return { words: d.shapes.map(s => `${s.kind} ${s.style}${s.text ? " " + s.text : ""} ${order[s.kind].join(" ")}`),
           numbers: d.shapes.flatMap(s => order[s.kind].map(name => s[name])), width: d.width, height: d.height };
};)";
}  // namespace

TEST(StudioDrawing, TheBrowserDrawsTheStandAsTheReportDoes)
{
  if (const std::string missing = Browser::missing(); !missing.empty())
    GTEST_SKIP() << missing << "; scripts/install-deps tests installs it";
  mill::web::PageSettings settings;
  settings.port            = 0;
  const char *const script = "text/javascript; charset=utf-8";
  mill::web::PageServer server(settings,
                               {"test",
                                {{{"/", "text/html; charset=utf-8", page},
                                  {"/ready.js", script, ready},
                                  {"/stand_to_scale.js", script, mill::studio::embedded::stand_to_scale_js}},
                                 {}},
                                {},
                                [](const mill::web::PageRequest &) { return mill::web::PageReply{}; }});
  Browser browser;
  browser.open(server.url());
  ASSERT_TRUE(browser.wait_for("return Boolean(window.shapes)"));
  std::mt19937 draw(3);
  int compared = 0;
  for (int round = 0; round < 24; ++round) {
    Lengths length = round % 2 ? with_housing() : demo_stand();
    for (auto &[name, value] : length)
      if (round > 1)
        value *= 0.8 + 0.4 * double(draw() % 1000) / 1000;
    if (round == 2)  // halves of a millimetre, which the report rounds to the even number
      length["work_roll_diameter"] = 0.4205, length["backup_diameter"] = 1.4455;
    mill::report::Run run;
    run.manifest.geometry = length;
    const std::string svg = mill::report::stand_to_scale(run);
    std::vector<double> expected;
    const auto words          = shapes_of(svg, expected);
    const nlohmann::json seen = browser.run("return window.shapes(" + nlohmann::json(length).dump() + ")");
    const auto drawn          = seen["words"].get<std::vector<std::string>>();
    for (std::size_t i = 0; i < std::min(drawn.size(), words.size()); ++i)
      ASSERT_EQ(drawn[i], words[i]) << "shape " << i;
    ASSERT_EQ(drawn.size(), words.size());
    const auto numbers = seen["numbers"].get<std::vector<double>>();
    ASSERT_EQ(numbers.size(), expected.size());
    for (std::size_t i = 0; i < numbers.size(); ++i, ++compared)
      ASSERT_TRUE(near(numbers[i], expected[i], within_absolute(0.006, "the report writes hundredths of a pixel")))
          << words[std::min(i / 4, words.size() - 1)];
  }
  EXPECT_GT(compared, 24 * 60);
  EXPECT_TRUE(browser.run("return window.shapes({work_roll_diameter: 0.4})").is_null());
}
