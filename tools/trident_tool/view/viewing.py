# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Looks at a run, a bag, a world or a launch file in rviz; without a display, off-screen."""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from trident_tool.environment import ros_environment
from trident_tool.launch.formation_check import check_formations
from trident_tool.launch.launch_feed import (
    DESCRIPTION,
    STATE_PUBLISHER,
    lacks_state_publisher,
    nodes_of,
    wait_for_param,
)
from trident_tool.launch.launch_plan import check_plan, load_plan
from trident_tool.launch.launchfile import (
    check_args,
    declared_args,
    find_launch_file,
    parse_request,
)
from trident_tool.processes import ends_by_exception, foreground, started
from trident_tool.running import free_port
from trident_tool.shell import running_master, simulator_master, wait_for_master
from trident_tool.view.fixed_frame import Transforms, heard_transforms, may_be_missing
from trident_tool.view.recording import Recording
from trident_tool.view.screenshot import Size, resized, screenshot
from trident_tool.workspace import Runner, TridentError, Workspace, base_environment, say

_TRIES = 3
_ODOMETRY_LIMIT_S = 10.0  # of wall time, in which odometry begins
_HELD_LIMIT_S = 2.0  # in which what was sent until then has been written down
_DEFAULT = "default"
_STREAM = ["rosrun", "trident_viewer", "overview.py", "--stream", "--size", "720x450"]
_MARKERS = ["rosrun", "trident_viewer", "fleet_markers.py"]
_LINKS = "/link_markers"  # in a configuration that shows radio links
_LINK_MARKERS = ["rosrun", "trident_viewer", "link_markers.py"]


@dataclass(frozen=True)
class ViewOptions:
    """What is to be seen, and how.

    Attributes:
        words: a bag, a world, or a launch file with its arguments; nothing: the run in progress.
        config: name of a configuration of config/rviz, or a path; None: a camera in the world takes
            the screenshot, rviz on a display shows `default`.
        screenshot: PNG file to be made off-screen; None: rviz on the display.
        at_s: simulated time at which a launch file is held; None: it runs on.
        live_s: how much of the time before that rviz sees go by: what sensors send is not sent
            again by a world that stands [s].
        size: of the screenshot or film; None: the default of what makes it.
        recording: a film, or rerun, in place of rviz.
    """

    words: tuple[str, ...] = ()
    config: str | None = None
    screenshot: Path | None = None
    at_s: float | None = None
    live_s: float = 0.0
    size: Size | None = None
    recording: Recording = field(default_factory=Recording)

    def validate(self, has_display: bool) -> None:
        """Raises TridentError for options that do not go together, or need a display."""
        self.recording.validate(has_display)
        if self.live_s and self.at_s is None:
            raise TridentError("--live goes with --at only")
        if self.recording.is_wanted:
            if self.at_s is not None or self.screenshot is not None:
                raise TridentError("--at and --screenshot go with rviz only")
        elif self.screenshot is None and not has_display:
            raise TridentError(
                "there is no DISPLAY. For a picture: ./trident view --screenshot FILE.png "
                "[BAG|WORLD|LAUNCH]; for a film: --film FILE.mp4; for rerun elsewhere: --rerun "
                "--out FILE.rrd; for plots: ./trident report RUN_OR_BAG; elsewhere: rviz with this "
                "ROS_MASTER_URI"
            )

    @property
    def is_overview(self) -> bool:
        """Whether a camera in the world takes the picture: a simulation, no other request."""
        is_plain = self.config is None and not self.recording.is_wanted
        return self.screenshot is not None and is_plain and self.is_of_a_world

    @property
    def is_of_a_world(self) -> bool:
        """Whether there is a simulation to put a camera into."""
        return not (self.words and self.words[0].endswith(".bag"))


def _default_config(known: list[Path]) -> Path | None:
    default = [path for path in known if path.stem == _DEFAULT]
    return next(iter(default + known), None)


