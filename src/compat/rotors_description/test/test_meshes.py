# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The committed meshes are the generator's, are closed and face outwards."""

from __future__ import annotations

import importlib.util
import sys
import xml.etree.ElementTree as ET
from collections import Counter
from types import ModuleType

import pytest
from urdf_model import PACKAGE, expand


def load_generator() -> ModuleType:
    path = PACKAGE / "scripts" / "make_meshes.py"
    spec = importlib.util.spec_from_file_location("make_meshes", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["make_meshes"] = module
    spec.loader.exec_module(module)
    return module


GENERATOR = load_generator()
MESHES = GENERATOR.meshes()


@pytest.mark.parametrize("name", sorted(MESHES))
def test_committed_mesh_is_what_the_generator_writes(name: str) -> None:
    assert (PACKAGE / "meshes" / name).read_text() == GENERATOR.collada(MESHES[name])


@pytest.mark.parametrize("name", sorted(MESHES))
def test_every_part_is_closed_and_faces_outwards(name: str) -> None:
    for part in MESHES[name]:
        edges = Counter(edge for a, b, c in part.triangles for edge in ((a, b), (b, c), (c, a)))
        assert set(edges.values()) == {1}
        assert all((b, a) in edges for a, b in edges)
        volume = 0.0
        for a, b, c in (tuple(part.vertices[i] for i in t) for t in part.triangles):
            volume += a[0] * (b[1] * c[2] - b[2] * c[1])
            volume += a[1] * (b[2] * c[0] - b[0] * c[2])
            volume += a[2] * (b[0] * c[1] - b[1] * c[0])
        assert volume > 0.0


@pytest.mark.parametrize("vehicle", ["ardrone", "firefly", "hummingbird", "iris", "pelican"])
def test_every_mesh_that_a_vehicle_names_exists(vehicle: str) -> None:
    root = ET.fromstring(expand(f"{vehicle}_base.xacro"))
    names = {str(mesh.get("filename")) for mesh in root.iter("mesh")}
    assert len(names) == 3
    for name in names:
        prefix = "package://rotors_description/"
        assert name.startswith(prefix)
        assert (PACKAGE / name.removeprefix(prefix)).is_file()


def test_propellers_have_radius_one_and_opposite_twist() -> None:
    ccw = [v for part in MESHES["propeller_ccw.dae"] for v in part.vertices]
    cw = [v for part in MESHES["propeller_cw.dae"] for v in part.vertices]
    assert max(abs(x) for x, _, _ in ccw) == pytest.approx(1.0)
    assert ccw != cw
