"""Print a script for tab completion of gazelle in bash or zsh.

  echo 'eval "$(gazelle completion bash)"' >> ~/.bashrc
  echo 'eval "$(gazelle completion zsh)"' >> ~/.zshrc

It completes commands, sub-commands, options and files, and the names of topics,
services, nodes and parameters of the running graph.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys

from gazelle.cli.commands import COMMANDS
from gazelle_ros import tool_names
from gazelle_ros.cli.parsing import Parser

_GRAPH = ("node", "param", "service", "topic")
"""Commands with a sub-command ``list`` of the names that the others take."""
_ZSH = """autoload -Uz compinit bashcompinit
whence compdef > /dev/null || compinit
bashcompinit
"""
_SCRIPT = """_gazelle_words() {{
  case "$1" in
{cases}
  esac
}}
_gazelle_complete() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" key="" i=1 first="${{COMP_WORDS[0]##*/}}" words names
  case "$first" in
{tools}
    *) [ "$COMP_CWORD" -gt 1 ] && key="${{COMP_WORDS[1]}}"; i=2 ;;
  esac
  case "$key" in
{aliases}
  esac
  words="$(_gazelle_words "$key")"
  if [ -n "$key" ] && [ "$COMP_CWORD" -gt "$i" ]; then
    case "$key" in
      {graph})
        words="$(_gazelle_words "$key ${{COMP_WORDS[i]}}")"
        case "$word" in
          -*) ;;
          *) names="$(gazelle "$key" list 2> /dev/null)" ;;
        esac ;;
      {nested}) words="$(_gazelle_words "$key ${{COMP_WORDS[i]}}")" ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words $names" -- "$word"))
  [ "${{#COMPREPLY[@]}}" -gt 0 ] || COMPREPLY=($(compgen -f -- "$word"))
}}
complete -o filenames -F _gazelle_complete gazelle
"""
_TOOLS = "complete -o filenames -F _gazelle_complete {tools}\n"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("shell", choices=("bash", "zsh"))
    parser.add_argument(
        "--tools",
        action="store_true",
        help="also complete rostopic, roslaunch and the other commands of 'gazelle shell'",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    sys.stdout.write(script_for(args.shell, tools=args.tools))
    return 0


def script_for(shell: str, *, tools: bool = True) -> str:
    """Return the script that a shell evaluates.

    Args:
        shell: ``bash`` or ``zsh``.
        tools: Complete ROS's commands, too.
    """
    words = _words()
    nested = sorted({key.partition(" ")[0] for key in words if " " in key} - set(_GRAPH))
    same = {name: known[0] for name, known in tool_names.COMMANDS.items()}
    text = _SCRIPT.format(
        cases="\n".join(f"    '{key}') echo '{' '.join(each)}' ;;" for key, each in words.items()),
        tools="\n".join(f"    {name}) key={command} ;;" for name, command in same.items()),
        aliases="\n".join(f"    {name}) key={command} ;;" for name, command in same.items()),
        graph="|".join(_GRAPH),
        nested="|".join(nested) or "''",
    )
    if tools:
        text += _TOOLS.format(tools=" ".join(same))
    return (_ZSH if shell == "zsh" else "") + text


def _words() -> dict[str, list[str]]:
    """Return the words that may follow a command, or a command and its sub-command."""
    found = {"": [*COMMANDS, *tool_names.COMMANDS, "--help", "--version"]}
    for name, command in COMMANDS.items():
        if name == "completion":
            found[name] = ["bash", "zsh"]
            continue
        parser = Parser(prog=name)
        command.load().configure(parser)
        inner = _sub_parsers(parser)
        found[name] = [*inner, *_options(parser)]
        found |= {f"{name} {sub}": _options(each) for sub, each in inner.items()}
    return found


def _sub_parsers(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:  # noqa: SLF001  # argparse has no public access
        if isinstance(action, argparse._SubParsersAction):  # noqa: SLF001  # the same
            return dict(action.choices)
    return {}


def _options(parser: argparse.ArgumentParser) -> list[str]:
    shown = (each for each in parser._actions if each.help != argparse.SUPPRESS)  # noqa: SLF001
    return [option for action in shown for option in action.option_strings if option[:2] == "--"]
