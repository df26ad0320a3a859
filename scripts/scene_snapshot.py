#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Saves and loads all nodes below a namespace (parameter ~scene, by default the node's own) by one
service each: ~save and ~load."""
import time

import rospy
from vegetation_sim import Scene, VegetationError
from vegetation_sim.msg import ErrorCode
from vegetation_sim.srv import (LoadSnapshot, LoadSnapshotResponse, SaveSnapshot,
                                SaveSnapshotResponse)


def refusal(response, error):
    """Returns a response that names an error."""
    if not isinstance(error, VegetationError):
        rospy.logerr('scene_snapshot: %r', error)
        return response(success=False, message=repr(error), error_code=ErrorCode.INTERNAL)
    # A node that has not answered has given no code.
    code = ErrorCode.NOT_AVAILABLE if error.code is None else error.code
    return response(success=False, message=str(error), error_code=code)


def save(scene, request):
    begin = time.monotonic()
    try:
        nodes = scene.save(request.name)['nodes']
    except Exception as error:
        return refusal(SaveSnapshotResponse, error)
    total = sum(entry['bytes'] for entry in nodes.values())
    return SaveSnapshotResponse(success=True, bytes=total, seconds=time.monotonic() - begin,
                                message='%d nodes: %s' % (len(nodes), ', '.join(sorted(nodes))))


def load(scene, request):
    begin = time.monotonic()
    try:
        if request.node or request.check_only:
            raise VegetationError('node and check_only belong to the service of a single node',
                                  ErrorCode.INVALID_VALUE)
        replies = scene.load(request.name)
    except Exception as error:
        return refusal(LoadSnapshotResponse, error)
    last = max(replies.values(), key=lambda reply: reply.stamp)
    return LoadSnapshotResponse(success=True, stamp=last.stamp, shift=last.shift,
                                seconds=time.monotonic() - begin,
                                message='%d nodes: %s' % (len(replies), ', '.join(sorted(replies))))


if __name__ == '__main__':
    rospy.init_node('scene_snapshot')
    SCENE = Scene(rospy.get_param('~scene', rospy.get_namespace()))
    rospy.Service('~save', SaveSnapshot, lambda request: save(SCENE, request))
    rospy.Service('~load', LoadSnapshot, lambda request: load(SCENE, request))
    rospy.spin()
