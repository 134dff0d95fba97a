#pragma once
#include "twin/live/queue/messages.h"
#include <string>
#include <vector>

/// What came out of a reader of a source; of samples the first channel.
struct CameMessages {
  std::vector<mill::live::SourceHead> heads;
  std::vector<double> force;
  std::vector<std::int64_t> numbers;
  std::vector<std::string> refused, notes;
  std::vector<mill::live::SourceFile> files;

  void add(const mill::live::Message &message)
  {
    if (const auto *head = std::get_if<mill::live::SourceHead>(&message))
      heads.push_back(*head);
    if (const auto *block = std::get_if<mill::live::SourceBlock>(&message))
      for (Eigen::Index i = 0; i < block->value.rows(); ++i) {
        force.push_back(block->value(i, 0));
        numbers.push_back(block->first + i);
      }
    if (const auto *file = std::get_if<mill::live::SourceFile>(&message))
      files.push_back(*file);
    if (const auto *line = std::get_if<mill::live::RefusedLine>(&message))
      refused.push_back(line->reason);
    if (const auto *note = std::get_if<mill::live::SourceNote>(&message))
      notes.push_back(note->kind + ": " + note->text);
  }
};
