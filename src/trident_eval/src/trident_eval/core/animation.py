# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The plan view of a run as a moving picture (GIF)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.plots import MANY, color, outline_of
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array

FRAMES_PER_S = 12.5  # GIF counts in hundredths of a second
_LONGEST_S = 14.0
_WIDTH_INCH, _HEIGHTS_INCH = 7.2, (3.6, 7.2)
_DPI = 100
_COLORS_OF_GIF = 96
_NEARLY_WHITE = 240
_TRAIL_S = 6.0


@dataclass(frozen=True)
class Pace:
    """Which instants become frames.

    Attributes:
        index: into the scene's instants, one per frame, shape (F,).
        faster: how many times faster than the simulated time the picture runs.
    """

    index: Any
    faster: float


def pace(time: Array) -> Pace:
    """Frames for simulated times [s], shape (M,): real time, or as fast as the length limit asks.

    Raises:
        EvalError: there are not two instants.
    """
    if len(time) < 2:
        raise EvalError("an animation needs at least two recorded instants")
    duration = float(time[-1] - time[0])
    faster = max(1.0, float(np.ceil(duration / _LONGEST_S)))
    frames = max(2, round(duration / faster * FRAMES_PER_S) + 1)
    wanted = np.linspace(time[0], time[-1], frames)
    after = np.searchsorted(time, wanted).clip(1, len(time) - 1)
    nearer = wanted - time[after - 1] < time[after] - wanted
    return Pace(np.where(nearer, after - 1, after), faster)


def animate(scene: Scene, path: Path, progress: Callable[[int, int], None] | None = None) -> Path:
    """Draw the plan view of a scene in time.

    Args:
        scene: what to show.
        path: of the GIF file.
        progress: called with the numbers of frames drawn and in all.

    Returns:
        The file.

    Raises:
        EvalError: the scene holds no motion.
    """
    import matplotlib

    matplotlib.use("Agg")
    from PIL import Image

    frames = pace(scene.tracks.time)
    with matplotlib.rc_context({"font.size": 10, "legend.frameon": False}):
        view = _PlanView(scene, frames.faster)
        images = []
        for count, index in enumerate(frames.index, 1):
            images.append(Image.fromarray(view.draw(int(index))))
            if progress:
                progress(count, len(frames.index))
    # One palette for all frames, so that nothing that stands still flickers.
    palette = _with_white(images[len(images) // 2].quantize(_COLORS_OF_GIF))
    reduced = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    period_ms = round(1000.0 / FRAMES_PER_S)
    durations = [period_ms] * (len(reduced) - 1) + [1500]  # the end stays for a while
    reduced[0].save(
        path, save_all=True, append_images=reduced[1:], duration=durations, loop=0, optimize=False
    )
    return path


def _with_white(image: Any) -> Any:
    """The image, with what is nearly white in its palette white: Pillow's matching is coarse."""
    colors = np.array(image.getpalette()).reshape(-1, 3)
    colors[colors.min(axis=1) > _NEARLY_WHITE] = 255
    image.putpalette(colors.ravel().tolist())
    return image


class _PlanView:
    """The picture: what stands still is drawn once, what moves is drawn over it."""

    def __init__(self, scene: Scene, faster: float) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        self._scene = scene
        self._formation_error = scene.formation_error()
        low, high = _extent(scene)
        width, depth = high - low
        height_inch = float(np.clip(_WIDTH_INCH * depth / width, *_HEIGHTS_INCH))
        figure = Figure(figsize=(_WIDTH_INCH, height_inch), dpi=_DPI, layout="constrained")
        self._canvas = FigureCanvasAgg(figure)
        self._axes = figure.add_subplot()
        self._axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        self._axes.set_title(f"{scene.title}  (×{faster:g})\n", fontsize=10)
        self._draw_ground()
        self._moving = self._add_moving()
        self._canvas.draw()
        self._ground = self._canvas.copy_from_bbox(figure.bbox)

    def _draw_ground(self) -> None:
        axes, tracks = self._axes, self._scene.tracks
        axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="#DDDDDD", linewidth=0.7)
        axes.set_axisbelow(True)
        for index in range(len(tracks.names)):
            x, y, _ = tracks.position[:, index].T
            axes.plot(x, y, color="#CCCCCC", linewidth=1.0)

    def _add_moving(self) -> dict[str, Any]:
        axes, names = self._axes, self._scene.tracks.names
        count = range(len(names))
        style: dict[str, Any] = {"animated": True}
        labels = names if len(names) <= MANY else []
        return {
            "trails": [axes.plot([], [], color=color(i), linewidth=2.0, **style)[0] for i in count],
            "outline": axes.plot([], [], color="#777777", linewidth=1.0, **style)[0],
            "commands": axes.plot([], [], "o", mfc="none", mec="#222222", ms=9, **style)[0],
            "vehicles": [
                axes.plot([], [], "o", color=color(i), markersize=6, **style)[0] for i in count
            ],
            "names": [
                axes.annotate(name, (0, 0), (6, 6), textcoords="offset points", fontsize=8, **style)
                for name in labels
            ],
            "clock": axes.text(0.5, 1.015, "", transform=axes.transAxes, ha="center", **style),
        }

    def draw(self, index: int) -> Any:
        """The picture at an instant of the scene, shape (height, width, 3), 8 bit."""
        self._move(index)
        self._canvas.restore_region(self._ground)
        for artists in self._moving.values():
            for artist in artists if isinstance(artists, list) else [artists]:
                self._axes.draw_artist(artist)
        return np.array(self._canvas.buffer_rgba())[..., :3].copy()

    def _move(self, index: int) -> None:
        tracks, moving = self._scene.tracks, self._moving
        now = tracks.position[index]
        begin = int(np.searchsorted(tracks.time, tracks.time[index] - _TRAIL_S))
        for vehicle, (trail, dot) in enumerate(
            zip(moving["trails"], moving["vehicles"], strict=True)
        ):
            x, y, _ = tracks.position[begin : index + 1, vehicle].T
            trail.set_data(x, y)
            dot.set_data(x[-1:], y[-1:])
        for name, place in zip(moving["names"], now, strict=False):
            is_there = bool(np.isfinite(place).all())
            name.set_visible(is_there)
            name.xy = place[:2] if is_there else (0.0, 0.0)
        known = now[np.isfinite(now).all(axis=1)]
        outline = outline_of(known) if len(known) > 1 else np.empty((0, 3))
        moving["outline"].set_data(outline[:, 0], outline[:, 1])
        if self._scene.commanded is not None:
            moving["commands"].set_data(*self._scene.commanded[index, :, :2].T)
        moving["clock"].set_text(self._words(index, known))

    def _words(self, index: int, known: Array) -> str:
        words = [f"t = {self._scene.tracks.time[index]:5.1f} s"]
        if len(known):
            words.append(f"height {known[:, 2].mean():.2f} m")
        if self._formation_error is not None and np.isfinite(self._formation_error[index]):
            words.append(f"formation error {100.0 * self._formation_error[index]:.1f} cm")
        return "   ".join(words)


def _extent(scene: Scene) -> tuple[Array, Array]:
    """Corners of what is to be seen [m], each of shape (2,).

    Raises:
        EvalError: there is no position.
    """
    xy = scene.tracks.position[..., :2]
    finite = xy[np.isfinite(xy).all(axis=-1)]
    if not len(finite):
        raise EvalError(f"{scene.title}: no finite position; an animation needs some")
    low, high = finite.min(axis=0), finite.max(axis=0)
    margin = 0.08 * max(float((high - low).max()), 4.0)
    return low - margin, high + margin
