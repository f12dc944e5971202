# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the xacro library needs of ROS, without the rest.

It imports roslaunch.substitution_args. That would bring roslaunch with the master, XML-RPC and
TLS, which takes longer to import than a vehicle takes to expand; and it would read /usr/share for
every package.
"""

from __future__ import annotations

import functools
import sys
from importlib.machinery import PathFinder

TYPE_CHECKING = False  # typing takes a third of the time of a call to import
if TYPE_CHECKING:
    import rospkg


@functools.cache
def find_package(name: str) -> str:
    """Path of a ROS package, as rospkg finds it.

    A folder of ROS_PACKAGE_PATH is read only if the package is in none before it.

    Raises:
        rospkg.ResourceNotFound: it is in none.
    """
    import rospkg

    for folder in rospkg.get_ros_paths():
        try:
            return _packages_in(folder).get_path(name)
        except rospkg.ResourceNotFound:
            continue
    return rospkg.RosPack().get_path(name)


@functools.cache
def _packages_in(folder: str) -> rospkg.RosPack:
    import rospkg

    return rospkg.RosPack([folder])


def import_substitution_args() -> None:
    """Makes roslaunch.substitution_args importable at a low price, if it is there."""
    if not (_register_package("roslaunch") and _register_package("rosgraph")):
        return  # the library says what is missing, if it comes to that
    loader = type(sys)("roslaunch.loader")
    vars(loader)["convert_value"] = _convert_value
    sys.modules[loader.__name__] = loader
    import rospkg
    from roslaunch import substitution_args

    packages = rospkg.RosPack()
    packages.get_path = find_package
    substitution_args._rospack = packages


def _register_package(name: str) -> bool:
    """Makes submodules of a package importable without running its __init__."""
    spec = PathFinder.find_spec(name)
    if spec is None or spec.submodule_search_locations is None:
        return False
    module = type(sys)(name)
    module.__spec__ = spec
    module.__path__ = spec.submodule_search_locations
    sys.modules[name] = module
    return True


def _convert_value(value: str, type_: str) -> object:
    """roslaunch.loader.convert_value, imported when `$(eval ...)` needs it."""
    rosgraph = sys.modules["rosgraph"]
    spec = rosgraph.__spec__
    assert spec is not None  # it was registered here
    assert spec.loader is not None
    spec.loader.exec_module(rosgraph)
    del sys.modules["roslaunch.loader"]
    from roslaunch.loader import convert_value

    return convert_value(value, type_)
