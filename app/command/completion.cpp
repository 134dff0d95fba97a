#include "app/command/completion.h"
#include "app/command/command_line.h"
#include "app/command/option_words.h"
#include "core/case/fields.h"
#include "core/case/input_reference.h"
#include <fmt/format.h>

namespace mill {
namespace {
enum class Shell { bash, fish, zsh };
constexpr auto words_of(Shell)
{
  return choice_words<Shell>("bash", "fish", "zsh");
}

std::string listed_words(const std::vector<std::string> &words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> names_of(const std::vector<DescribedVerb> &verbs)
{
  std::vector<std::string> names;
  for (const DescribedVerb &verb : verbs)
    names.push_back(verb.name);
  return names;
}

// In single quotes of a shell.
std::string quoted(const std::string &text)
{
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The first word after some verbs, where it is one of a list.
std::vector<std::pair<std::string, std::vector<std::string>>> listed_first_words()
{
  return {{"new", template_names()}, {"completion", word_list<Shell>()}, {"export", word_list<ExportFormat>()}};
}

std::string bash_script(const std::vector<DescribedVerb> &verbs)
{
  std::string cases, first_words;
  for (const DescribedVerb &verb : verbs)
    cases += fmt::format("    {}) options=\"{}\" ;;\n", verb.name, listed_words(verb.long_names()));
  for (const auto &[verb, words] : listed_first_words())
    first_words += fmt::format("  elif [ \"$COMP_CWORD\" -eq 2 ] && [ \"${{COMP_WORDS[1]}}\" = {} ]; then\n"
                               "    COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))\n",
                               verb, listed_words(words));
  return fmt::format(R"(_millstand() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" options=""
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ "$word" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
{}  elif [ "$before" = --force ]; then
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
                     listed_words(names_of(verbs)), cases, first_words);
}

// Sourced, it registers the function; as a file on fpath it is the function, and is called at once.
std::string zsh_script(const std::vector<DescribedVerb> &verbs)
{
  std::string described, cases, first_words;
  const auto described_word = [](const std::string &word, const std::string &meaning) {
    return quoted(word + ":" + meaning) + " ";
  };
  for (const DescribedVerb &verb : verbs) {
    described += described_word(verb.name, verb.meaning);
    std::string options;
    for (const DescribedOption &option : verb.options)
      for (const std::string &name : option.names)
        if (is_long(name))
          options += described_word(name, option.meaning);
    cases += fmt::format("    {}) options=({}) ;;\n", verb.name, options);
  }
  for (const auto &[verb, words] : listed_first_words())
    first_words += fmt::format("  elif [[ $CURRENT -eq 3 && $words[2] == {} ]]; then\n    compadd -- {}\n", verb,
                               listed_words(words));
  return fmt::format(R"(_millstand() {{
  local -a verbs options
  verbs=({})
  case "$words[2]" in
{}  esac
  if [[ $CURRENT -eq 2 ]]; then
    _describe verb verbs
  elif [[ $words[CURRENT] == -* ]]; then
    _describe option options
{}  else
    _files
  fi
}}
if [[ $funcstack[1] == _millstand ]]; then
  _millstand "$@"
else
  compdef _millstand millstand
fi
)",
                     described, cases, first_words);
}

std::string fish_script(const std::vector<DescribedVerb> &verbs)
{
  std::string text;
  for (const DescribedVerb &verb : verbs) {
    text += fmt::format("complete -c millstand -f -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                        quoted(verb.meaning));
    for (const DescribedOption &option : verb.options) {
      std::string names;
      for (const std::string &name : option.names)
        if (option.named)
          names += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!names.empty())
        text += fmt::format("complete -c millstand -n '__fish_seen_subcommand_from {}'{}{} -d {}\n", verb.name,
                            names, option.takes ? " -r" : "", quoted(option.meaning));
    }
  }
  for (const auto &[verb, words] : listed_first_words())
    text += fmt::format("complete -c millstand -n '__fish_seen_subcommand_from {}' -a {}\n", verb,
                        quoted(listed_words(words)));
  return text;
}
}  // namespace

std::string completion_script(const std::string &shell, const std::vector<DescribedVerb> &verbs)
{
  const std::string what =
      "# Completion of millstand: source it, or write it where the shell looks for completions.\n";
  const auto known = choice_named<Shell>(shell);
  if (!known)
    throw InputError(fmt::format("no completion is available for the shell '{}'{}", shell,
                                 suggestion(shell, word_list<Shell>())));
  return *known == Shell::bash   ? what + bash_script(verbs)
         : *known == Shell::fish ? what + fish_script(verbs)
                                 : "#compdef millstand\n" + what + zsh_script(verbs);
}
}  // namespace mill
