# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Looks at a run, a bag or a world in rviz; without a display, off-screen into a PNG file."""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from trident_tool.environment import ros_environment
from trident_tool.framebuffer import Image, read_xwd, write_png
from trident_tool.running import free_port
from trident_tool.shell import master_answers, running_master
from trident_tool.workspace import Runner, TridentError, Workspace, say

_SCREEN = "1600x1000x24"
_POLL_S = 0.5
_SETTLED_POLLS = 4  # equal pictures in a row before one is kept
_MIN_WALL_S = 8.0  # rviz paints an empty scene first and adds displays as their messages come
_TIMEOUT_S = 60.0


def pick_config(workspace: Workspace, name: str | None) -> Path | None:
    """The rviz configuration ``name`` of config/rviz, or the first one there.

    Raises:
        TridentError: there is no configuration of that name.
    """
    folder = workspace.root / "config" / "rviz"
    known = sorted(folder.glob("*.rviz"))
    if name is None:
        return known[0] if known else None
    if Path(name).is_file():
        return Path(name)
    for path in known:
        if name in (path.name, path.stem):
            return path
    names = ", ".join(path.stem for path in known) or "none"
    raise TridentError(f"there is no rviz configuration {name!r} in {folder} (it has: {names})")


def source_commands(source: Path | None) -> list[list[str]]:
    """Commands that feed rviz from ``source``: a bag is played, a world is simulated.

    Raises:
        TridentError: the source does not exist or is neither.
    """
    if source is None:
        return []
    if not source.exists():
        raise TridentError(f"{source} does not exist")
    if source.suffix == ".bag":
        return [["rosbag", "play", "--clock", "--quiet", str(source)]]
    if source.suffix in (".world", ".sdf"):
        world = f"world_name:={source.resolve()}"
        return [["roslaunch", "gazebo_ros", "empty_world.launch", "gui:=false", world]]
    raise TridentError(f"{source}: view shows a .bag, a .world or an .sdf file")


@contextlib.contextmanager
def _started(command: Sequence[str], env: dict[str, str]) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        command,
        env=env,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(10.0)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextlib.contextmanager
def _virtual_screen(folder: Path) -> Iterator[tuple[str, Path]]:
    """An X server without a display; gives its name and the file that holds its picture.

    Raises:
        TridentError: Xvfb did not start.
    """
    read_end, write_end = os.pipe()
    command = ["Xvfb", "-displayfd", str(write_end), "-screen", "0", _SCREEN, "-fbdir", str(folder)]
    process = subprocess.Popen(
        [*command, "-nolisten", "tcp"],
        pass_fds=[write_end],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write_end)
    try:
        with os.fdopen(read_end) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise TridentError("Xvfb did not start")
        yield f":{number}", folder / "Xvfb_screen0"
    finally:
        process.terminate()
        process.wait()


def _wait_for_picture(screen: Path, viewer: subprocess.Popen[bytes]) -> Image:
    """The picture of ``screen`` once it shows something and has stopped changing.

    Raises:
        TridentError: rviz ended, or the screen stayed blank.
    """
    started = time.monotonic()
    last = read_xwd(screen.read_bytes())
    equal = 0
    while (wall_s := time.monotonic() - started) < _TIMEOUT_S:
        if viewer.poll() is not None:
            raise TridentError(f"rviz ended with exit code {viewer.returncode}")
        time.sleep(_POLL_S)
        picture = read_xwd(screen.read_bytes())
        equal = equal + 1 if picture == last else 0
        last = picture
        if wall_s >= _MIN_WALL_S and equal >= _SETTLED_POLLS and not picture.is_blank():
            return picture
    if last.is_blank():
        raise TridentError(f"the screen was still blank after {_TIMEOUT_S:.0f} s")
    return last  # a moving scene never settles; what it shows now is as good as later


def _screenshot(command: Sequence[str], env: dict[str, str], target: Path) -> None:
    with (
        tempfile.TemporaryDirectory(prefix="trident-view-") as folder,
        _virtual_screen(Path(folder)) as (display, screen),
    ):
        env = env | {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "QT_X11_NO_MITSHM": "1"}
        env.setdefault("XDG_RUNTIME_DIR", folder)
        with _started(command, env) as viewer:
            # There is no window manager: the window does not fill the screen.
            write_png(_wait_for_picture(screen, viewer).cropped(), target)
    say(f"wrote {target}")


def _wait_for_master(uri: str, process: subprocess.Popen[bytes]) -> None:
    deadline = time.monotonic() + 20.0
    while not master_answers(uri):
        if process.poll() is not None or time.monotonic() > deadline:
            raise TridentError("roscore did not start")
        time.sleep(0.1)


def view(
    workspace: Workspace,
    runner: Runner,
    source: Path | None = None,
    config: str | None = None,
    screenshot: Path | None = None,
) -> int:
    """The ``view`` subcommand."""
    if screenshot is None and not os.environ.get("DISPLAY") and not runner.dry_run:
        raise TridentError(
            "there is no DISPLAY. For a picture: ./trident view --screenshot FILE.png [BAG|WORLD]; "
            "for plots: ./trident report RUN_OR_BAG; elsewhere: rviz with this ROS_MASTER_URI"
        )
    feeds = source_commands(source)
    configuration = pick_config(workspace, config)
    # The splash screen would be taken for the first picture.
    command = [
        "rviz",
        "--splash-screen",
        "",
        *(["-d", str(configuration)] if configuration else []),
    ]
    if screenshot is not None:
        command.append("--fullscreen")  # the picture without menus and panels
    if runner.dry_run:
        for feed in feeds:
            runner.run(feed)
        return runner.run(command)
    env = ros_environment(workspace)
    env.setdefault("ROS_HOSTNAME", "localhost")
    uri = None if feeds else running_master(workspace)
    with contextlib.ExitStack() as stack:
        if uri is None:
            port = free_port()
            uri = f"http://localhost:{port}"
            env["ROS_MASTER_URI"] = uri
            core = stack.enter_context(_started(["roscore", "-p", str(port)], env))
            _wait_for_master(uri, core)
        env["ROS_MASTER_URI"] = uri
        if feeds:
            runner.run(["rosparam", "set", "use_sim_time", "true"], env=env)
        for feed in feeds:
            stack.enter_context(_started(feed, env))
        if screenshot is None:
            return runner.run(command, env=env)
        _screenshot(command, env, screenshot)
    return 0
