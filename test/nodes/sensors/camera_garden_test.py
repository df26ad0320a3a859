#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""A camera in a garden: four images of one instant with labels, ids and depths of what is there,
their calibration, and the announcement without a subscriber."""
import contextlib
import copy
import math
import os
import tempfile
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image, RegionOfInterest
from sensor_msgs.srv import SetCameraInfo
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import ScanReport, SensorInterest

from crowd_rig import Crowd
from forest_rig import RATE, Animator, TickClock, start_node, stop, time_of
from grass_rig import Meadow
from waiting import wait_for
from watched_node import DEADLINE, Log, WatchedNode

TYPES = {'rgb8': ('u1', 3), '32FC1': ('f4', 1), '16UC1': ('u2', 1), '32SC1': ('i4', 1)}
HEIGHT, DOWN = 1.5, math.pi / 6  # of the camera over bare ground [m], [rad]
CALIBRATION = """image_width: 161
image_height: 121
camera_name: ground_vegetation_camera
camera_matrix: {rows: 3, cols: 3, data: [140.0, 0.0, 82.0, 0.0, 138.0, 59.0, 0.0, 0.0, 1.0]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.2, 0.03, 0.001, -0.002, 0.0]}
rectification_matrix: {rows: 3, cols: 3, data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]}
projection_matrix: {rows: 3, cols: 4, data: [140.0, 0, 82.0, 0, 0, 138.0, 59.0, 0, 0, 0, 1.0, 0]}
"""


class Camera(WatchedNode):
    """Client of one vegetation_camera."""

    TOPICS = (('picture', 'image_raw'), ('depth', 'depth/image_raw'), ('label', 'label'),
              ('instance', 'instance'))
    LOGS = ()

    def __init__(self, namespace='/'):
        self.space = namespace + 'camera/'
        super().__init__(namespace + 'vegetation_camera', 'camera',
                         namespace + 'vegetation_camera/reset', Trigger)

    def calibrate(self, info):
        rospy.wait_for_service(self.space + 'set_camera_info', DEADLINE)
        return rospy.ServiceProxy(self.space + 'set_camera_info', SetCameraInfo)(camera_info=info)

    def subscribe(self):
        self.images = {name: Log(self.space + topic, Image) for name, topic in self.TOPICS}
        self.infos = {name: Log(self.space + topic, CameraInfo) for name, topic in
                      (('picture', 'camera_info'), ('depth', 'depth/camera_info'))}
        for log in (*self.images.values(), *self.infos.values()):
            wait_for(log.connected, log.topic)

    def latest(self, stamp, remind):
        """Returns the images and calibrations of a stamp or a later one."""
        messages = {}
        for kind, logs in (('', self.images), ('info of ', self.infos)):
            for name, log in logs.items():
                messages[kind + name] = log.wait(
                    lambda all: [m for m in all if m.header.stamp >= stamp][:1], name, remind)[0]
        return messages


@contextlib.contextmanager
def ground_camera(calibration):
    """Runs a camera over bare ground with a file of its calibration."""
    process = start_node('vegetation_camera', '/ground/vegetation_camera', {},
                         camera_frame='ground_camera', camera_info_url='file://' + calibration,
                         rate=RATE, delay=0.0)
    try:
        camera = Camera('/ground/')
        camera.wait_until_up()
        yield camera
    finally:
        stop(process)


def array_of(image):
    """Returns the pixels of an image, and checks its layout."""
    kind, channels = TYPES[image.encoding]
    pixels = numpy.frombuffer(image.data, kind)
    assert image.step == image.width * channels * pixels.itemsize, image.step
    shape = (image.height, image.width) + ((channels,) if channels > 1 else ())
    return pixels.reshape(shape)


def product(a, b):
    """Returns the product of two quaternions (w, x, y, z)."""
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def optical_frame(name, place, down):
    """Returns the frame of a camera that looks along x and down by an angle (REP 103)."""
    out = TransformStamped(child_frame_id=name)
    out.header.frame_id = 'map'
    at, turn = out.transform.translation, out.transform.rotation
    at.x, at.y, at.z = place
    turn.w, turn.x, turn.y, turn.z = product((math.cos(down / 2), 0.0, math.sin(down / 2), 0.0),
                                             (0.5, -0.5, 0.5, -0.5))
    return out


def undistorted(info):
    """Returns x and y at z = 1 of all pixels by the iteration of OpenCV's undistortPoints()."""
    k1, k2, p1, p2, k3 = info.D
    u, v = numpy.meshgrid(numpy.arange(info.width), numpy.arange(info.height))
    x0, y0 = (u - info.K[2]) / info.K[0], (v - info.K[5]) / info.K[4]
    x, y = x0, y0
    for _ in range(100):
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        x, y = ((x0 - 2 * p1 * x * y - p2 * (r2 + 2 * x * x)) / radial,
                (y0 - p1 * (r2 + 2 * y * y) - 2 * p2 * x * y) / radial)
    return x, y


