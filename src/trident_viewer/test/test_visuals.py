# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from trident_eval.core.errors import EvalError
from trident_viewer.visuals import BOX, CYLINDER, MESH, SPHERE, rotation, visuals_of

URDF = """<robot name="r">
  <material name="red"><color rgba="1 0 0 0.5"/></material>
  <link name="base"><visual><origin xyz="0 0 0.1" rpy="0 0 0"/>
    <geometry><box size="1 2 3"/></geometry><material name="red"/></visual></link>
  <link name="arm"><visual><geometry><cylinder radius="0.5" length="4"/></geometry></visual>
    <visual><geometry><sphere radius="0.25"/></geometry></visual></link>
  <link name="tip"><visual><origin xyz="1 0 0"/>
    <geometry><mesh filename="package://a/b.dae" scale="2 2 2"/></geometry></visual></link>
  <joint name="shoulder" type="fixed"><origin xyz="0 1 0" rpy="0 0 1.5707963267948966"/>
    <parent link="base"/><child link="arm"/></joint>
  <joint name="wrist" type="continuous"><origin xyz="1 0 0"/>
    <parent link="arm"/><child link="tip"/></joint>
</robot>"""
BROKEN = '<robot><link name="a">{}</link>{}</robot>'


def test_shapes_are_placed_in_the_root_link() -> None:
    box, cylinder, sphere, mesh = visuals_of(URDF)
    assert [shape.kind for shape in (box, cylinder, sphere, mesh)] == [BOX, CYLINDER, SPHERE, MESH]
    assert (box.scale, box.color) == ((1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 0.5))
    assert box.T_base_shape[:3, 3] == pytest.approx([0.0, 0.0, 0.1])
    assert cylinder.scale == (1.0, 1.0, 4.0)
    assert sphere.scale == (0.5, 0.5, 0.5)
    assert cylinder.T_base_shape[:3, 3] == pytest.approx([0.0, 1.0, 0.0])
    # A quarter turn to the left at the shoulder: what is ahead of the arm is along base's y.
    assert mesh.T_base_shape[:3, 3] == pytest.approx([0.0, 3.0, 0.0], abs=1e-12)
    assert mesh.T_base_shape[:3, 0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
    assert (mesh.resource, mesh.scale, mesh.color) == ("package://a/b.dae", (2.0,) * 3, None)


def test_rotations_are_about_fixed_axes_x_first() -> None:
    R = rotation(0.3, -0.4, 0.5)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-15)
    about_z = np.array([[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]])
    np.testing.assert_allclose(rotation(0.0, 0.0, 0.5)[:2, :2], about_z)
    np.testing.assert_allclose(
        R, rotation(0.0, 0.0, 0.5) @ rotation(0.0, -0.4, 0.0) @ rotation(0.3, 0.0, 0.0)
    )


@pytest.mark.parametrize(
    "text",
    [
        "<robot",
        BROKEN.format('<visual><geometry><box size="1 2"/></geometry></visual>', ""),
        BROKEN.format("<visual><geometry/></visual>", ""),
        BROKEN.format("<visual><geometry><cone/></geometry></visual>", ""),
        BROKEN.format("", '<joint><parent link="a"/><child link="a"/></joint>'),
    ],
    ids=["no XML", "two of three numbers", "no shape", "an unknown shape", "a circle of joints"],
)
def test_what_is_no_urdf_is_refused(text: str) -> None:
    with pytest.raises(EvalError, match="robot_description"):
        visuals_of(text)
