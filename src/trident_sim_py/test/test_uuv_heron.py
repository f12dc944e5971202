# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot description as users of uuv_simulator and heron_simulator have it, with their plugins."""

from __future__ import annotations

import pytest

import trident_sim

WORLD = """<sdf version="1.6"><world name="lake"><gravity>0 0 -9.81</gravity>
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<plugin name="sea" filename="libtrident_sea.so"/></world></sdf>"""

THRUSTER = """
<link name="thruster_{id}"><inertial><mass value="0.01"/>
<inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial></link>
<joint name="thruster_{id}_joint" type="continuous"><parent link="base_link"/>
<child link="thruster_{id}"/><origin xyz="-0.4735 {y} 0"/><axis xyz="1 0 0"/></joint>
<gazebo><plugin name="thruster_{id}" filename="libuuv_thruster_ros_plugin.so">
<linkName>thruster_{id}</linkName><jointName>thruster_{id}_joint</jointName>
<thrusterID>{id}</thrusterID><gain>1</gain><clampMin>-100</clampMin><clampMax>100</clampMax>
<thrustMin>-35</thrustMin><thrustMax>35</thrustMax>
<dynamics><type>FirstOrder</type><timeConstant>0.05</timeConstant></dynamics>
<conversion><type>LinearInterp</type>
<inputValues>-1 -0.8 -0.6 -0.4 -0.2 0 0.2 0.4 0.6 0.8 1</inputValues>
<outputValues>-19.88 -16.52 -12.6 -5.6 -1.4 0 2.24 9.52 21.28 28 33.6</outputValues>
</conversion></plugin></gazebo>"""

HERON = """<robot name="heron"><link name="base_link"><inertial><mass value="28"/>
<inertia ixx="10" ixy="0" ixz="0" iyy="10" iyz="0" izz="10"/></inertial></link>{thrusters}
<gazebo><plugin name="uuv_plugin" filename="libuuv_underwater_object_ros_plugin.so">
<fluid_density>1028</fluid_density><debug>0</debug>
<link name="base_link"><neutrally_buoyant>0</neutrally_buoyant><volume>0.13</volume>
<box><width>1.0</width><length>1.35</length><height>0.32</height></box>
<center_of_buoyancy>0 0 0</center_of_buoyancy><metacentric_width>0.1</metacentric_width>
<metacentric_length>0.1</metacentric_length><submerged_height>0.02</submerged_height>
<hydrodynamic_model><type>fossen</type><added_mass>{zeros}</added_mass>
<linear_damping>-16.44998712 -15.79776044 -100 -13 -13 -6</linear_damping>
<quadratic_damping>-2.942 -2.7617212 -10 -5 -5 -5</quadratic_damping>
{more}</hydrodynamic_model></link></plugin></gazebo></robot>"""


def heron(more: str = "") -> str:
    thrusters = "".join(THRUSTER.format(id=i, y=y) for i, y in ((0, -0.377), (1, 0.377)))
    return HERON.format(thrusters=thrusters, zeros="0 " * 36, more=more)


def test_it_floats_is_driven_and_turns_its_propellers() -> None:
    world = trident_sim.World(WORLD)
    boat = world.spawn("heron", urdf=heron(), pose=(0.0, 0.0, 0.14))
    assert not [message.text for message in world.messages]
    world.ports["heron/thrusters/1/thrust"].subscribe()
    world.ports["heron/thrusters/1/thrust_wrench"].subscribe()
    for number, value in ((0, 0.8), (1, 0.8)):
        world.ports[f"heron/thrusters/{number}/input"].write(value)
    world.step(3000)
    assert boat.position[2] == pytest.approx(0.14, abs=5e-3)
    assert world.ports["heron/thrusters/1/thrust"].value.value == pytest.approx(28.0)
    assert world.ports["heron/thrusters/1/thrust_wrench"].value.force == pytest.approx([28, 0, 0])
    speed = (-16.45 + (16.45**2 + 4 * 2.942 * 56) ** 0.5) / (2 * 2.942)
    assert boat.linear_velocity[0] == pytest.approx(speed, rel=0.01)
    assert boat.joint("thruster_1_joint").velocity == pytest.approx(0.8, rel=1e-3)
    world.ports["heron/thrusters/0/input"].write(0.2)
    world.step(500)
    assert boat.angular_velocity[2] < -0.1


def test_elements_without_effect_are_named_once() -> None:
    world = trident_sim.World(WORLD)
    world.spawn("heron", urdf=heron("<colour>red</colour>"))
    world.step(10)
    texts = [message.text for message in world.messages]
    assert [text for text in texts if "<hydrodynamic_model> <colour> is not known" in text] == texts


def test_a_mass_matrix_that_is_not_positive_definite_is_refused() -> None:
    world = trident_sim.World(WORLD)
    with pytest.raises(trident_sim.Error, match=r"mass matrix.*positive definite"):
        world.spawn("heron", urdf=heron("<offset_added_mass>-40</offset_added_mass>"))