def pick_config(workspace: Workspace, name: str | None) -> Path | None:
    """The rviz configuration ``name`` of config/rviz; None: ``default``, or the first one there.

    Raises:
        TridentError: there is no configuration of that name.
    """
    folder = workspace.root / "config" / "rviz"
    known = sorted(folder.glob("*.rviz"))
    if name is None:
        return _default_config(known)
    if Path(name).is_file():
        return _checked(Path(name))
    for path in known:
        if name in (path.name, path.stem):
            return path
    names = ", ".join(path.stem for path in known) or "none"
    raise TridentError(f"there is no rviz configuration {name!r} in {folder} (it has: {names})")


def marker_nodes(configuration: Path | None) -> list[list[str]]:
    """Commands that feed a configuration of rviz."""
    text = configuration.read_text(encoding="utf-8") if configuration else ""
    return [_MARKERS, _LINK_MARKERS] if _LINKS in text else [_MARKERS]


def _checked(configuration: Path) -> Path:
    try:
        configuration.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise TridentError(f"{configuration}: {error}; legal: an rviz configuration") from None
    return configuration


def source_command(
    workspace: Workspace, words: Sequence[str], env: Mapping[str, str]
) -> list[str] | None:
    """The command that feeds rviz: a bag is played, a world simulated, a launch file launched.

    Raises:
        TridentError: the source does not exist or is of no known kind; an argument is wrong.
    """
    if not words:
        return None
    source = Path(words[0])
    if source.suffix in (".bag", ".world", ".sdf"):
        if len(words) > 1:
            raise TridentError(f"view shows one thing at a time, found also {words[1]}")
        return _play_command(source)
    if not any(word.endswith(".launch") for word in words[:2]):
        raise TridentError(f"{source}: view shows a .bag, a .world, an .sdf or a .launch file")
    request = parse_request(words)
    file = find_launch_file(workspace, request, env)
    check_args(file, declared_args(file), request.args)
    given = [f"{name}:={value}" for name, value in request.args.items()]
    return ["roslaunch", "--disable-title", str(file), *given]


def _play_command(source: Path) -> list[str]:
    """The command that plays a bag, or simulates a world."""
    if not source.exists():
        raise TridentError(f"{source} does not exist")
    if source.suffix == ".bag":
        return ["rosbag", "play", "--clock", "--quiet", str(source)]
    world = f"world_name:={source.resolve()}"
    return ["roslaunch", "gazebo_ros", "empty_world.launch", "gui:=false", world]


def viewer_command(workspace: Workspace, options: ViewOptions, env: Mapping[str, str]) -> list[str]:
    """The call of what looks."""
    if options.recording.is_wanted:
        return options.recording.command(workspace, options.size, env)
    if options.is_overview:
        return overview_command(options)
    return rviz_command(options, pick_config(workspace, options.config))


def overview_command(options: ViewOptions) -> list[str]:
    """The call of the camera that takes a picture of all that is there."""
    size = options.size or Size()
    words = ["--out", str(options.screenshot), "--size", f"{size.width}x{size.height}"]
    # What others have started is not held for a picture.
    words += ["--hold"] if options.words else []
    words += ["--at", f"{options.at_s:g}"] if options.at_s is not None else []
    return ["rosrun", "trident_viewer", "overview.py", *words]


def is_launch_file(feed: Sequence[str]) -> bool:
    """Whether that is a launch file of the user's choice, not one that plays a world."""
    return "--disable-title" in feed


def rviz_command(options: ViewOptions, configuration: Path | None) -> list[str]:
    """The call of rviz. The splash screen would be taken for the first picture."""
    command = ["rviz", "--splash-screen", ""]
    command += ["-d", str(configuration)] if configuration else []
    # The picture is without menus and panels.
    return [*command, "--fullscreen"] if options.screenshot is not None else command


def view_environment(env: Mapping[str, str]) -> dict[str, str]:
    """Environment of what is looked at: in real time, until it is ended, with no other viewer."""
    return {"TRIDENT_REAL_TIME_FACTOR": "1", "TRIDENT_HEADLESS": "1"} | {
        name: value for name, value in env.items() if name not in ("DISPLAY", "TRIDENT_END")
    }


