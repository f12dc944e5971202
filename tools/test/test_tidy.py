# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import json
import os
import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from trident_tool import tidy
from trident_tool.lint import is_python, python_files, run_checks, source_files
from trident_tool.tidy import (
    CompileCommand,
    IncludeScanner,
    Result,
    cache_folder,
    cache_key,
    core_units,
    load_result,
    parse_compile_commands,
    store_result,
)
from trident_tool.tidy_batches import batches, hidden_names
from trident_tool.workspace import Runner, TridentError, Workspace


def _unit(root: Path, name: str = "src/pkg/src/a.cpp") -> CompileCommand:
    include = root / "src/pkg/include/pkg"
    include.mkdir(parents=True, exist_ok=True)
    source = root / name
    source.parent.mkdir(parents=True, exist_ok=True)
    source.write_text('#include "pkg/b.h"\n#include <vector>\nint a;\n', encoding="utf-8")
    (include / "b.h").write_text("# include <pkg/c.h>\n#include <pkg/b.h>\n", encoding="utf-8")
    (include / "c.h").write_text("int c;\n", encoding="utf-8")
    return CompileCommand(source, (f"-I{include.parent}", "-O2"))


def _key(unit: CompileCommand, root: Path, settings: str = "14") -> str:
    return cache_key(unit, IncludeScanner(root).reached(unit), root, settings)


def test_compile_commands_lose_compiler_launcher_and_output() -> None:
    entry = {
        "directory": "/build",
        "file": "../a.cpp",
        "command": "/usr/bin/ccache /usr/bin/c++ -DX=1 -I/inc -isystem /sys -o a.o -c ../a.cpp",
    }
    (unit,) = parse_compile_commands(json.dumps([entry]))
    assert unit.source == Path("/a.cpp")
    assert unit.flags == ("-DX=1", "-I/inc", "-isystem", "/sys")
    assert unit.include_dirs == [Path("/inc"), Path("/sys")]


def test_precompiled_headers_are_left_out_and_other_includes_kept() -> None:
    entry = {
        "directory": "/build",
        "file": "a.cpp",
        "command": "env A=b /usr/bin/ccache /usr/bin/c++ -O2 -Winvalid-pch -include "
        "/build/CMakeFiles/x.dir/cmake_pch.hxx -include /inc/own.h -o a.o -c a.cpp",
    }
    (unit,) = parse_compile_commands(json.dumps([entry]))
    assert unit.flags == ("-O2", "-include", "/inc/own.h")


def test_only_core_sources_are_checked_once_each(tmp_path: Path) -> None:
    names = [
        "src/pkg/src/z.cpp",
        "src/pkg/src/deep/a.cpp",
        "src/pkg/src/z.cpp",
        "src/pkg/ros/node.cpp",
        "src/pkg/test/a_test.cpp",
        "build/src/pkg/src/generated.cpp",
    ]
    units = core_units([CompileCommand(tmp_path / name, ()) for name in names], tmp_path)
    found = [unit.source.relative_to(tmp_path).as_posix() for unit in units]
    assert found == ["src/pkg/src/deep/a.cpp", "src/pkg/src/z.cpp"]


def test_headers_are_followed_through_each_other(tmp_path: Path) -> None:
    unit = _unit(tmp_path)
    names = [path.name for path in IncludeScanner(tmp_path).reached(unit)]
    assert names == ["b.h", "c.h", "a.cpp"]


def test_key_depends_on_every_header_flag_and_setting(tmp_path: Path) -> None:
    unit = _unit(tmp_path)
    first = _key(unit, tmp_path)
    assert _key(unit, tmp_path) == first
    assert _key(unit, tmp_path, settings="15") != first
    assert _key(CompileCommand(unit.source, (*unit.flags, "-DX")), tmp_path) != first
    header = tmp_path / "src/pkg/include/pkg/c.h"
    header.write_text("int d;\n", encoding="utf-8")
    assert _key(unit, tmp_path) != first


def test_key_is_the_same_in_a_clone_at_another_place(tmp_path: Path) -> None:
    keys = {_key(_unit(tmp_path / clone), tmp_path / clone) for clone in ("one", "two")}
    assert len(keys) == 1


def test_results_survive_and_a_broken_one_counts_as_none(tmp_path: Path) -> None:
    path = tmp_path / "cache" / "key"
    assert load_result(path) is None
    store_result(path, Result(1, "a.cpp:1: bad\n"))
    assert load_result(path) == Result(1, "a.cpp:1: bad\n")
    assert [file.name for file in path.parent.iterdir()] == ["key"]
    path.write_text('{"code": 1', encoding="utf-8")
    assert load_result(path) is None


def test_cache_folder_follows_the_environment() -> None:
    assert cache_folder({"XDG_CACHE_HOME": "/c"}) == Path("/c/trident/clang-tidy")
    assert cache_folder({"HOME": "/h"}) == Path("/h/.cache/trident/clang-tidy")


