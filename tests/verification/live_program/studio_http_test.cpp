#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/studio_edits.h"
#include "tests/support/studio_program.h"
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

// The built program asked by HTTP: the same answers as those of the command line, and what it refuses.
using nlohmann::json;

TEST(StudioHttp, ChecksAsTheCommandLineDoes)
{
  const JudgedEdits judged = judge_random_edits(new_stand("edits"), 6, 11);
  EXPECT_EQ(judged.differ, std::vector<std::string>());
  EXPECT_GT(judged.wrong, 0);
  EXPECT_LT(judged.wrong, 6);
}

TEST(StudioHttp, TheQuickAnswerIsThatOfSweepAndTheSweepToo)
{
  const std::string folder = new_stand("quick");
  StudioProgram studio(folder);
  const json quick = studio.post("/quick", json::object());
  const json varied =
      studio.post("/sweep", {{"key", "work_roll.barrel_diameter"}, {"values", {"410 mm", "420 mm", "oops"}}});
  const Outcome sweep = millstand(
      "sweep " + folder + "/stand.toml --model quick --vary work_roll.barrel_diameter=410,420mm -q -o " + folder +
      "/sweep --watch K3 --watch M3 --watch stand.modulus.kiss --watch mode.gap_first_kind.frequency");
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  const json table = json::parse(std::ifstream(folder + "/sweep/sweep.json"));
  ASSERT_EQ(table["rows"].size(), 2u);
  const auto of_quick = [&](const std::string &name) {
    for (const json &r : quick["results"])
      if (r["name"] == name)
        return r["value"].get<double>();
    return 0.;
  };
  std::size_t k = 0;
  for (const char *name : {"K3", "M3", "stand.modulus.kiss", "mode.gap_first_kind.frequency"}) {
    const double expected = table["rows"][1]["results"][k].get<double>();
    EXPECT_TRUE(near(of_quick(name), expected, within(1e-12, "the same functions"))) << name;
    for (std::size_t row = 0; row < 2; ++row)
      EXPECT_TRUE(near(varied["rows"][row]["results"][name].get<double>(),
                       table["rows"][row]["results"][k].get<double>(), within(1e-12, "the same functions")))
          << name;
    ++k;
  }
  EXPECT_TRUE(varied["rows"][2].contains("error"));
}

TEST(StudioHttp, ForeignPagesAndWrongTokensAreRefused)
{
  const std::string folder = new_stand("foreign");
  StudioProgram studio(folder);
  const int port              = studio.program().port();
  const std::string json_type = "Content-Type: application/json\r\n",
                    token     = "X-Millstand-Token: " + studio.program().token() + "\r\n";
  const std::string before    = studio.get("/document").dump();
  const std::string edit      = R"({"edits":[{"id":"a","key":"title","value":"taken"}]})";
  const auto post             = [&](const std::string &path, const std::string &lines) {
    return ask(port, post_request(port, path, edit, lines)).status;
  };
  for (const char *path : {"/check", "/edit", "/quick", "/run", "/save", "/sweep", "/compare"}) {
    EXPECT_EQ(post(path, json_type), 401) << path;
    EXPECT_EQ(post(path, json_type + "X-Millstand-Token: " + std::string(43, 'x') + "\r\n"), 401) << path;
    EXPECT_EQ(post(path, json_type + token + "Origin: http://evil.example\r\n"), 403) << path;
    EXPECT_EQ(post(path, json_type + token + "Origin: null\r\n"), 403) << path;
    EXPECT_EQ(post(path, token + "Content-Type: text/plain\r\n"), 415) << path;
    EXPECT_EQ(ask(port, get_request(port, path, token)).status, 405) << path;
  }
  for (const char *path : {"/schema", "/document", "/run/run-1/results.json", "/events"})
    EXPECT_EQ(ask(port, get_request(port, path)).status, 401) << path;
  EXPECT_EQ(ask(port, get_request(port, "/document?token=" + studio.program().token())).status, 401)
      << "only a report and the events are opened without headers";
  // DNS rebinding: the name of another machine leads here.
  EXPECT_EQ(
      ask(port, "GET /document HTTP/1.1\r\nHost: evil.example\r\n" + token + "Connection: close\r\n\r\n").status,
      403);
  EXPECT_EQ(studio.get("/document").dump(), before);
}

