# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Hostile messages for a running node: every subscriber and every service of it, by introspection.

In a test:

    campaign = Campaign(Target("/amcl"), CampaignOptions(messages=10_000, seed=1), examples)
    found = campaign.run()
    assert not found.problems, found.text()

Nodes that call services get hostile answers from a `HostileServer`.

By hand, on a node that runs anywhere: `rosrun trident_testing fuzz_node /amcl --messages 100000`.
"""

from trident.testing.fuzz.campaign import Campaign, CampaignOptions, Findings
from trident.testing.fuzz.finite import non_finite
from trident.testing.fuzz.generator import Generator
from trident.testing.fuzz.server import HostileServer
from trident.testing.fuzz.target import Target

__all__ = [
    "Campaign",
    "CampaignOptions",
    "Findings",
    "Generator",
    "HostileServer",
    "Target",
    "non_finite",
]
