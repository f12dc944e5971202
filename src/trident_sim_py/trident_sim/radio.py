# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The radios of a world, and what they send each other."""

from __future__ import annotations

from dataclasses import dataclass

from trident_sim._core import (
    Error,
    Session,
    has_radio,
    radio_links,
    radio_names,
    radio_receive,
    radio_send,
    radio_set_outage,
)


@dataclass(frozen=True)
class RadioMessage:
    """What a radio has received.

    Attributes:
        source: name of the radio that sent it.
        data: as it was sent.
        sent: when it was given to that radio, simulated [s].
        received: when it came from this one, simulated [s].
        snr: signal over noise of the frame that brought it [dB].
    """

    source: str
    data: bytes
    sent: float
    received: float
    snr: float


@dataclass(frozen=True)
class RadioLink:
    """From one radio to another: how it is now, and what became of what was sent.

    Attributes:
        source: name of the radio that sends.
        destination: name of the one that receives.
        distance: from antenna to antenna [m].
        loss: between the antennas' connectors [dB]; inf: they cannot hear each other.
        snr: signal over noise at the destination [dB]; -inf: as above.
        mcs: modulation and coding scheme that frames have now.
        sent: messages that were given to the source.
        delivered: messages that have arrived.
        lost: messages that were given up after all tries.
        expired: messages that were too old before they could be sent.
        refused: messages for which the queue had no room.
        mean_delay: of what was delivered [s].
    """

    source: str
    destination: str
    distance: float
    loss: float
    snr: float
    mcs: int
    sent: int
    delivered: int
    lost: int
    expired: int
    refused: int
    mean_delay: float


class Radio:
    """All radios of a world (libtrident_radio.so) and the air between them.

    They have the names of their robots. Messages travel while the world steps. Whether one arrives
    depends on the seed, the places and what else is on the air, and not on who asks.
    """

    def __init__(self, session: Session) -> None:
        if not has_radio(session):
            raise Error("the world has no radios, legal: one with libtrident_radio_medium.so")
        self._session = session

    @property
    def names(self) -> list[str]:
        """Of the radios, in alphabetical order."""
        return radio_names(self._session)

    def send(
        self,
        source: str,
        destination: str,
        data: bytes,
        *,
        priority: int = 1,
        deadline: float = 0.0,
    ) -> bool:
        """Gives a message to a radio now.

        Args:
            source: name of the radio.
            destination: another radio, which acknowledges; or "all": once to everybody in reach.
            data: at most 11,000 bytes.
            priority: 0 (goes first) to 3.
            deadline: dropped when it was not sent after this time [s]; 0: never.

        Returns:
            False where the queue of that priority is full.

        Raises:
            Error: an unknown name, or a value out of its range.
        """
        return radio_send(self._session, source, destination, data, priority, deadline)

    def receive(self, name: str) -> list[RadioMessage]:
        """What has come to a radio by now and was not asked for before, oldest first.

        Raises:
            Error: an unknown name.
        """
        return [RadioMessage(*fields) for fields in radio_receive(self._session, name)]

    def links(self, source: str = "") -> list[RadioLink]:
        """Every radio to every other one, or those from one, by their names.

        Args:
            source: name of a radio; "": all of them.

        Raises:
            Error: an unknown name.
        """
        return [RadioLink(*fields) for fields in radio_links(self._session, source)]

    def set_outage(self, name: str, out: bool, other: str = "") -> None:
        """Switches a radio off, so that it neither sends nor hears, or on again.

        Args:
            name: of the radio.
            out: off.
            other: a second radio: the two do not hear each other, and each still hears others.

        Raises:
            Error: an unknown name.
        """
        radio_set_outage(self._session, name, out, other)
