# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest
from trident_tool import provision
from trident_tool.provision import (
    link_workspace,
    missing_packages,
    parse_dpkg_status,
    parse_package_list,
    pinned_requirements,
    venv_key,
)
from trident_tool.workspace import Runner, TridentError, Workspace

TOOLS = Path(__file__).resolve().parents[1]


def test_package_list_skips_comments_and_blank_lines() -> None:
    assert parse_package_list("# head\n\ncmake  # builds\nlibode-dev\n") == ["cmake", "libode-dev"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("cmake\nlibode dev\n", "list:2: one package name per line, found 'libode dev'"),
        ("cmake\n\ncmake\n", "list:3: 'cmake' is listed twice"),
    ],
)
def test_package_list_names_the_wrong_line(text: str, message: str) -> None:
    with pytest.raises(TridentError, match=message):
        parse_package_list(text, "list")


def test_shipped_package_list_is_valid() -> None:
    text = (TOOLS / "apt-packages.txt").read_text(encoding="utf-8")
    assert "catkin" in parse_package_list(text)


def test_shipped_requirements_are_all_pinned() -> None:
    lines = pinned_requirements(TOOLS / "requirements.txt")
    assert lines
    assert all(line.count("==") == 1 for line in lines)


def test_only_completely_installed_packages_count() -> None:
    status = "cmake\tii \nninja-build\trc \ngit\tiF \nbroken line\n"
    assert parse_dpkg_status(status) == {"cmake"}


def test_missing_packages_keep_their_order() -> None:
    assert missing_packages(["b", "a", "c"], {"a"}) == ["b", "c"]


def test_venv_key_changes_with_place_requirements_and_interpreter(clone: Workspace) -> None:
    other = Workspace(clone.root / "moved")
    keys = {
        venv_key(clone, "a==1", "3.11.2"),
        venv_key(other, "a==1", "3.11.2"),
        venv_key(clone, "a==2", "3.11.2"),
        venv_key(clone, "a==1", "3.12.0"),
    }
    assert len(keys) == 4
    assert venv_key(clone, "a==1", "3.11.2") == venv_key(Workspace(clone.root), "a==1", "3.11.2")


def _list_packages(clone: Workspace, *names: str) -> None:
    (clone.root / "tools" / "apt-packages.txt").write_text("\n".join(names), encoding="utf-8")


def test_nothing_is_installed_twice(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _list_packages(clone, "cmake", "git")
    monkeypatch.setattr(provision, "installed_packages", lambda: {"cmake", "git"})
    provision.install_apt(clone, Runner(dry_run=True))
    assert capsys.readouterr().out == ""


def test_only_what_is_missing_is_installed(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _list_packages(clone, "cmake", "git")
    monkeypatch.setattr(provision, "installed_packages", lambda: {"git"})
    monkeypatch.setattr("os.geteuid", lambda: 0)
    provision.install_apt(clone, Runner(dry_run=True))
    install = capsys.readouterr().out.splitlines()[-1]
    assert install.startswith("would run: ")
    assert install.endswith("install -y --no-install-recommends cmake")


def test_without_root_and_sudo_the_message_says_what_to_do(
    clone: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    _list_packages(clone, "cmake", "git")
    monkeypatch.setattr(provision, "installed_packages", lambda: {"git"})
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(TridentError, match=r"as root, run once: apt-get install .*cmake"):
        provision.install_apt(clone, Runner(dry_run=True))


def test_venv_is_left_alone_when_its_stamp_fits(
    clone: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    requirements = clone.root / "tools" / "requirements.txt"
    requirements.write_text("a==1\n", encoding="utf-8")
    provision.install_venv(clone, Runner(dry_run=True))
    assert "-m venv --system-site-packages" in capsys.readouterr().out
    version = ".".join(map(str, __import__("sys").version_info[:3]))
    clone.venv.mkdir()
    (clone.venv / ".trident-stamp").write_text(venv_key(clone, "a==1\n", version), encoding="utf-8")
    provision.install_venv(clone, Runner(dry_run=True))
    assert capsys.readouterr().out == ""


def test_the_python_of_the_clone_finds_what_is_built(clone: Workspace) -> None:
    link_workspace(clone)  # nothing to link in yet
    source = clone.root / "src" / "fleet" / "src"
    (source / "fleet").mkdir(parents=True)
    (source / "fleet" / "py.typed").touch()
    site = clone.venv / "lib" / "python3.11" / "site-packages"
    site.mkdir(parents=True)
    link_workspace(clone)
    link = site / "trident.pth"
    packages = clone.devel / "lib" / "python3" / "dist-packages"
    assert link.read_text(encoding="utf-8") == f"{source}\n{packages}\n"
    before = link.stat().st_mtime_ns
    link_workspace(clone)
    assert link.stat().st_mtime_ns == before, "what is done is not done again"
    link.write_text("/elsewhere\n", encoding="utf-8")  # the clone was moved
    link_workspace(clone)
    assert "elsewhere" not in link.read_text(encoding="utf-8")
