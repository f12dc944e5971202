# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sends hostile messages and calls to running nodes, and says what became of them.

Exit code 0: all have stood it; 1: not; 2: a node cannot be treated.
"""

from __future__ import annotations

import argparse
import sys

import rospy

from trident.testing.fuzz.campaign import Campaign, CampaignOptions
from trident.testing.fuzz.target import Target


def parse(words: list[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="fuzz_node", description=__doc__)
    parser.add_argument("node", nargs="+", help="full name of a running node")
    parser.add_argument("--messages", type=int, default=10_000, help="to each node")
    parser.add_argument("--first", type=int, default=0, help="number of the first message")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--service-share", type=float, default=0.1, help="part that are calls")
    parser.add_argument("--skip", action="append", default=[], help="topic or service, may have *")
    parser.add_argument(
        "--word", action="append", default=[], help="that means something: a frame, a model"
    )
    return parser.parse_args(words)


def main() -> int:
    """Treat one node after the other.

    Returns:
        Exit code of the process.
    """
    arguments = parse(rospy.myargv()[1:])
    rospy.init_node("fuzz_node", anonymous=True, disable_signals=True)
    options = CampaignOptions(
        messages=arguments.messages,
        first=arguments.first,
        seed=arguments.seed,
        service_share=arguments.service_share,
        words=tuple(arguments.word),
    )
    has_problems = False
    for name in arguments.node:
        try:
            found = Campaign(Target(name, arguments.skip), options).run()
        except (LookupError, AssertionError) as error:
            print(f"fuzz_node: {error}", file=sys.stderr)
            return 2
        print(f"{name}: {found.text()}")
        has_problems = has_problems or bool(found.problems)
    return 1 if has_problems else 0


if __name__ == "__main__":
    sys.exit(main())