def test_generated_hidden_and_linked_folders_are_not_checked(tmp_path: Path) -> None:
    for name in ("src/a.py", "build/b.py", ".venv/c.py", "out/d.py"):
        path = tmp_path / name
        path.parent.mkdir(parents=True)
        path.touch()
    (tmp_path / "link").symlink_to(tmp_path / "src")
    assert [path.relative_to(tmp_path).as_posix() for path in source_files(tmp_path)] == [
        "src/a.py"
    ]


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.py", "", True),
        ("node", "#!/usr/bin/env python3\n", True),
        ("script", "#!/bin/sh\n", False),
        ("LICENSE", "python", False),
        ("a.txt", "#!/usr/bin/python3\n", False),
    ],
)
def test_python_is_known_by_suffix_or_first_line(
    tmp_path: Path, name: str, text: str, expected: bool
) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    assert is_python(path) is expected
    assert python_files(tmp_path) == ([path] if expected else [])


def test_an_unknown_check_is_refused_with_the_names(clone: Workspace) -> None:
    with pytest.raises(TridentError, match="no check 'pylint'; the checks are clang-format, ruff"):
        run_checks(clone, Runner(dry_run=True), ["pylint"])


def test_what_another_process_has_found_meanwhile_is_not_checked_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked: list[Path] = []

    def check(source: Path, *_: object) -> Result:
        checked.append(source)
        return Result(0, "")

    monkeypatch.setattr(tidy, "_check", check)
    unit, kept = CompileCommand(tmp_path / "a.cpp", ()), tmp_path / "cache" / "key"
    workspace = Workspace(tmp_path)
    for _ in range(2):
        found = tidy._check_once(tmp_path / "lock", [(unit, kept)], workspace, {})
        assert found == {unit.source: Result(0, "")}
    assert checked == [unit.source]


def test_a_file_that_another_process_checks_is_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "key"
    found = Result(1, "found by another")
    monkeypatch.setattr(tidy, "_check", lambda *_: pytest.fail("checked twice"))
    with ThreadPoolExecutor() as pool:
        with tidy._locked(kept):
            waiting = pool.submit(
                tidy._check_once,
                kept,
                [(CompileCommand(tmp_path / "a.cpp", ()), kept)],
                Workspace(tmp_path),
                {},
            )
            assert not waiting.done()
            tidy.store_result(kept, found)
        assert waiting.result(60.0) == {tmp_path / "a.cpp": found}


def _hiding(name: str) -> str:
    return f"namespace trident {{\nnamespace {{\nint {name}(int a) {{ return a; }}\n}}\n}}\n"


def test_hidden_names_are_those_of_unnamed_namespaces_and_macros() -> None:
    text = """
    #define LIMIT 3
    int open(int x);
    namespace trident { namespace {
    constexpr double kStep = std::max(0.1, other);  // double kOld = 1;
    const char* kText = "int quoted() {}";
    struct Part : Base { int inner(); };
    class Tool final {};
    std::vector<int> made(int a = 3) { int local = 0; return {local}; }
    }  // namespace
    void later() {}
    }
int main() {}
    """
    assert hidden_names(text) == {"LIMIT", "int main(", "kStep", "kText", "Part", "Tool", "made"}


def test_batches_are_of_equal_flags_and_hide_nothing_twice(tmp_path: Path) -> None:
    texts = {"a": _hiding("f"), "b": _hiding("f"), "c": _hiding("g"), "d": _hiding("h")}
    units = [CompileCommand(Path(name), ("-O2",)) for name in texts]
    units.append(CompileCommand(Path("other"), ("-O3",)))
    found = batches(units, 12, lambda path: texts.get(path.name, ""))
    names = [sorted(unit.source.name for unit in batch) for batch in found]
    assert sorted(name for batch in names for name in batch) == ["a", "b", "c", "d", "other"]
    assert ["other"] in names
    assert len(names) == 3
    assert not any({"a", "b"} <= set(batch) for batch in names)
    assert max(map(len, batches([*units[:1], *units[2:4]], 2, lambda _: ""))) == 2


@pytest.mark.parametrize("bad", [(), ("b",)])
def test_a_batch_with_findings_is_checked_by_halves(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, bad: tuple[str, ...]
) -> None:
    if shutil.which("clang-tidy") is None:
        pytest.fail("clang-tidy is in the list of packages and must be here")
    (tmp_path / ".clang-tidy").write_text(
        "Checks: '-*,bugprone-*'\nWarningsAsErrors: '*'\nHeaderFilterRegex: '.*'\n", "utf-8"
    )
    (tmp_path / "build").mkdir()
    units = []
    for name in ("a", "b", "c"):
        source = tmp_path / f"{name}.cpp"
        value = "x / 2" if name in bad else "x"
        source.write_text(f"double {name}(int x) {{ return {value}; }}\n", encoding="utf-8")
        units.append((CompileCommand(source, ()), tmp_path / "cache" / name))
    checked: list[str] = []
    check = tidy._check

    def counted(source: Path, *rest: Any) -> Result:
        checked.append(source.stem)
        return check(source, *rest)

    monkeypatch.setattr(tidy, "_check", counted)
    found = tidy._check_once(
        tmp_path / "cache" / "lock", units, Workspace(tmp_path), {**os.environ}
    )
    assert [source.stem for source in found if found[source].code] == list(bad)
    assert checked == (["batch", "a", "batch", "b", "c"] if bad else ["batch"])
    if bad:
        assert "b.cpp" in found[tmp_path / "b.cpp"].findings
