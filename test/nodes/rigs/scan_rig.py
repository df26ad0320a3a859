# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures for the tests of vegetation_scanner: the node through its ROS interface."""
import math

import numpy
import rospy
import yaml
from numpy.lib.recfunctions import repack_fields
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import ScanReport

from forest_rig import start_node, stop, time_of
from waiting import wait_for
from watched_node import Log, WatchedNode, listens, publisher, wait_for_readers

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


class LidarPair:
    """Two lidars on one mast. The first receives what is near it on the topic `near`. The second
    finds no publisher of that, so it receives the whole."""

    SETTLING = rospy.Duration(0.5)  # after a jump, until what is near there comes

    def __init__(self, source, whole, near, others, **lidar):
        """source: the node that publishes what is near. whole, near, others: names of topics."""
        topics = {name: '/' + name for name in (whole, *others)}
        near_topics = {name: '/' + name for name in (near, 'forest/sensors')}
        self._processes = [start_node('vegetation_scanner', '/near/vegetation_scanner', {**topics, **near_topics},
                                      **lidar),
                           start_node('vegetation_scanner', '/whole/vegetation_scanner', topics, **lidar)]
        self._whole, self._jumps = '/' + whole, []
        self.scanners = [Scanner('/%s/vegetation_scanner' % name, '/%s/' % name) for name in ('near', 'whole')]
        self.scanners[0].wait_until_up('/' + whole, '/' + near)
        self.scanners[1].wait_until_up('/' + whole)
        # The first announcement is sent after a sweep, and the source finds the sensor by itself.
        wait_for(lambda: listens(source, '/forest/sensors'), source + ' to listen to sensors')
        self._mast = Mast(self.scanners[0])
        wait_for_readers('/tf', self.scanners[1].process)

    def move(self, place, clock, run_tick):
        """Puts the mast at a place, and runs the three ticks of a sweep there."""
        stamp = time_of(clock.tick + 3)
        self._mast.put(*place, stamp)
        wait_for(lambda: self.scanners[1].has_transform('lidar', stamp), 'lidar')
        for _ in range(3):
            run_tick()
            for scanner in self.scanners:
                scanner.settle()

    def leave_whole(self, place, clock, run_tick):
        """Sweeps at a place until the first lidar no longer receives the whole. The mast may jump
        after that."""
        for _ in range(100):
            self.move(place, clock, run_tick)
            if not listens(self.scanners[0].process, self._whole):
                break
        else:
            raise AssertionError('the lidar receives %s after 100 sweeps beside it' % self._whole)
        self._jumps.append(time_of(clock.tick))

    def compare(self):
        """Returns the stamps of the sweeps that are compared, and of those that are not equal."""
        clouds = [{m.header.stamp: bytes(m.data) for m in scanner.points.messages} for scanner in self.scanners]
        both = sorted(set(clouds[0]) & set(clouds[1]))
        compared = [s for s in both if not any(j <= s <= j + self.SETTLING for j in self._jumps)]
        print('%d of %d sweeps are compared' % (len(compared), len(both)))
        return compared, [s for s in compared if clouds[0][s] != clouds[1][s]]

    def name_rival(self, topic, kind):
        """Returns once the first lidar has named a second publisher of a topic, and only once."""
        words = '2 publishers of ' + topic
        rival = rospy.Publisher(topic, kind, queue_size=1)
        said = wait_for(lambda: (lambda text: words in text and text)(self.scanners[0].status().message), words)
        rival.unregister()
        if said.count(topic) != 1:
            raise AssertionError(said)

    def close(self):
        for process in self._processes:
            stop(process)