def view(workspace: Workspace, runner: Runner, options: ViewOptions) -> int:
    """The ``view`` subcommand.

    Raises:
        TridentError: there is nothing to be seen, or no display for it.
    """
    options.validate(bool(os.environ.get("DISPLAY")) or runner.dry_run)
    env = base_environment() if runner.dry_run else ros_environment(workspace)
    feed = source_command(workspace, options.words, env) or []
    if options.at_s is not None and not is_launch_file(feed):
        raise TridentError("--at goes with a launch file only")
    command = viewer_command(workspace, options, env)
    if runner.dry_run:
        return _show_commands(runner, options, feed, command)
    env.setdefault("ROS_HOSTNAME", "localhost")
    if feed and feed[0] == "roslaunch":
        _check_launch(workspace, feed, view_environment(env))
    return _show(workspace, runner, options, feed, command, env)


def _check_launch(workspace: Workspace, feed: Sequence[str], env: Mapping[str, str]) -> None:
    """Refuses what the simulator would refuse, whose own words nobody sees."""
    request = parse_request([word for word in feed[1:] if not word.startswith("--")])
    plan = load_plan(find_launch_file(workspace, request, env), request.args, env)
    check_formations(plan, env)
    check_plan(plan, env)


def _show_commands(
    runner: Runner, options: ViewOptions, feed: list[str], command: list[str]
) -> int:
    helpers = [] if options.recording.is_wanted or options.is_overview else [_MARKERS]
    for words in [feed or ["true"], *helpers, command]:
        runner.run(words)
    return 0


def _show(
    workspace: Workspace,
    runner: Runner,
    options: ViewOptions,
    feed: list[str],
    command: list[str],
    env: dict[str, str],
) -> int:
    with ends_by_exception(), contextlib.ExitStack() as stack:
        uri = _find_or_start_master(stack, workspace, env, is_own=bool(feed))
        scene = _Scene(runner, options, stack, _at(env, uri))
        if not (options.is_overview or options.recording.is_wanted):
            scene.configuration = pick_config(workspace, options.config)
        if feed:
            scene.start_feed(feed, uri)
        if options.is_overview:
            return foreground([*command, "--nodes", str(scene.nodes)], scene.env, scene.source)
        if options.recording.is_wanted:
            return foreground(command, scene.env, scene.source)
        return scene.show_in_rviz(command)


def _find_or_start_master(
    stack: contextlib.ExitStack, workspace: Workspace, env: dict[str, str], is_own: bool
) -> str:
    """URI of a new master if ``is_own``, else of that with the simulator that is running."""
    if not is_own:
        uri = running_master(workspace) or simulator_master()
        if uri is None:
            raise TridentError(
                "no simulator is running: neither a ./trident run nor one at ROS_MASTER_URI;"
                " legal: ./trident view FILE.launch, or start one first"
            )
        return uri
    uri = f"http://localhost:{free_port()}"
    port = uri.rpartition(":")[2]
    core = stack.enter_context(started(["roscore", "-p", port], _at(env, uri)))
    wait_for_master(uri, core)
    return uri


