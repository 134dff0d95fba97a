#pragma once
#include "dynamics/fmu/runtime/log.h"

/// A log of an exported unit whose client does not listen.
class QuietLog : public mill::fmu::Log {
public:
  QuietLog() : Log(Start::all) {}

private:
  void send(mill::fmu::Status, const char *, const std::string &) const override {}
};
