#pragma once
#include "tests/support/program.h"
#include "tests/support/studio_program.h"
#include "tests/support/web_driver.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

// The page of the studio in a headless Chromium beside the built program, with a new stand.
class StudioBrowser : public testing::Test {
protected:
  void SetUp() override
  {
    if (!Browser::missing().empty())
      GTEST_SKIP() << Browser::missing() << "; scripts/install-deps tests installs it";
    folder = scratch("studio-browser");
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    put_case();
    begin("127.0.0.1:0");
    browser = std::make_unique<Browser>();
    browser->size(1400, 900);
    browser->open(studio->program().url());
    ASSERT_TRUE(browser->wait_for("return document.body.dataset.ready === 'yes'", 20)) << text("body");
    ASSERT_TRUE(settled());
  }
  // The case in the folder; nothing: the studio begins with a new four-high stand.
  virtual void put_case() {}
  void begin(const std::string &listen)
  {
    studio = std::make_unique<StudioProgram>(folder, listen, std::vector<std::string>{"--cache", shared_cache()});
  }
  // All that was typed has been taken and answered.
  bool settled()
  {
    return browser->wait_for(
        "return !document.querySelector('#quick.old') && document.getElementById('answer-note').textContent === ''"
        " && !Object.keys(localStorage).some(name => name.startsWith('millstand-studio-edits/'))",
        20);
  }
  void type(const std::string &key, const std::string &value)
  {
    ASSERT_TRUE(browser
                    ->run("const i = document.getElementById('v-" + key +
                          "'); if (!i) return false; i.focus(); if (i.select) i.select(); return true;")
                    .get<bool>())
        << key;
    if (browser->run("return document.activeElement.tagName") == "SELECT")
      browser->run("const i = document.activeElement; i.value = '" + value +
                   "'; i.dispatchEvent(new Event('input', {bubbles: true}));");
    else
      browser->type(value.empty() ? "\uE003" : value);
  }
  std::string text(const std::string &selector)
  {
    const nlohmann::json element =
        browser->run("const e = document.querySelector('" + selector + "'); return e ? e.textContent : ''");
    return element.is_string() ? element.get<std::string>() : "";
  }
  // What stands in the picture, as one text.
  std::string picture()
  {
    return browser->run("return document.getElementById('picture').innerHTML").get<std::string>();
  }
  std::string quick(const std::string &name)
  {
    return text("#quick tr[data-name=\"" + name + "\"] td:nth-child(2)");
  }

  std::string folder;
  std::unique_ptr<StudioProgram> studio;
  std::unique_ptr<Browser> browser;
};
