# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs shell lines, and starts nodes, beside the nodes of the test."""
import itertools
import os
import shutil
import signal
import subprocess
import tempfile

import roslib.packages
import rosgraph
import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph

from waiting import DEADLINE, wait_for

NAME = '__name:='
numbers = itertools.count()  # of the nodes that were started


def publish_frame(name, x, y, z):
    """Publishes a frame that stands in the frame map while the returned publisher exists."""
    frame = TransformStamped(child_frame_id=name)
    frame.header.frame_id, frame.transform.rotation.w = 'map', 1.0
    at = frame.transform.translation
    at.x, at.y, at.z = x, y, z
    publisher = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
    publisher.publish([frame])
    return publisher


class Shell:
    """A home folder in which shell lines run, with a workspace for examples."""

    def __init__(self):
        self.home = self.folder = tempfile.mkdtemp()
        self.workspace = self.home + '/workspace'
        self.environment = dict(os.environ, HOME=self.home, ROS_PACKAGE_PATH='%s:%s' % (
            self.workspace, os.environ.get('ROS_PACKAGE_PATH', '')))
        self.processes = []

    def run(self, line, seconds=DEADLINE):
        """Returns exit code and output of a line, which is interrupted after some seconds."""
        done = subprocess.run(['timeout', '-s', 'INT', str(seconds), 'bash', '-c', line], text=True,
                              stdout=subprocess.PIPE, cwd=self.folder, env=self.environment)
        return done.returncode, done.stdout

    def start(self, line):
        self.processes.append(subprocess.Popen(['bash', '-c', line], cwd=self.folder,
                                               env=self.environment, start_new_session=True))
        return self.processes[-1]

    def stop(self, process):
        self.processes.remove(process)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        process.wait(DEADLINE)

    def close(self):
        for process in list(self.processes):
            self.stop(process)
        shutil.rmtree(self.home)


def answers(name):
    """Returns whether a node has started: it answers only once it spins."""
    try:
        rosgraph.Master(rospy.get_name()).lookupService(name)
        rospy.ServiceProxy(name, FrameGraph)()
        return True
    except (rosgraph.MasterException, rospy.ServiceException):
        return False


def start_node(program, arguments, **parameters):
    """Starts a node, waits until it has read its parameters, and stops it. It has the name that the
    arguments give it, or a new one. Raises AssertionError with its log if it has ended before."""
    names = [word[len(NAME):] for word in arguments if word.startswith(NAME)]
    arguments = [word for word in arguments if not word.startswith(NAME)]
    name = '/snippets/' + (names or ['snippet_%d_%d_%s' % (os.getpid(), next(numbers), program)])[0]
    if parameters:
        rospy.set_param(name, parameters)
    path = roslib.packages.find_node('vegetation_sim', program)[0]
    with tempfile.TemporaryFile('w+') as log:
        process = subprocess.Popen(
            [path, NAME + os.path.basename(name), '__ns:=/snippets'] + arguments,
            stdout=log, stderr=log)
        try:
            wait_for(lambda: process.poll() is not None or answers(name + '/tf2_frames'), name)
            if process.poll() is not None:
                log.seek(0)
                raise AssertionError('%s has ended: %s' % (program, log.read()[-2000:]))
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(DEADLINE)
            if rospy.has_param(name):
                rospy.delete_param(name)
