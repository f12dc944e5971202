# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Files of the models that hold the meshes and pictures of a world."""

from __future__ import annotations

from trident_worldgen.sdf import LICENCE


def model_config(name: str, description: str) -> str:
    """The model.config of the model ``name``."""
    return f"""<?xml version="1.0"?>
{LICENCE}<model>
  <name>{name}</name>
  <version>1.0</version>
  <sdf version="1.6">model.sdf</sdf>
  <author><name>The Trident authors</name></author>
  <description>{description}</description>
</model>
"""


def rock_model(name: str, world: str) -> str:
    """The model.sdf of the model ``name`` with the parts of ``world``: spawned alone, its rock."""
    return f"""<?xml version="1.0"?>
{LICENCE}<!-- Holds what {world} is made of; a rock of its own. -->
<sdf version="1.6">
  <model name="{name}">
    <static>true</static>
    <link name="link">
      <collision name="rock">
        <geometry><mesh><uri>model://{name}/meshes/rock.obj</uri></mesh></geometry>
      </collision>
      <visual name="rock_visual">
        <geometry><mesh><uri>model://{name}/meshes/rock.obj</uri></mesh></geometry>
        <material><diffuse>0.45 0.44 0.42 1</diffuse></material>
      </visual>
    </link>
  </model>
</sdf>
"""
