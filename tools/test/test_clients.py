# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import shutil
from pathlib import Path

import pytest
from trident_tool import clients
from trident_tool.clients import install_clients, provide_clients
from trident_tool.provision import pinned_requirements
from trident_tool.workspace import Runner, TridentError, Workspace

TOOLS = Path(__file__).resolve().parents[1]
REQUIREMENTS = TOOLS / "requirements-clients.txt"


@pytest.fixture
def listed(clone: Workspace) -> Workspace:
    """A clone with the shipped list of clients."""
    shutil.copy(REQUIREMENTS, clone.root / "tools")
    return clone


def test_shipped_clients_are_all_pinned() -> None:
    lines = pinned_requirements(REQUIREMENTS)
    assert lines
    assert all(line.count("==") == 1 for line in lines)


def test_clients_get_an_environment_of_their_own(
    listed: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    install_clients(listed, Runner(dry_run=True))
    out = capsys.readouterr().out
    assert f"-m venv {listed.clients_venv}" in out
    assert "--no-deps -r" in out
    assert "--system-site-packages" not in out


def _break(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise TridentError("installing the clients failed")

    monkeypatch.setattr(clients, "install_clients", fail)


def test_without_a_network_tests_are_skipped_loudly(
    listed: Workspace, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _break(monkeypatch)
    provide_clients(listed, Runner(), {})
    assert "skipped. Later: ./trident setup --clients" in capsys.readouterr().err


def test_where_ci_is_true_missing_clients_are_an_error(
    listed: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    _break(monkeypatch)
    with pytest.raises(TridentError, match="installing the clients failed"):
        provide_clients(listed, Runner(), {"CI": "true"})
