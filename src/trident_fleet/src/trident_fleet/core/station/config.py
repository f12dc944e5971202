# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a base station of the air: one schema, validated at load."""

from __future__ import annotations

from dataclasses import dataclass, field

from trident_base.params import named, require

from trident_fleet.core.config import check_positive
from trident_fleet.core.errors import FormationError


@dataclass(frozen=True)
class PilotConfig:
    """How the UAV moves.

    Attributes:
        v_max: speed [m/s].
        a_max: acceleration, and deceleration at need [m/s^2].
        margin_m: set-points keep so far from the fence's faces [m].
        separation_m: set-points keep so far from the robots that are named [m].
        others_v_max: how fast those may have moved in the time since they were heard, of which 2 s
            count at most [m/s].
    """

    v_max: float = 5.0
    a_max: float = 2.5
    margin_m: float = named(1.0, "margin")
    separation_m: float = named(5.0, "separation")
    others_v_max: float = 3.0

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self, allow_zero=("margin_m", "separation_m", "others_v_max"))


@dataclass(frozen=True)
class FieldConfig:
    """What is believed of a link before anything was measured.

    The SNR is that of free space, off by a level and an exponent that are fitted, plus shadowing,
    which is correlated over the places of both ends (Gudmundson 1991).

    Attributes:
        level_db: SNR at 1 m in free space [dB]: transmitted power and both antennas' gains less
            the noise less 46.8 dB at 5.2 GHz.
        level_sigma_db: how far that may be off, standard deviation [dB].
        exponent_sigma: of the exponent, which is 2 in free space.
        shadow_sigma_db: of the shadowing [dB].
        decorrelation_m: distance at which its correlation has fallen to 1/e [m].
        blocked_sigma_db: of what obstacles take away, which depends on the direction from the other
            robot [dB].
        view_rad: angle at which its correlation has fallen to 1/e [rad].
        noise_db: of a measurement [dB].
        unheard_db: what a link counts that is not heard at all [dB].
    """

    level_db: float = named(61.0, "level")
    level_sigma_db: float = named(10.0, "level_sigma")
    exponent_sigma: float = 0.3
    shadow_sigma_db: float = named(3.0, "shadow_sigma")
    decorrelation_m: float = named(8.0, "decorrelation_distance")
    blocked_sigma_db: float = named(3.0, "blocked_sigma")
    view_rad: float = named(0.3, "view_angle")
    noise_db: float = named(0.3, "snr_noise")
    unheard_db: float = named(-5.0, "unheard_snr")

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        require("level", self.level_db, -100.0, 200.0, "dB", FormationError)
        require("unheard_snr", self.unheard_db, -50.0, 30.0, "dB", FormationError)
        shown = FieldConfig(**{**self.__dict__, "level_db": 0.0, "unheard_db": 0.0})
        check_positive(
            shown, allow_zero=("level_db", "unheard_db", "exponent_sigma", "blocked_sigma_db")
        )


@dataclass(frozen=True)
class SearchConfig:
    """How the best place is looked for.

    Attributes:
        survey_s: longest flight over all of the fence [s].
        refine_s: longest flight about the best places of it [s].
        gain_db: expected gain of a next place below which a flight ends earlier [dB]; 0: never.
        places: among which the next one is chosen.
        needed_db: the survey leaves places aside whose worst link is expected below [dB], as long
            as there are others.
        detour_s: time that a place costs besides the flight there [s]; higher: farther places.
        drop_db: the search begins again when the worst link stays so far below what was found [dB].
        moved_m: ... or a robot has moved so far since [m].
        still_s: a robot that has not moved by half of that for so long stands [s].
    """

    survey_s: float = named(240.0, "survey_time")
    refine_s: float = named(90.0, "refine_time")
    gain_db: float = named(0.0, "search_gain")
    places: int = named(2500, "search_places")
    needed_db: float = named(8.0, "needed_snr")
    detour_s: float = named(2.0, "detour_time")
    drop_db: float = named(6.0, "snr_drop")
    moved_m: float = named(6.0, "moved_distance")
    still_s: float = named(4.0, "still_time")

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self, allow_zero=("survey_s", "refine_s", "gain_db", "needed_db"))
        require("search_places", self.places, 20, 20000, "", FormationError)


@dataclass(frozen=True)
class StationConfig:
    """All numbers of a base station.

    Attributes:
        ground_s: wait before the take-off [s].
        yaw_rad: heading [rad, world].
        return_battery: state of charge, 0 to 1, at which it flies home and lands.
        lost_link_s: none of the links was heard for so long: it flies back along its path [s].
        pilot: how it moves.
        links: what is believed of the links.
        search: how the best place is looked for.
    """

    ground_s: float = named(0.5, "ground_time")
    yaw_rad: float = 0.0
    return_battery: float = 0.25
    lost_link_s: float = named(5.0, "lost_link")
    pilot: PilotConfig = field(default_factory=PilotConfig)
    links: FieldConfig = field(default_factory=FieldConfig)
    search: SearchConfig = field(default_factory=SearchConfig)

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        require("return_battery", self.return_battery, 0.0, 1.0, "", FormationError)
        shown = StationConfig(**{**self.__dict__, "return_battery": 1.0, "yaw_rad": 0.0})
        check_positive(shown, allow_zero=("ground_s", "yaw_rad"))
        for part in (self.pilot, self.links, self.search):
            part.validate()
