# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of vegetation_scanner: the node through its ROS interface."""
import math

import numpy
import yaml
from numpy.lib.recfunctions import repack_fields
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import ScanReport

from forest_rig import time_of
from waiting import wait_for
from watched_node import Log, WatchedNode, publisher, wait_for_readers

TYPES = {PointField.FLOAT32: 'f4', PointField.UINT8: 'u1', PointField.UINT16: 'u2', PointField.UINT32: 'u4',
         PointField.INT32: 'i4'}
INPUTS = ('/wind', '/forest/layout', '/forest/state', '/grass/layout', '/grass/state', '/agents')


class Scanner(WatchedNode):
    """Client of one vegetation_scanner."""

    LOGS = 'points', 'scan', 'report'

    def __init__(self, name='/vegetation_scanner', namespace='/'):
        self.points = Log(namespace + 'lidar/points', PointCloud2)
        self.scan = Log(namespace + 'lidar/scan', LaserScan)
        self.report = Log(namespace + 'lidar/report', ScanReport)
        super().__init__(name, 'scan', name + '/tf2_frames', FrameGraph)

    def has_frame(self, frame):
        """Returns whether the node's tf buffer has the frame."""
        return frame in (yaml.safe_load(self._probe().frame_yaml) or {})

    def has_transform(self, frame, stamp):
        """Returns whether the newest transform of a frame in the node's tf buffer has this stamp,
        to 2 ms."""
        frames = yaml.safe_load(self._probe().frame_yaml) or {}
        newest = frames.get(frame, {}).get('most_recent_transform', 0.0)
        return abs(newest - stamp.to_sec()) < 2e-3


def cloud_of(message):
    """Returns the points of a cloud as an array of records."""
    layout = numpy.dtype({'names': [f.name for f in message.fields],
                          'formats': [TYPES[f.datatype] for f in message.fields],
                          'offsets': [f.offset for f in message.fields],
                          'itemsize': message.point_step})
    # A copy without the unused bytes, so that equal points have equal bytes.
    return repack_fields(numpy.frombuffer(message.data, layout))


class Mast:
    """Publishes the frame of the sensor."""

    def __init__(self, scanner, frame='lidar'):
        self.scanner, self.frame = scanner, frame
        self._publisher = publisher('/tf', TFMessage)
        wait_for_readers('/tf', scanner.process)

    def put(self, x, y, z, stamp, yaw=0.0):
        """Publishes the frame. Returns when the scanner's tf buffer has it; tf has its own
        thread."""
        self.scanner.settle()  # The node has then processed a jump back of the clock.
        frame = TransformStamped(child_frame_id=self.frame)
        frame.header.frame_id, frame.header.stamp = 'map', stamp
        at = frame.transform.translation
        at.x, at.y, at.z = x, y, z
        frame.transform.rotation.z, frame.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        self._publisher.publish(TFMessage([frame]))
        wait_for(lambda: self.scanner.has_transform(self.frame, stamp), self.frame)