TEST(StudioHttp, HostilePostsChangeNothing)
{
  const std::string folder = new_stand("hostile");
  StudioProgram studio(folder);
  const std::string before = studio.get("/document").dump();
  std::string deep(200, '[');
  for (const std::string &body :
       {std::string("{"), std::string("[]"), std::string("null"), std::string("{\"edits\":{}}"),
        std::string("{\"edits\":[1]}"), std::string(R"({"edits":[{"id":1,"key":"title","value":"x"}]})"),
        std::string(R"({"edits":[{"id":"1","key":"","value":"x"}]})"),
        std::string(R"({"edits":[{"id":"1","key":"work_roll","value":"x"}]})"),
        std::string(R"({"edits":[{"id":"1","key":"title","value":7}]})"), "{\"edits\":" + deep + "}",
        std::string("{\"edits\":[{\"id\":\"1\",\"key\":\"a\\u0000b.c\",\"value\":\"\\ud800\"}]}")}) {
    const HttpAnswer reply = studio.answer("/check", body);
    EXPECT_EQ(reply.status, 400) << body << reply.body;
  }
  EXPECT_EQ(studio.answer("/check", std::string(2 << 20, ' ')).status, 413);
  EXPECT_EQ(studio.answer("/quick", std::string(70 << 10, ' ')).status, 413);
  for (const char *op : {"x", "back", "pin", "import"})
    EXPECT_EQ(studio.answer("/edit", json{{"op", op}}.dump()).status, 400) << op;
  EXPECT_EQ(
      studio.answer("/edit", json{{"op", "import"}, {"as", "case"}, {"name", ""}, {"text", "[a"}}.dump()).status,
      400);
  EXPECT_EQ(studio.answer("/run", R"({"what":"rm -rf"})").status, 400);
  EXPECT_EQ(studio.answer("/compare", R"({"pins":["a","b"]})").status, 409);
  EXPECT_EQ(
      studio.answer("/sweep", json{{"key", "title"}, {"values", std::vector<std::string>(62, "x")}}.dump()).status,
      400);
  for (const char *path : {"/run/../stand.toml", "/run/..", "/run/.stand.toml.studio", "/run//etc/passwd",
                           "/run/%2e%2e/stand.toml", "/run/", "/run/runs/../../stand.toml"})
    EXPECT_EQ(studio.get(path)["status"], 404) << path;
  EXPECT_EQ(studio.get("/document").dump(), before);
}

TEST(StudioHttp, AValueWithTomlInItStaysAText)
{
  const std::string folder = new_stand("injection");
  StudioProgram studio(folder);
  const std::string title = "<img src=x onerror=alert(1)>\"\n[steel]\nyoungs_modulus = 1";
  const json answer       = studio.edit("1", "title", title);
  EXPECT_FALSE(answer["values"].contains("steel.youngs_modulus")) << answer.dump();
  EXPECT_EQ(answer["values"]["title"].get<std::string>().substr(0, 28), "<img src=x onerror=alert(1)>");
}

namespace {
bool ends_as(const StudioProgram &studio, const char *status)
{
  for (const double end = steady_seconds() + 60; steady_seconds() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(50)))
    if (const std::string now = studio.get("/document")["job"]["status"]; now != "running" || now == status)
      return now == status;
  return false;
}
}  // namespace

TEST(StudioHttp, ARunCanBeCancelled)
{
  StudioProgram studio(new_stand("cancel"), "127.0.0.1:0", {"--cache", shared_cache()});
  studio.post("/edit", {{"op", "pin"}, {"name", "first"}});
  ASSERT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-1");
  EXPECT_EQ(studio.answer("/run", R"({"what":"run"})").status, 409);
  EXPECT_EQ(studio.answer("/run", R"({"what":"cancel"})").status, 202);
  EXPECT_TRUE(ends_as(studio, "cancelled"));
  EXPECT_EQ(studio.get("/document")["pins"][0]["run"], "");
}