@dataclass
class _Scene:
    """What is running to be looked at.

    Attributes:
        runner: runs commands that end.
        options: what is to be seen.
        stack: ends all that was started.
        env: environment, with the master in it.
        feed: what is started for it; empty: the run in progress is looked at.
        source: the process of the feed.
        nodes: how many nodes the feed starts.
        configuration: of rviz.
    """

    runner: Runner
    options: ViewOptions
    stack: contextlib.ExitStack
    env: dict[str, str]
    feed: Sequence[str] = ()
    source: subprocess.Popen[bytes] | None = None
    nodes: int = 0
    configuration: Path | None = None

    def start_feed(self, feed: Sequence[str], uri: str) -> None:
        """Starts what is looked at, and what says where its links are if it does not itself."""
        env = view_environment(self.env)
        self.runner.run(["rosparam", "set", "use_sim_time", "true"], env=self.env)
        # Asked before it starts: from then on the simulated time runs.
        nodes = nodes_of(feed, env) if is_launch_file(feed) else []
        is_unplaced = bool(nodes) and lacks_state_publisher(feed, nodes, env)
        self.feed, self.nodes = feed, len(nodes)
        self.source = self._start(feed, env)
        if is_unplaced and wait_for_param(uri, DESCRIPTION, self.source):
            self._start(STATE_PUBLISHER, self.env)

    def show_in_rviz(self, command: list[str]) -> int:
        """Opens rviz, or has it take a screenshot; returns its exit code."""
        for node in marker_nodes(self.configuration):
            self._start(node, self.env)
        if self._is_of_a_world():
            self._start(_STREAM, self.env)
        with self._heard_transforms() as transforms:
            last_steps = self._hold()
            command = self._in_a_known_frame(command, transforms)
        if self.source is not None and self.source.poll() not in (None, 0):
            code = self.source.returncode
            raise TridentError(f"{' '.join(self.feed)} ended with exit code {code}")
        if self.options.screenshot is None:
            return self.runner.run(command, env=self.env)
        self._take_screenshot(command, self.options.screenshot, last_steps)
        return 0

    def _heard_transforms(self) -> contextlib.AbstractContextManager[Transforms | None]:
        """Of a configuration whose fixed frame may not be there."""
        # Before the first step nothing is known of what comes.
        is_at_start = self.options.at_s is not None and self.options.at_s <= self.options.live_s
        if is_at_start or not may_be_missing(self.configuration):
            return contextlib.nullcontext()
        return heard_transforms(self.env)

    def _in_a_known_frame(self, command: list[str], transforms: Transforms | None) -> list[str]:
        """Rviz with the root of the transforms for its fixed frame where there is no odometry."""
        is_held = self.options.at_s is not None
        limit_s = _HELD_LIMIT_S if is_held else _ODOMETRY_LIMIT_S
        root = transforms.root_in_place_of_odometry(limit_s) if transforms else None
        if root is None:
            return command
        say(f"the robot has no odometry: the fixed frame is {root}")
        return [*command, "--fixed-frame", root]

    def _is_of_a_world(self) -> bool:
        """Whether a camera in the world has something to add to rviz's own configuration."""
        options = self.options
        return self.source is not None and options.config is None and options.is_of_a_world

    def _hold(self) -> subprocess.Popen[bytes] | None:
        """Holds the simulation where it is to be seen; the process that has yet to get it there."""
        at_s, live_s = self.options.at_s, self.options.live_s
        if at_s is None:
            return None
        _hold(self.runner, max(at_s - live_s, 0.0), self.nodes, self.env)
        if not live_s:
            return None
        hold = ["rosrun", "trident_viewer", "hold_at.py", "--viewer", str(at_s)]
        return self._start(hold, self.env)

    def _take_screenshot(
        self, command: list[str], target: Path, last_steps: subprocess.Popen[bytes] | None
    ) -> None:
        _take_picture(
            command,
            self.env,
            target,
            self.options.size or Size(),
            lambda: last_steps is None or last_steps.poll() is not None,
            # What went by in front of a viewer that crashed does not come again.
            1 if last_steps else _TRIES,
        )
        say(f"wrote {target}")

    def _start(self, command: Sequence[str], env: Mapping[str, str]) -> subprocess.Popen[bytes]:
        return self.stack.enter_context(started(command, env))


def _take_picture(
    command: list[str],
    env: dict[str, str],
    target: Path,
    size: Size,
    is_ready: Callable[[], bool],
    tries: int,
) -> None:
    """A screenshot of rviz, with the window of its configuration as large as the picture."""
    with tempfile.TemporaryDirectory(prefix="trident-view-") as folder:
        for index, word in enumerate(command):
            if word.endswith(".rviz"):
                copy = Path(folder) / "sized.rviz"
                text = resized(Path(word).read_text(encoding="utf-8"), size)
                copy.write_text(text, encoding="utf-8")
                command = [*command[:index], str(copy), *command[index + 1 :]]
        screenshot(command, env, target, size, is_ready, tries)


def _at(env: Mapping[str, str], uri: str) -> dict[str, str]:
    return {**env, "ROS_MASTER_URI": uri}


def _hold(runner: Runner, at_s: float, nodes: int, env: Mapping[str, str]) -> None:
    say(f"simulating to {at_s:g} s")
    runner.check(
        ["rosrun", "trident_viewer", "hold_at.py", "--nodes", str(nodes), str(at_s)],
        what=f"holding the simulation at {at_s:g} s",
        env=env,
    )
