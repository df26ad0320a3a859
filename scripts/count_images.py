#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the images that vegetation_camera publishes per second of wall time.

usage: count_images.py FILE.rviz SECONDS
The frame measured_camera is placed where the camera of rviz is. First the picture alone is counted,
then all four images.
"""
import math
import sys
import time

import rospy
import yaml
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage

PICTURE = ['camera/image_raw']
ALL = PICTURE + ['camera/depth/image_raw', 'camera/label', 'camera/instance']


def transform(parent, child, translation, rotation):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation = Vector3(*translation)
    message.transform.rotation = Quaternion(*rotation)
    return message


def camera_frames(file):
    """Returns transforms to the eye of the orbiting view of rviz, and on to its optical frame."""
    with open(file) as stream:
        manager = yaml.safe_load(stream)['Visualization Manager']
    view = manager['Views']['Current']
    pitch, yaw = view['Pitch'], view['Yaw']
    out = (math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), math.sin(pitch))
    place = [view['Focal Point'][a] + view['Distance'] * o for a, o in zip('XYZ', out)]
    cz, sz = math.cos((yaw + math.pi) / 2), math.sin((yaw + math.pi) / 2)
    cy, sy = math.cos(pitch / 2), math.sin(pitch / 2)
    world = manager['Global Options']['Fixed Frame']
    return [transform(world, 'measured_camera_body', place, (-sz * sy, cz * sy, sz * cy, cz * cy)),
            # The optical axis z points forward, x to the right, y down (REP 103).
            transform('measured_camera_body', 'measured_camera', (0, 0, 0), (-0.5, 0.5, -0.5, 0.5))]


def count_images(topics, seconds):
    """Returns the number of stamps per second of which all topics have sent an image."""
    arrived = {}
    subscribers = [rospy.Subscriber(topic, Image, lambda image, topic=topic: arrived.setdefault(
        image.header.stamp, set()).add(topic), queue_size=10) for topic in topics]

    def count_complete():
        return sum(len(seen) == len(topics) for seen in list(arrived.values()))

    def wait_beyond(count):
        while count_complete() <= count and not rospy.is_shutdown():
            time.sleep(0.005)
        return time.monotonic()

    # From the arrival of one image to that of another, so that none is counted in part.
    start, before = wait_beyond(2), count_complete()
    while time.monotonic() < start + seconds and not rospy.is_shutdown():
        time.sleep(0.005)
    end = wait_beyond(count_complete())
    for subscriber in subscribers:
        subscriber.unregister()
    return (count_complete() - before) / (end - start)


def main(file, seconds):
    rospy.init_node('count_images', anonymous=True)
    tf = rospy.Publisher('/tf_static', TFMessage, latch=True, queue_size=1)
    tf.publish(TFMessage(camera_frames(file)))
    for name, topics in (('picture', PICTURE), ('all four', ALL)):
        print('%s: %.2f images per second' % (name, count_images(topics, float(seconds))), flush=True)


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
