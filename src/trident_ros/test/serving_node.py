#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Serves ``repeat``, ``object``, ``hang`` and, as the last one of a test, ``die``."""

from __future__ import annotations

import os
import threading

import rospy
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

LONG = 1_000_000


def repeat(request: SetBoolRequest) -> SetBoolResponse:
    """A long answer to true, a short one to false."""
    return SetBoolResponse(request.data, "x" * (LONG if request.data else 1))


def refuse(request: SetBoolRequest) -> SetBoolResponse:
    """An error with a text."""
    del request
    raise rospy.ServiceException("the arm is folded")


def hang(request: SetBoolRequest) -> SetBoolResponse:
    """No answer at all."""
    del request
    threading.Event().wait()
    return SetBoolResponse()


def die(request: SetBoolRequest) -> SetBoolResponse:
    """The end of this process instead of an answer."""
    del request
    os._exit(1)


rospy.init_node("serving")
for name, handler in (("repeat", repeat), ("object", refuse), ("hang", hang), ("die", die)):
    rospy.Service(name, SetBool, handler)
rospy.spin()
