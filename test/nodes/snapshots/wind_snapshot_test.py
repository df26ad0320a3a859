#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots and checkpoints of wind_broadcaster: sources with their ids and times."""
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import TransformStamped, Vector3
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from vegetation_sim.msg import WindPrimitive
from vegetation_sim.srv import GetWindField, RemoveWindPrimitive, SetWindPrimitive

from forest_rig import RATE, time_of
from snapshot_rig import START, SnapshotCase
from waiting import wait_for
from watched_node import listens, publisher, serves


class Air:
    """Client of one wind_broadcaster, for which every time is a tick."""

    def __init__(self, name):
        self.name, self.state = name, self
        self.get = rospy.ServiceProxy(name + '/get_field', GetWindField)
        self.set = rospy.ServiceProxy(name + '/set_primitive', SetWindPrimitive)
        self.remove = rospy.ServiceProxy(name + '/remove_primitive', RemoveWindPrimitive)

    def wait_until_up(self):
        wait_for(lambda: listens(self.name, '/clock'), self.name + ' to subscribe to /clock')

    def wait_for_stamp(self, stamp, remind):
        def has_come():
            if serves(self.name + '/get_field') and self.get().field.header.stamp >= stamp:
                return True
            remind()
            return False
        wait_for(has_come, 'time %s' % stamp)

    def wait_for_services(self):
        pass  # wait_for_stamp() has used them

    def reconnect(self):
        pass

    def close(self):
        pass


class WindSnapshot(SnapshotCase):
    PROGRAM = 'wind_broadcaster'
    SCENE, OTHER_SCENE = 'garden', 'clearing'
    HASHES = 2

    def make_client(self, name, _):
        return Air(name)

    def stamp_of(self, tick):
        return time_of(START + tick) + rospy.Duration.from_sec(0.5 / RATE)

    def act(self, node, tick):
        if tick in (5, 45, 70):
            gust = WindPrimitive(name='disk_%d' % (tick // 45), kind=WindPrimitive.DISK,
                                 velocity=Vector3(0.1 * tick, 0.0, 0.0), radius=20.0, omega=3.0,
                                 fade_in=0.5, fade_out=0.5)
            answer = node.client.set(primitive=gust)
            self.assertTrue(answer.success, answer.message)
            node.ids = getattr(node, 'ids', []) + [answer.id]
        if tick == 125:
            self.assertTrue(node.client.remove(name='disk_1').success)

    def test_ids_continue_after_a_kill(self):
        self.run_with_kills('killed', [(50, False)])
        self.assertEqual(self.nodes[-1].ids, [2, 3, 4])

    def start_saved(self, namespace):
        """Starts a node that saves itself at changes only."""
        return self.start(namespace, 0, checkpoint_period=1000.0, checkpoint=True)

    def restart(self, node):
        """Kills a node, and shows the next process the time."""
        node.kill()
        node.client.wait_until_up()
        self.clock.run(1, node.client)

    def test_a_source_that_waits_for_its_frame_survives_a_kill(self):
        node = self.start_saved('attached')
        rotor = WindPrimitive(name='rotor', kind=WindPrimitive.BLAST, radius=6.0, core_radius=1.0,
                              speed=20.0, fade_in=0.5, fade_out=0.5, attached_frame='drone')
        answer = node.client.set(primitive=rotor)
        self.assertEqual(answer.message, 'begins once tf has a transform of drone')
        self.restart(node)
        tf = publisher('/tf', TFMessage)

        def blows():
            drone = TransformStamped(child_frame_id='drone')
            drone.header.frame_id, drone.header.stamp = 'map', time_of(self.clock.tick)
            drone.transform.rotation.w = 1.0
            tf.publish(TFMessage([drone]))
            self.clock.run(1, node.client)
            return any(p.name == 'rotor' for p in node.client.get().field.primitives)
        wait_for(blows, 'the source of the drone')

    def shown_speed(self, node):
        """Kills a node, and returns the speed of the breeze that a change of nothing keeps."""
        self.restart(node)
        shown = Client(node.name)
        speed = shown.update_configuration({})['breeze_speed']
        shown.close()
        return speed

    def test_the_breeze_that_is_shown_survives_a_kill(self):
        node = self.start_saved('breeze')
        shown = Client(node.name)
        shown.update_configuration({'breeze_speed': 3.0})
        shown.close()
        self.assertEqual(self.shown_speed(node), 3.0)
        breeze = WindPrimitive(name='breeze', kind=WindPrimitive.BREEZE, length_scale=30.0,
                               velocity=Vector3(0.0, 7.0, 0.0))
        answer = node.client.set(primitive=breeze)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(self.shown_speed(node), 7.0)
        self.clock.run(3 * RATE, node.client)  # the earlier ones have ended
        self.assertTrue(node.client.remove(name='breeze').success)
        self.assertEqual(self.shown_speed(node), 0.0)
        self.assertTrue(rospy.ServiceProxy(node.name + '/reset', Trigger)().success)
        self.assertEqual(self.shown_speed(node), 5.0)


if __name__ == '__main__':
    rospy.init_node('wind_snapshot_test')
    rostest.rosrun('vegetation_sim', 'wind_snapshot', WindSnapshot)
