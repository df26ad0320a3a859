#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Saves and loads all nodes below a namespace (parameter ~scene, by default the node's own) by one
service each: ~save and ~load."""
import time

import rospy
from vegetation_sim import Scene, VegetationError
from vegetation_sim.srv import (LoadSnapshot, LoadSnapshotResponse, SaveSnapshot,
                                SaveSnapshotResponse)


def save(scene, request):
    begin = time.monotonic()
    try:
        nodes = scene.save(request.name)['nodes']
    except VegetationError as error:
        return SaveSnapshotResponse(success=False, message=str(error))
    total = sum(entry['bytes'] for entry in nodes.values())
    return SaveSnapshotResponse(success=True, bytes=total, seconds=time.monotonic() - begin,
                                message='%d nodes: %s' % (len(nodes), ', '.join(sorted(nodes))))


def load(scene, request):
    begin = time.monotonic()
    try:
        if request.node or request.check_only:
            raise VegetationError('node and check_only belong to the service of a single node')
        replies = scene.load(request.name)
    except VegetationError as error:
        return LoadSnapshotResponse(success=False, message=str(error))
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
