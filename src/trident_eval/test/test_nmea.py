# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
import json
import math
from pathlib import Path

import numpy as np
import pytest
from trident_eval.core.bridges.nmea import add_nmea, checksum, degrees, read_nmea
from trident_eval.core.bridges.nmea_plots import draw_nmea
from trident_eval.core.errors import EvalError
from trident_eval.core.report import verdict_rows
from trident_eval.core.verdict import Verdict

ORIGIN = (63.4389, 10.399, 0.0)
METERS_PER_MINUTE_NORTH = 1857.9  # at this latitude, within 1 m
DATE = "$GPRMC,000000.00,A,6326.33400,N,01023.94000,E,1.0,0.0,010126,,,R,S"


def sentence(text: str) -> str:
    return f"{text}*{checksum(text[1:]):02X}\r\n"


def fix(at_s: float, north_m: float, quality: int = 4) -> str:
    minutes = 26.334 + north_m / METERS_PER_MINUTE_NORTH
    return sentence(
        f"$GPGGA,0000{at_s:05.2f},63{minutes:08.5f},N,01023.94000,E,{quality},09,0.8,1.300,M,0.00,M,,"
    )


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """A boat that goes north at 1 m/s for 40 s, bow to the north, its antenna 1 m ahead."""
    rows = ["t,name,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz"]
    s = math.sin(math.pi / 4)
    for i in range(401):
        rows.append(f"{0.1 * i},usv1,0,{0.1 * i},0,0,0,{s},{s},0,1,0,0,0,0")
    (tmp_path / "states.csv").write_text("\n".join(rows) + "\n")
    about = {
        "vehicle": "usv1",
        "antenna": [1.0, 0.0, 1.3],
        "origin": list(ORIGIN),
        "utc_start": "2026-01-01T00:00:00Z",
    }
    (tmp_path / "usv1.nmea.json").write_text(json.dumps(about))
    return tmp_path


def write(run: Path, text: str) -> None:
    (run / "usv1.nmea").write_bytes(text.encode("latin1"))


def judged(run: Path) -> Verdict:
    verdict = Verdict({})
    add_nmea(verdict, run)
    return verdict


def test_positions_are_compared_with_the_antenna(run: Path) -> None:
    write(run, sentence(DATE) + "".join(fix(t, t + 1.0) for t in np.arange(5.0, 30.0, 0.2)))
    verdict = judged(run)
    assert verdict.passed, verdict.reasons
    (numbers,) = verdict.numbers["nmea"]
    assert numbers["rtk_fixed"] == 125
    assert numbers["position_max_m"] < 0.05
    assert numbers["height_max_m"] < 0.01
    assert numbers["types"] == {"GGA": 125, "RMC": 1}


def test_a_fixed_position_off_the_truth_fails(run: Path) -> None:
    write(run, sentence(DATE) + fix(5.0, 6.0) + fix(6.0, 7.2))
    verdict = judged(run)
    assert not verdict.passed
    assert "usv1, NMEA: an RTK fixed position 0.2" in verdict.reasons[0]


def test_a_single_fix_is_not_held_against_it(run: Path) -> None:
    write(run, sentence(DATE) + fix(5.0, 9.0, quality=1) + fix(6.0, 7.0))
    assert judged(run).passed


def test_without_a_fixed_position_it_fails(run: Path) -> None:
    write(run, sentence(DATE) + fix(5.0, 6.0, quality=1))
    assert "no RTK fixed position" in judged(run).reasons[0]


def test_a_wrong_date_fails(run: Path) -> None:
    write(run, sentence(DATE.replace("010126", "020126")) + fix(5.0, 6.0))
    assert "no RTK fixed position" in judged(run).reasons[0]


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("$GPGGA,000005.00*00\r\n", "1 lines that are no sentences"),
        ("$GPHDT,1.0,T\r\n", "1 lines that are no sentences"),
        (sentence("$GPGGA,000005.00"), "1 lines that are no sentences"),
        (sentence("$GPZDA,000005.00,x,1,2026"), "1 lines that are no sentences"),
        (sentence("$GPHDT,1.0,T").replace("\r", ""), "1 lines that are no sentences"),
        ("noise \x85\x0b of a line\r\n", "1 lines that are no sentences"),
        (sentence("$GPTXT," + "x" * 75), "a line of 87 characters"),
    ],
)
def test_lines_that_are_not_legal_fail(run: Path, line: str, reason: str) -> None:
    write(run, sentence(DATE) + fix(6.0, 7.0) + line)
    assert reason in judged(run).reasons[0]


def test_a_line_that_the_end_has_torn_is_no_fault(run: Path) -> None:
    write(run, sentence(DATE) + fix(6.0, 7.0) + "$GPGGA,0000")
    assert judged(run).passed


def test_a_run_without_nmea_stays_as_it_is(tmp_path: Path) -> None:
    verdict = judged(tmp_path)
    assert verdict.passed
    assert "nmea" not in verdict.numbers


def test_a_log_that_says_nothing_of_itself_is_named(run: Path) -> None:
    (run / "usv1.nmea.json").write_text("{}")
    write(run, fix(6.0, 7.0))
    with pytest.raises(EvalError, match=r"usv1\.nmea\.json: .*legal: what nmea_log\.py writes"):
        read_nmea(run)
    assert not judged(run).passed


def test_the_report_has_a_row_and_a_picture(run: Path, tmp_path: Path) -> None:
    write(run, sentence(DATE) + fix(5.0, 6.0, quality=5) + fix(6.0, 7.0))
    rows = {row.label: row for row in verdict_rows(judged(run).to_json())}
    assert rows["NMEA of usv1"].is_satisfied
    assert "3 sentences, 1 RTK fixed positions within" in rows["NMEA of usv1"].value
    assert [path.name for path in draw_nmea(read_nmea(run), tmp_path)] == ["nmea_usv1.png"]


def test_degrees_have_signs() -> None:
    assert degrees("6326.33400", "N") == pytest.approx(63.4389)
    assert degrees("01023.94000", "W") == pytest.approx(-10.399)
