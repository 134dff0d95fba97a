#include "app/command/completion.h"
#include "app/command/command_line.h"
#include "core/case/fields.h"
#include "core/case/stand_rows.h"
#include <fmt/format.h>

namespace mill {
namespace {
std::string listed_words(const std::vector<std::string> &words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : " ") + word;
  return text;
}
}  // namespace

// One function for both: zsh takes bash's completions by bashcompinit.
std::string completion_script(const std::string &shell,
                              const std::map<std::string, std::vector<std::string>> &options)
{
  const std::vector<std::string> shells{"bash", "zsh"};
  if (shell != "bash" && shell != "zsh")
    throw InputError(
        fmt::format("no completion is available for the shell '{}'{}", shell, suggestion(shell, shells)));
  std::vector<std::string> verbs;
  std::string cases;
  for (const auto &[verb, its_options] : options) {
    verbs.push_back(verb);
    cases += fmt::format("    {}) options=\"{}\" ;;\n", verb, listed_words(its_options));
  }
  std::string text = "# Completion of millstand: source it, or write it where the shell looks for completions.\n";
  if (shell == "zsh")
    text += "autoload -U +X bashcompinit && bashcompinit\n";
  return text + fmt::format(R"(_millstand() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" options=""
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ "$word" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [ "$COMP_CWORD" -eq 2 ] && [ "${{COMP_WORDS[1]}}" = new ]; then
    COMPREPLY=($(compgen -W "{}" -- "$word"))
  elif [ "$COMP_CWORD" -eq 2 ] && [ "${{COMP_WORDS[1]}}" = completion ]; then
    COMPREPLY=($(compgen -W "{}" -- "$word"))
  elif [ "$COMP_CWORD" -eq 2 ] && [ "${{COMP_WORDS[1]}}" = export ]; then
    COMPREPLY=($(compgen -W "{}" -- "$word"))
  elif [ "$before" = --force ]; then
    COMPREPLY=($(compgen -f -X '!*.csv' -- "$word") $(compgen -d -- "$word"))
  elif {{ [ "$COMP_CWORD" -eq 2 ] && [ "${{COMP_WORDS[1]}}" != report ]; }} ||
       {{ [ "$COMP_CWORD" -eq 3 ] && [ "${{COMP_WORDS[1]}}" = export ]; }}; then
    COMPREPLY=($(compgen -f -X '!*.toml' -- "$word") $(compgen -d -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _millstand millstand
)",
                            listed_words(verbs), cases, listed_words(case_kinds()), listed_words(shells),
                            listed_words(export_formats()));
}
}  // namespace mill
