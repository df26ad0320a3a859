#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Diagnostics name what has interrupted a node: a process that was stopped, a start from a
checkpoint, and a request that was refused. A small step of the clock back interrupts nothing."""
import os
import signal
import tempfile
import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from vegetation_sim.msg import ScanReport
from vegetation_sim.srv import SaveSnapshot

from forest_rig import RATE, TickClock, start_node, stop, time_of
from waiting import wait_for
from watched_node import Log, all_delivered, publisher, serves, slave, wait_for_readers

NODES = '/wind_broadcaster', '/forest_animator', '/grass_field', '/canopy_animator', '/agent_crowd'
SCANNER = '/vegetation_scanner'
STOP = 1.5  # [s] of wall time


class Interruptions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(1000 * RATE)
        cls.reports = Log('/diagnostics', DiagnosticArray)
        wait_for_readers('/clock', *NODES, SCANNER)
        for node in NODES:
            cls.wait_until_begun(node)

    @classmethod
    def wait_until_begun(cls, node):
        wait_for(lambda: cls.clock.show(cls.clock.tick) or serves(node + '/reset'), node)

    def wait_for_warning(self, node, words, first):
        """Waits for a warning of a node with these words after `first` reports."""
        def found():
            return [s for m in self.reports.messages[first:] for s in m.status
                    if s.name.startswith(node.lstrip('/') + ':') and words in s.message and
                    s.level == DiagnosticStatus.WARN]
        return wait_for(found, '%s to report "%s"' % (node, words))

    def pid(self, node):
        return slave(node).getPid(rospy.get_name())[2]

    def test_a_process_that_was_stopped(self):
        # A node has a first beat once its services answer.
        for node in NODES + (SCANNER,):
            wait_for(lambda: any(s.name.startswith(node.lstrip('/') + ':')
                                 for m in list(self.reports.messages) for s in m.status), node)
        first = len(self.reports.messages)
        processes = [self.pid(node) for node in NODES + (SCANNER,)]
        for process in processes:
            os.kill(process, signal.SIGSTOP)
        threading.Event().wait(STOP)
        for process in processes:
            os.kill(process, signal.SIGCONT)
        for node in NODES + (SCANNER,):
            self.wait_for_warning(node, 'no callback ran for 1.', first)

    def test_a_request_that_is_refused(self):
        for node in NODES:
            first = len(self.reports.messages)
            answer = rospy.ServiceProxy(node + '/save_snapshot', SaveSnapshot)(name='../bad')
            self.assertFalse(answer.success)
            kind = 'input' if node == '/wind_broadcaster' else 'request'
            self.wait_for_warning(node, 'refused %s: save_snapshot' % kind, first)

    def test_a_start_from_a_checkpoint(self):
        with tempfile.TemporaryDirectory() as folder:
            for program in NODES:
                self.expect_continuation(program.lstrip('/'), '/second' + program, folder)

    # The time of a sweep is 0.1 s behind the clock, so that it needs frames from before the step.
    def test_frames_outlive_a_small_step_of_the_clock_back(self):
        tf, points = publisher('/tf', TFMessage), Log('/lidar/report', ScanReport)
        wait_for_readers('/tf', SCANNER)
        wait_for(points.connected, points.topic)

        def advance(ticks):
            for _ in range(ticks):
                self.publish_frame(tf, time_of(self.clock.tick + 1))
                wait_for(all_delivered, 'the frame')
                rospy.ServiceProxy(SCANNER + '/tf2_frames', FrameGraph)()
                self.clock.run(1)
        wait_for(lambda: advance(1) or points.messages, 'a sweep')
        for _ in range(3):
            self.clock.show_time(time_of(self.clock.tick) - rospy.Duration.from_sec(0.05))
            advance(3)
        points.wait(lambda all: all[-1].header.stamp >= time_of(self.clock.tick - 6), 'the end')
        stamps = [m.header.stamp.to_sec() for m in points.messages]
        self.assertLess(max(b - a for a, b in zip(stamps, stamps[1:])), 0.11)

    @staticmethod
    def publish_frame(tf, stamp):
        frame = TransformStamped(child_frame_id='lidar')
        frame.header.frame_id, frame.header.stamp = 'map', stamp
        frame.transform.rotation.w = 1.0
        tf.publish(TFMessage([frame]))

    def expect_continuation(self, program, name, folder):
        parameters = dict(snapshot_folder=folder, checkpoint_period=0.1, checkpoint=True)
        process = start_node(program, name, {}, **parameters)
        try:
            self.wait_until_begun(name)
            file = os.path.join(folder, 'checkpoint', 'second.%s.snapshot' % program)
            wait_for(lambda: self.clock.run(1) or os.path.exists(file), file)
            stop(process, signal.SIGKILL)
            first = len(self.reports.messages)
            process = start_node(program, name, {}, **parameters)
            self.wait_until_begun(name)
            self.wait_for_warning(name, 'continues from its checkpoint of 100', first)
        finally:
            stop(process)


if __name__ == '__main__':
    rospy.init_node('interruptions_test')
    rostest.rosrun('vegetation_sim', 'interruptions', Interruptions)