TEST(StudioHttp, ACancelledRunLeavesNoFiles)
{
  const std::string folder = new_stand("cancel-files");
  StudioProgram studio(folder, "127.0.0.1:0", {"--cache", folder + "/cache"});
  ASSERT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-1");
  const std::string run = folder + "/runs/run-1";
  const auto staged     = [&] {
    std::error_code none;
    for (const auto &entry : std::filesystem::directory_iterator(run, none))
      if (entry.path().filename().string().rfind(".run-", 0) == 0)
        return true;
    return false;
  };
  for (const double end = steady_seconds() + 30; steady_seconds() < end && !staged();)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(staged());
  EXPECT_EQ(studio.answer("/run", R"({"what":"cancel"})").status, 202);
  EXPECT_TRUE(ends_as(studio, "cancelled"));
  for (const double end = steady_seconds() + 10; steady_seconds() < end && std::filesystem::exists(run);)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(std::filesystem::exists(run));
  EXPECT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-2") << "no number twice";
}

TEST(StudioHttp, ARefusedEditLeavesTheOthersOfItsRequest)
{
  StudioProgram studio(new_stand("batch"));
  const json answer = studio.post("/check", {{"edits",
                                              {{{"id", "1"}, {"key", "title"}, {"value", "GOOD EDIT"}},
                                               {{"id", "2"}, {"key", "work_roll"}, {"value", "x"}},
                                               {{"id", "3"}, {"key", "strip.width"}, {"value", "1001 mm"}}}}});
  ASSERT_TRUE(answer.contains("values")) << answer.dump();
  EXPECT_EQ(answer["values"]["title"], "GOOD EDIT");
  EXPECT_EQ(answer["values"]["strip.width"], "1001 mm");
  ASSERT_EQ(answer["refused"].size(), 1u);
  EXPECT_EQ(answer["refused"][0]["id"], "2");
}

TEST(StudioHttp, AWrongSenderIsRefusedBeforeTheEditIsDone)
{
  StudioProgram studio(new_stand("sender"));
  const std::string before = studio.get("/document").dump();
  EXPECT_EQ(studio.answer("/edit", R"({"op":"pin","name":"p","by":5})").status, 400);
  EXPECT_EQ(studio.answer("/check", R"({"by":[],"edits":[{"id":"1","key":"title","value":"x"}]})").status, 400);
  EXPECT_EQ(studio.get("/document").dump(), before);
}

TEST(StudioHttp, AFailedRunQuotesTheTextThatWasRun)
{
  StudioProgram studio(new_stand("quoted"));
  studio.post("/edit", {{"op", "import"}, {"as", "case"}, {"name", ""}, {"text", "title = \"of the page\"\n"}});
  ASSERT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-1");
  ASSERT_TRUE(ends_as(studio, "failed"));
  const std::string printed = studio.get("/document")["job"]["printed"];
  EXPECT_NE(printed.find("1 | title = \"of the page\""), std::string::npos) << printed;
}

// A stand of six given masses, which is run at once.
TEST(StudioHttp, RunExportAndComparisonAreThoseOfTheCommandLine)
{
  const std::string folder = new_stand("run", "lumped");
  StudioProgram studio(folder);
  studio.post("/edit", {{"op", "pin"}, {"name", "first"}});
  ASSERT_EQ(studio.post("/run", {{"what", "run"}})["id"], "run-1");
  ASSERT_TRUE(ends_as(studio, "done")) << studio.get("/document")["job"].dump();
  ASSERT_EQ(millstand("run stand.toml -q -o out", folder).exit_code, 0);
  EXPECT_EQ(studio.get("/run/run-1/results.json")["values"],
            json::parse(std::ifstream(folder + "/out/results.json"))["values"]);
  ASSERT_EQ(studio.post("/run", {{"what", "modelica"}})["id"], "export-1");
  ASSERT_TRUE(ends_as(studio, "done")) << studio.get("/document")["job"].dump();
  const HttpAnswer model =
      ask(studio.program().port(),
          get_request(studio.program().port(), "/run/export-1/stand.mo?token=" + studio.program().token()));
  EXPECT_EQ(model.status, 200);
  EXPECT_NE(model.body.find("model "), std::string::npos);
  studio.edit("k", "given.K1", "\"30 MN/mm\"");
  studio.post("/edit", {{"op", "pin"}, {"name", "second"}});
  EXPECT_EQ(studio.answer("/compare", R"({"pins":["first","second"]})").status, 409) << "the second has no run";
  const HttpAnswer report =
      ask(studio.program().port(),
          get_request(studio.program().port(), "/run/run-1/report.html?token=" + studio.program().token()));
  EXPECT_EQ(report.status, 200);
  EXPECT_NE(report.head.find("Content-Security-Policy: sandbox allow-scripts"), std::string::npos);
}
