# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node observer: pictures and films of a running simulation, for those who have no display.

It puts a camera into the world, writes what that sees as PNG files or as one MP4 film, and takes
it away again. The world has to run: a picture is drawn at a step.
"""

from __future__ import annotations

import argparse
import math
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

import rospy
from PIL import Image as Picture
from trident_eval.core.errors import EvalError

from trident_viewer.film import Film
from trident_viewer.observer_camera import (
    Observer,
    Place,
    View,
    WorldStandsError,
    pixels_of,
    place_of,
)

_FILM = ".mp4"
_NEAR = View((-1.6, -1.2, 1.0), (0.0, 0.0, 0.1))
_INTERRUPTED = 130  # as a shell says it


def main(arguments: list[str] | None = None) -> int:
    """Run to the end.

    Returns:
        0: written; 1: not, and the reason has been reported; 130: interrupted, a film holds what
        was seen.
    """
    options = _parser().parse_args(rospy.myargv(arguments or sys.argv)[1:])
    rospy.init_node("observer", anonymous=True, disable_signals=True)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # the camera is taken away, too
    try:
        _check(options)
        film = None
        if options.out.suffix == _FILM:
            film = Film(options.out, *_size(options.size), options.fps, options.seconds)
        with Observer(_view(options)) as observer:
            if film is not None:
                return _show(observer, film, options)
            _write(observer, options)
    except EvalError as error:
        print(f"observer: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return _INTERRUPTED
    return 0


def _view(options: argparse.Namespace) -> View:
    named = options.model or options.follow
    place = place_of(named, options.wait) if named else (0.0, 0.0, 0.0)
    about = place if options.model else (0.0, 0.0, 0.0)
    near = _NEAR if named else View()
    width, height = _size(options.size)
    return View(
        _sum(about, options.place or near.place),
        _sum(about, options.at or near.target),
        width,
        height,
        math.radians(options.fov),
        options.fps if options.out.suffix == _FILM else View.rate_hz,
        options.follow,
    )


def _sum(a: Sequence[float], b: Sequence[float]) -> Place:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="observer", description=__doc__)
    axes = ("X", "Y", "Z")
    parser.add_argument("--from", dest="place", nargs=3, type=float, metavar=axes, help="[m]")
    parser.add_argument("--at", nargs=3, type=float, metavar=axes, help="looked at [m]")
    about = parser.add_mutually_exclusive_group()
    about.add_argument("--model", metavar="NAME", help="both from where this model is now")
    about.add_argument("--follow", metavar="NAME", help="both from where this model is, always")
    parser.add_argument("--fov", type=float, default=70.0, metavar="DEG", help="horizontal")
    parser.add_argument("--size", default="960x600", metavar="WxH", help="pixels; 960x600")
    parser.add_argument(
        "--out", type=Path, default=Path("observer.png"), metavar="FILE.png|FILE.mp4"
    )
    pictures = parser.add_argument_group("pictures (.png)")
    pictures.add_argument(
        "--count", type=int, default=1, help="how many; from two on FILE_0000.png, …"
    )
    pictures.add_argument(
        "--every", type=float, default=1.0, metavar="S", help="of simulated time; default 1"
    )
    film = parser.add_argument_group("film (.mp4, through ffmpeg)")
    film.add_argument(
        "--seconds", type=float, default=10.0, metavar="S", help="of simulated time; default 10"
    )
    film.add_argument(
        "--fps", type=float, default=25.0, help="frames per second of simulated time; default 25"
    )
    parser.add_argument(
        "--wait", type=float, default=0.0, metavar="S", help="for the model to come; default 0"
    )
    parser.add_argument(
        "--limit", type=float, default=30.0, metavar="S", help="of wall-clock time per picture"
    )
    return parser


def _size(text: str) -> tuple[int, int]:
    try:
        width, height = (int(word) for word in text.split("x"))
    except ValueError as error:
        raise EvalError(f"--size: '{text}', legal: WIDTHxHEIGHT") from error
    return width, height


def _check(options: argparse.Namespace) -> None:
    if options.out.suffix not in (".png", _FILM):
        raise EvalError(f"--out {options.out}: suffix '{options.out.suffix}', legal: .png, .mp4")
    if not options.out.resolve().parent.is_dir():
        raise EvalError(f"--out {options.out}: its folder does not exist")
    if options.count < 1:
        raise EvalError(f"--count {options.count}, legal: 1 or more")
    for name in ("every", "seconds", "limit"):
        value = getattr(options, name)
        if not 0.0 < value < math.inf:
            raise EvalError(f"--{name} {value:g} s, legal: more than 0")


def _write(observer: Observer, options: argparse.Namespace) -> None:
    after_s = 0.0
    for number in range(options.count):
        image = observer.picture(after_s, options.limit)
        after_s = image.header.stamp.to_sec() + options.every
        path: Path = options.out
        if options.count > 1:
            path = path.with_stem(f"{path.stem}_{number:04d}")
        Picture.fromarray(pixels_of(image), "RGB").save(path)
        print(f"{path}: t = {image.header.stamp.to_sec():.3f} s", flush=True)


def _show(observer: Observer, film: Film, options: argparse.Namespace) -> int:
    """Writes the film; one that is interrupted, or whose world stops, ends there.

    Raises:
        EvalError: there is not one picture; ffmpeg is missing or failed.
    """
    code = 0
    with film:
        try:
            while not film.is_full:
                image = observer.picture(0.0, options.limit)
                film.add(pixels_of(image), image.header.stamp.to_sec())
        except WorldStandsError as error:
            if film.seconds == 0.0:
                raise
            print(f"observer: the film ends early: {error}", file=sys.stderr)
        except KeyboardInterrupt:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # the film is finished, however often
            code = _INTERRUPTED
    lost = f", {film.missing} frames repeat what came before" if film.missing else ""
    print(f"{options.out}: {film.seconds:g} s of simulated time{lost}", flush=True)
    return code
