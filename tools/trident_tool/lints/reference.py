# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/reference that are made from the code, and the check that they still are."""

from __future__ import annotations

import argparse
import re
import subprocess
import textwrap
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from pathlib import Path

from trident_tool.lints.markdown import MAX_COLUMNS
from trident_tool.lints.plugin_reference import plugins_page
from trident_tool.workspace import base_environment

_HEAD = """<!-- SPDX-FileCopyrightText: 2026 The Trident authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- Made by `./trident lint reference --fix`; edit {source} instead. -->
"""
_LAUNCH_FOLDERS = ("launch", "launch/robot", "launch/sim", "src/compat")
_LONGEST_DEFAULT = 60


def _item(text: str) -> str:
    """An item of a list, of legal width."""
    return textwrap.fill(
        f"- {text}",
        MAX_COLUMNS,
        subsequent_indent="  ",
        break_long_words=False,
        break_on_hyphens=False,
    )


# Launch arguments


def launch_files(root: Path) -> Iterator[Path]:
    """The launch files that ship, those of the project first."""
    for folder in _LAUNCH_FOLDERS:
        pattern = "*/launch/**/*.launch" if folder == "src/compat" else "*.launch"
        yield from sorted((root / folder).glob(pattern))


def _launch_title(path: Path, root: Path) -> str:
    """As it is given to roslaunch: package and file."""
    relative = path.relative_to(root)
    if relative.parts[0] == "launch":
        return f"trident_bringup {Path(*relative.parts[1:])}"
    return f"{relative.parts[2]} {Path(*relative.parts[4:])}"


def _about(text: str) -> str:
    """The comment before <launch> that says what the file does."""
    comments = re.findall(r"<!--(.*?)-->", text[: text.index("<launch")], re.DOTALL)
    words = [" ".join(comment.split()) for comment in comments if "SPDX" not in comment]
    return " ".join(words)


def _argument(element: ET.Element) -> str:
    default = element.get("default")
    if default is None:
        value = "required"
    elif len(default) > _LONGEST_DEFAULT:
        value = "default: worked out"
    else:
        value = f"default `{default}`" if default else "default: empty"
    return _item(f"`{element.get('name')}` ({value}): {element.get('doc', '')}")


def arguments_without_doc(root: Path) -> list[str]:
    """Arguments of launch files of which no `doc` says what they are, a line each."""
    return [
        f'{path.relative_to(root)}: <arg name="{element.get("name")}"> has no doc'
        for path in launch_files(root)
        for element in ET.parse(path).getroot().findall("arg")
        if element.get("value") is None and not element.get("doc")
    ]


def launch_page(root: Path) -> str:
    """docs/reference/launch_arguments.md."""
    parts = [
        _HEAD.format(source="the launch files"),
        "# Launch arguments\n\nWhat each file is for: [launch_files.md](launch_files.md). "
        "`roslaunch PACKAGE FILE --ros-args` prints the same.\n",
    ]
    for path in launch_files(root):
        elements = ET.parse(path).getroot().findall("arg")
        lines = [_argument(element) for element in elements if element.get("value") is None]
        if not lines:
            continue
        about = textwrap.fill(_about(path.read_text(encoding="utf-8")), MAX_COLUMNS)
        parts.append("\n".join([f"## {_launch_title(path, root)}\n", f"{about}\n", *lines, ""]))
    return "\n".join(parts)


# Commands


def _option(action: argparse.Action) -> str:
    names = ", ".join(f"`{name}`" for name in action.option_strings)
    value = _value_of(action)
    shown = f"{names} `{value}`" if names and value else names or f"`{value}`"
    if not action.help:
        return _item(shown)
    return _item(f"{shown}: {action.help % {'default': action.default}}")


def _value_of(action: argparse.Action) -> str:
    """What stands for the value of an option; empty for one that takes none."""
    if isinstance(action.metavar, tuple):
        return " ".join(action.metavar)
    if action.metavar:
        return action.metavar
    if action.choices:
        return " | ".join(map(str, action.choices))
    return action.dest.upper() if action.nargs != 0 else ""


def _commands_of(parser: argparse.ArgumentParser, name: str) -> Iterator[str]:
    """The section of each subcommand, those below it after it."""
    for action in parser._actions:
        if not isinstance(action, argparse._SubParsersAction):
            continue
        for word, sub in action.choices.items():
            if word != "help":
                yield _command(sub, f"{name} {word}")
                yield from _commands_of(sub, f"{name} {word}")


def _command(parser: argparse.ArgumentParser, name: str) -> str:
    shown = [
        _option(action)
        for action in parser._actions
        if not isinstance(action, argparse._SubParsersAction)
        and action.dest not in ("help", "dry_run")
    ]
    about = (parser.description or "").strip()
    about = about[:1].upper() + about[1:] + "."
    return "\n".join([f"## `{name}`\n", textwrap.fill(about, MAX_COLUMNS), "", *shown, ""])


def commands_page(parser: argparse.ArgumentParser) -> str:
    """docs/reference/commands.md."""
    head = "# Commands\n\nAll of them know `-h` and `--dry-run`, and build what is missing first.\n"
    parts = [_HEAD.format(source="tools/trident_tool"), head, *_commands_of(parser, "./trident")]
    return "\n".join(part.rstrip() + "\n" for part in parts)


# The check


def plugin_listing(root: Path) -> str | None:
    """What the program plugin_reference prints; None where it is not built."""
    program = root / "build" / "devel" / "lib" / "trident_sim" / "plugin_reference"
    if not program.exists():
        return None
    run = subprocess.run(
        [program], capture_output=True, text=True, check=True, env=base_environment(), cwd=root
    )
    return run.stdout


def _holds(page: Path, text: str) -> bool:
    return page.exists() and page.read_text(encoding="utf-8") == text


def check_reference(root: Path, parser: argparse.ArgumentParser, fix: bool) -> int:
    """Compares the pages with what the code says, or writes them; returns 1 if one differs."""
    problems = arguments_without_doc(root)
    makers: dict[str, Callable[[], str]] = {
        "launch_arguments.md": lambda: launch_page(root),
        "commands.md": lambda: commands_page(parser),
    }
    listing = plugin_listing(root)
    if listing is None:
        print("reference: plugins.md is not compared: build the target plugin_reference")
    else:
        found = listing
        makers["plugins.md"] = lambda: (
            _HEAD.format(source="plugins.yaml")
            + plugins_page(found, root / "docs" / "reference" / "plugins.yaml", problems)
        )
    for name, make in makers.items():
        page = root / "docs" / "reference" / name
        text = make()
        if fix:
            page.write_text(text, encoding="utf-8")
        elif not _holds(page, text):
            problems.append(f"{page.relative_to(root)}: differs from the code; --fix writes it")
    for problem in problems:
        print(problem)
    print(f"reference: {len(problems)} problems in {len(makers)} pages")
    return int(bool(problems))
