# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "cmake" / "modernise_message_headers.py"
OLD = "typename ContainerAllocator::template rebind<{}>::other"
NEW = "typename std::allocator_traits<ContainerAllocator>::template rebind_alloc<{}>"


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("modernise_message_headers", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_nested_uses_are_replaced_and_the_rest_is_kept(script: ModuleType) -> None:
    inner = "std::basic_string<char, std::char_traits<char>, {} > "
    old = OLD.format(inner.format(OLD.format("char")))
    new = NEW.format(inner.format(NEW.format("char")))
    assert (
        script.modernise(f"std::vector<X, {old} > a;\nint b;")
        == f"std::vector<X, {new} > a;\nint b;"
    )
    assert script.modernise("no allocator here") == "no allocator here"


@pytest.mark.parametrize(
    "text", [OLD.format("char")[:-7], OLD.format("char").replace("other", "x")]
)
def test_an_unknown_form_is_refused(script: ModuleType, text: str) -> None:
    with pytest.raises(ValueError, match=r"rebind|unclosed"):
        script.modernise(text)


def _add_header(include: Path, package: str, text: str) -> Path:
    header = include / package / "A.h"
    header.parent.mkdir(parents=True, exist_ok=True)
    header.write_text(text, encoding="utf-8")
    return header


def test_siblings_are_included_by_their_full_names(script: ModuleType, tmp_path: Path) -> None:
    text = '#include "types.h"\n#include "ros/time.h"\n'
    _add_header(tmp_path / "include", "ros", text + OLD.format("T"))
    (tmp_path / "share").mkdir()
    script.main(tmp_path / "share", tmp_path / "include", tmp_path / "output")
    copy = (tmp_path / "output" / "ros" / "A.h").read_text(encoding="utf-8")
    assert copy == '#include <ros/types.h>\n#include "ros/time.h"\n' + NEW.format("T")


def test_only_old_headers_of_ros_packages_are_copied(script: ModuleType, tmp_path: Path) -> None:
    share, include, output = tmp_path / "share", tmp_path / "include", tmp_path / "output"
    for package in ("old_msgs", "new_msgs"):
        (share / package).mkdir(parents=True)
        (share / package / "package.xml").touch()
    old = _add_header(include, "old_msgs", OLD.format("char"))
    _add_header(include, "new_msgs", NEW.format("char"))
    _add_header(include, "not_ros", OLD.format("char"))
    script.main(share, include, output)
    (copy,) = output.rglob("*.h")
    assert copy.relative_to(output) == old.relative_to(include)
    assert copy.read_text(encoding="utf-8") == NEW.format("char")

    made = copy.stat().st_mtime_ns
    script.main(share, include, output)
    assert copy.stat().st_mtime_ns == made
    _add_header(include, "old_msgs", "upgraded")
    script.main(share, include, output)
    assert not copy.exists()