class CameraGarden(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.forest, cls.grass, cls.crowd = Animator(), Meadow(), Crowd()
        cls.clock = TickClock(1000 * RATE)
        cls.interest = Log('/forest/sensors', SensorInterest)
        cls.tf = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.tf.publish(TFMessage([
            optical_frame('garden_camera', (-10.0, 0.0, 1.6), 0.05),
            optical_frame('ground_camera', (0.0, 0.0, HEIGHT), DOWN)]))
        cls.camera = Camera()
        cls.camera.wait_until_up('/wind', '/forest/layout', '/forest/state', '/grass/layout',
                                 '/canopy/layout', '/agents')
        cls.crowd.wait_until_up()
        cls.grass.wait_until_up('/wind')
        cls.clock.begin(cls.forest)

    def run_for(self, ticks):
        self.clock.run(ticks, self.forest, self.grass, self.crowd)

    def test_1_it_announces_itself_without_a_subscriber(self):
        announced = self.interest.wait(lambda all: all[:1], 'an announcement',
                                       lambda: self.run_for(1))[0]
        self.assertEqual(announced.id, '/vegetation_camera')
        self.assertEqual((announced.range, announced.tolerance), (40.0, 0.02))
        place = announced.position
        self.assertEqual((place.x, place.y, place.z), (-10.0, 0.0, 1.6))

    def test_2_all_images_are_of_one_instant_and_frame(self):
        messages = self.take()
        stamps = {m.header.stamp for m in messages.values()}
        self.assertEqual(len(stamps), 1, messages.keys())
        self.assertEqual({m.header.frame_id for m in messages.values()}, {'garden_camera'})
        self.assertEqual({m.width for m in messages.values()}, {161})
        self.assertEqual({m.height for m in messages.values()}, {121})
        self.assertEqual([messages[name].encoding for name, _ in Camera.TOPICS],
                         ['rgb8', '32FC1', '16UC1', '32SC1'])
        info = messages['info of picture']
        focal = 80.5 / math.tan(0.6)
        numpy.testing.assert_allclose(info.K, [focal, 0, 80, 0, focal, 60, 0, 0, 1], rtol=1e-12)
        self.assertEqual((info.distortion_model, list(info.D)), ('plumb_bob', [0.0] * 5))
        self.assertEqual(info.P[0], focal)
        self.assertEqual(messages['info of depth'], info)

    def test_3_labels_instances_and_depths_are_those_of_the_garden(self):
        messages = self.take()
        label, instance, depth, picture = (array_of(messages[name]) for name in
                                           ('label', 'instance', 'depth', 'picture'))
        for kind in ('GROUND', 'BRANCH', 'LEAF', 'GRASS', 'PERSON', 'FOLIAGE', 'NONE'):
            self.assertTrue((label == getattr(ScanReport, kind)).any(), kind)
        of_none = numpy.isin(label, (ScanReport.NONE, ScanReport.GROUND, ScanReport.GRASS))
        self.assertTrue((instance[of_none] == -1).all())
        self.assertTrue((instance[~of_none] >= 0).all())
        self.assertTrue(numpy.isposinf(depth[label == ScanReport.NONE]).all())
        self.assertTrue(numpy.isfinite(depth[label != ScanReport.NONE]).all())
        self.assertGreater(picture.std(), 20.0)
        sky = picture[label == ScanReport.NONE].mean(axis=0)
        grass = picture[label == ScanReport.GRASS].mean(axis=0)
        self.assertGreater(sky[2], grass[2] + 50.0)
        self.assertGreater(grass[1], grass[2])
        people = self.people_at(messages['label'].header.stamp)
        seen = set(instance[label == ScanReport.PERSON])
        self.assertTrue(seen and seen <= set(people), (seen, set(people)))
        for person in seen:  # Limbs are within 0.6 m of the middle.
            middle = numpy.median(depth[(label == ScanReport.PERSON) & (instance == person)])
            self.assertAlmostEqual(middle, people[person] + 10.0, delta=0.6)

    def test_4_the_calibration_of_a_file_is_that_of_the_lens(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, 'calibration.yaml')
            with open(name, 'w') as file:
                file.write(CALIBRATION)
            with ground_camera(name) as ground:
                info = self.check_ground(ground)
                self.assertEqual((info.K[0], info.K[4], info.K[2], info.K[5]),
                                 (140.0, 138.0, 82.0, 59.0))
                self.assertEqual(list(info.D), [-0.2, 0.03, 0.001, -0.002, 0.0])
                # The ray of the principal point.
                depth = array_of(self.take(ground)['depth'])
                self.assertAlmostEqual(depth[59, 82], HEIGHT / math.sin(DOWN), delta=2e-3)

                wanted = copy.deepcopy(info)
                wanted.D = [-0.1, 0.01, 0.0, 0.001, 0.0]
                wanted.K = [120.0, 0, 75.0, 0, 125.0, 66.0, 0, 0, 1]
                answer = ground.calibrate(wanted)
                self.assertTrue(answer.success, answer)
                self.assertIn('saved in file://' + name, answer.status_message)
                self.assertEqual(self.check_ground(ground).K, tuple(wanted.K))
            with ground_camera(name) as ground:
                info = self.check_ground(ground)
                numpy.testing.assert_allclose(info.K, wanted.K, rtol=1e-12)
                numpy.testing.assert_allclose(info.D, wanted.D, rtol=1e-12)
                os.remove(name)
                os.mkdir(name)  # no file can take this name
                self.assertIn('cannot be written', ground.calibrate(wanted).status_message)

    def test_5_calibrations_that_no_picture_follows_are_refused(self):
        before = self.take()['info of picture']
        nan = float('nan')
        for words, change in (
                ('width = 640 pixel, allowed is that of the camera, 161 pixel', dict(width=640)),
                ('height = 0 pixel, allowed is that of the camera, 121 pixel', dict(height=0)),
                ("distortion_model = 'equidistant' is not plumb_bob",
                 dict(distortion_model='equidistant')),
                ('D has 4 numbers', dict(D=[0.0] * 4)), ('k1 = nan is', dict(D=[nan] + [0.0] * 4)),
                ('fx = nan pixel is', dict(K=[nan] + list(before.K[1:]))),
                ('K[1] = 3 is outside 0 to 0', dict(K=[before.K[0], 3.0] + list(before.K[2:]))),
                ('P[2] = nan is', dict(P=list(before.P[:2]) + [nan] + list(before.P[3:]))),
                ('P[0] = -5 is outside', dict(P=[-5.0] + list(before.P[1:]))),
                ('P[0] = 0 is outside 0.001 to', dict(D=[-0.1] + [0.0] * 4, P=[0.0] * 12)),
                ('R[0] = 0 is outside 0.999 to 1.001', dict(R=[0.0] * 9)),
                ('R is no rotation', dict(D=[-0.1] + [0.0] * 4, R=[1.0] * 9)),
                ('roi.x_offset = 3 is outside 0 to 0', dict(roi=RegionOfInterest(x_offset=3))),
                ("distortion_model = '" + 60 * 'x' + "...' is not", dict(distortion_model=1000 * 'x')),
                ('binning_x = 2 is outside 0 to 1', dict(binning_x=2)),
                ('no inverse at pixel', dict(D=[-9.0, 0.0, 0.0, 0.0, 0.0]))):
            with self.subTest(words=words):
                bad = copy.deepcopy(before)
                for name, value in change.items():
                    setattr(bad, name, value)
                answer = self.camera.calibrate(bad)
                self.assertFalse(answer.success)
                self.assertIn(words, answer.status_message)
        after = self.take()['info of picture']
        self.assertGreater(after.header.stamp, before.header.stamp)
        after.header = before.header
        self.assertEqual(after, before)

    def test_6_the_picture_follows_the_lens(self):
        before = self.take()
        info = copy.deepcopy(before['info of picture'])
        wanted = copy.deepcopy(info)
        wanted.K = [2 * info.K[0], 0, info.K[2], 0, 2 * info.K[4], info.K[5], 0, 0, 1]
        wanted.P = [*wanted.K[:3], 0, *wanted.K[3:6], 0, *wanted.K[6:], 0]
        self.assertIn('not saved without camera_info_url',
                      self.camera.calibrate(wanted).status_message)
        after = self.take()
        self.assertTrue(self.camera.calibrate(info).success)
        self.assertEqual(after['info of depth'].K, tuple(wanted.K))
        # With twice the focal length, every second pixel of the middle is an old pixel.
        old, new = (array_of(m['label']) for m in (before, after))
        middle, near = old[30:91, 40:121], new[0:121:2, 0:161:2]
        self.assertGreater((middle == near).mean(), 0.8)
        self.assertLess((old == new).mean(), 0.8)

    def check_ground(self, camera):
        """Checks that the depths of a camera over bare ground are those of its calibration, which
        is returned."""
        messages = self.take(camera)
        info, depth = messages['info of depth'], array_of(messages['depth'])
        # The camera looks down by DOWN: a pixel's ray falls by sin(DOWN) + y cos(DOWN) per depth.
        x, y = undistorted(info)
        fall = math.sin(DOWN) + y * math.cos(DOWN)
        hit = (depth > 0.0) & numpy.isfinite(depth)
        self.assertTrue(hit[60:].all())
        numpy.testing.assert_allclose((depth * fall)[hit], HEIGHT, atol=2e-3)
        return info

    def take(self, camera=None):
        """Returns all messages of one stamp."""
        camera = camera or self.camera
        if not hasattr(camera, 'images'):
            camera.subscribe()
        self.run_for(2)
        first = camera.latest(time_of(self.clock.tick), lambda: self.run_for(1))
        newest = max(m.header.stamp for m in first.values())
        return camera.latest(newest, lambda: self.run_for(1))

    def people_at(self, stamp):
        """Returns x of the people by id."""
        state = min(self.crowd.state.messages,
                    key=lambda m: abs((m.header.stamp - stamp).to_sec()))
        return {agent.id: agent.pose.position.x for agent in state.agents}


if __name__ == '__main__':
    rospy.init_node('camera_garden_test')
    rostest.rosrun('vegetation_sim', 'camera_garden', CameraGarden)
