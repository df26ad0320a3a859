#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Sets each number and time of each service request to bad values, one at a time. The node must
answer with an error that names the field, and its snapshot must not change."""
import copy
import pathlib
import unittest

import genpy
import rosservice
import rospy
import rostest
from geometry_msgs.msg import (Point, PointStamped, Quaternion, Transform, TransformStamped,
                               Vector3, Vector3Stamped)
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
from vegetation_sim import srv
from vegetation_sim.msg import AgentSpawn, ErrorCode, GrassColour, GrassCut, TreadLaw, WindPrimitive

from forest_rig import RATE, TickClock
from given import given
from waiting import wait_for
from watched_node import serves

START = 1000 * RATE
PLACE = PointStamped(point=Point(1.0, -1.0, 0.5))
STEM = PointStamped(point=Point(-3.0, -4.0, 1.0))
SPRING = given(stiffness=500.0, damping=10.0, force_limit=50.0, lease=5.0)
LAW = TreadLaw(**given(radius=0.2, reach=0.4, softness=0.1, load=1.0, recovery=10.0))
WALKER = AgentSpawn(position=Point(1.0, 1.0, 0.0), goal=Point(2.0, 2.0, 0.0), has_goal=True,
                    **given(speed=1.0, radius=0.3, height=1.7))
SOURCE = dict(id=0, fade_in=1.0, fade_out=1.0, trajectory=[PLACE], orbit_radius=1.0, orbit_period=10.0,
              radius=5.0, velocity=Vector3(2.0, 0.0, 0.0), omega=2.0, speed=5.0, core_radius=1.0,
              length_scale=10.0, time_scale=4.0, front_speed=3.0, rise_length=1.0, plateau_length=1.0,
              decay_length=1.0)
CENTRE = 'trajectory', 'orbit_radius', 'orbit_period'
GUST = 'front_speed', 'rise_length', 'plateau_length', 'decay_length', 'repeat'
# Fields of each kind of wind besides those of all kinds.
KINDS = {WindPrimitive.DISK: ('velocity', 'radius', 'omega', 'phase', 'envelope') + CENTRE,
         WindPrimitive.BREEZE: ('velocity', 'turbulence', 'length_scale'),
         WindPrimitive.GUST: ('velocity', 'radius') + GUST + CENTRE,
         WindPrimitive.TORNADO: ('radius', 'speed', 'core_radius', 'inflow', 'updraft') + CENTRE,
         WindPrimitive.BLAST: ('radius', 'speed', 'core_radius') + CENTRE,
         WindPrimitive.WAKE: ('radius', 'inflow', 'plateau_length', 'decay_length') + CENTRE,
         WindPrimitive.GAUSS_MARKOV: ('velocity', 'radius', 'turbulence', 'time_scale') + CENTRE}
OF_ALL_KINDS = 'kind', 'attached_frame', 'fade_in', 'fade_out'


def winds():
    """Yields a request for each kind of wind and the fields that this kind ignores or that may have
    any value: new names and late times."""
    for kind, used in KINDS.items():
        ignored = set(WindPrimitive.__slots__) - set(used) - set(OF_ALL_KINDS)
        yield (srv.SetWindPrimitiveRequest(primitive=WindPrimitive(name='new', kind=kind, **SOURCE)),
               *('primitive.' + name for name in ignored), 'primitive.trajectory.0.header')


# Requests that succeed by service, with the fields that each of them ignores or takes as they are:
# places and stamps that it does not need, heights above the ground, and the page of a list, which
# may lie beyond its end.
REQUESTS = {
    '/forest_animator/apply_force': [
        (srv.ApplyForceRequest(branch=3, along=0.01, duration=0.5,
                               force=Vector3Stamped(vector=Vector3(5.0, 0.0, 0.0))),
         'point', 'force.header'),
        (srv.ApplyForceRequest(nearest=True, duration=0.5, point=STEM,
                               force=Vector3Stamped(vector=Vector3(5.0, 0.0, 0.0))),
         'tree', 'branch', 'along', 'point.header', 'force.header')],
    '/forest_animator/cut_branch': [
        (srv.CutBranchRequest(tree=1, branch=5), 'point')],
    '/forest_animator/find_branch': [(srv.FindBranchRequest(point=STEM), 'point.header')],
    '/forest_animator/find_trees': [
        (srv.FindTreesRequest(centre=PLACE, radius=20.0, limit=5),
         'centre.header', 'offset')],
    '/forest_animator/get_tree': [(srv.GetTreeRequest(tree=1), 'stamp')],
    '/forest_animator/grab': [
        (srv.GrabRequest(branch=3, along=0.01, target=PLACE, **SPRING),
         'point', 'target.header', 'offset'),
        (srv.GrabRequest(nearest=True, point=STEM, frame='hand', offset=Point(0.1, 0.0, 0.0),
                         **SPRING), 'tree', 'branch', 'along', 'point.header', 'target')],
    '/forest_animator/move_grab': [(srv.MoveGrabRequest(id=1, target=PLACE), 'target.header')],
    '/forest_animator/pick': [
        (srv.PickRequest(origin=Point(-13.0, -4.0, 1.0), direction=Vector3(1.0, 0.0, 0.0),
                         tolerance=0.1), 'header')],
    '/forest_animator/release': [(srv.ReleaseRequest(id=2),)],
    '/forest_animator/set_tf': [(srv.SetTfRequest(tree=1, branches=[1], enable=False),)],
    '/grass_field/clear': [
        (srv.ClearGrassRequest(centre=PLACE, radius=1.0), 'centre.header', 'centre.point.z')],
    '/grass_field/cut': [
        (srv.CutGrassRequest(cut=GrassCut(outline=[PLACE.point], radius=0.2, height=0.1)),
         'header.seq', 'cut.outline.0.z')],
    '/grass_field/sample': [
        (srv.SampleGrassRequest(points=[PLACE.point]), 'header', 'points.0.z')],
    '/grass_field/set_colours': [
        (srv.SetGrassColoursRequest(colours=[GrassColour(radius=2.0, colour=0.5, weight=1.0)]),)],
    '/grass_field/tread': [(srv.TreadRequest(points=[PLACE.point], law=LAW),
         'header.seq', 'points.0.z')],
    '/canopy_animator/cut': [
        (srv.CutPlantsRequest(cut=GrassCut(outline=[PLACE.point], radius=0.2, height=0.1)),
         'header.seq', 'cut.outline.0.z')],
    '/canopy_animator/sample': [(srv.SampleCanopyRequest(points=[PLACE.point]), 'header')],
    '/agent_crowd/remove': [(srv.RemoveAgentsRequest(ids=[2]),)],
    '/agent_crowd/set_goal': [
        (srv.SetAgentGoalRequest(ids=[1], goal=PLACE), 'goal.header', 'goal.point.z')],
    '/agent_crowd/spawn': [
        (srv.SpawnAgentsRequest(like=WALKER, count=2, spread=1.0),
         'header.seq', 'like.position.z', 'like.goal.z')],
    '/vegetation_scanner/sky_view': [
        (srv.GetSkyViewRequest(points=[PLACE.point], frames=['hand']),
         'header.seq', 'header.stamp')],
    '/wind_broadcaster/remove_primitive': [(srv.RemoveWindPrimitiveRequest(name='breeze'),)],
    '/wind_broadcaster/sample': [
        (srv.SampleWindRequest(positions=[PLACE.point], stamps=[rospy.Time()]),
         'header', 'stamps')],
    '/wind_broadcaster/set_primitive': list(winds()),
}


def leaves(message, path=()):
    """Yields the path and type of each number, text and time of a message."""
    for name, kind in zip(message.__slots__, message._slot_types):
        value = getattr(message, name)
        if isinstance(value, list):
            for i, entry in enumerate(value):
                if isinstance(entry, genpy.Message):
                    yield from leaves(entry, path + (name, i))
                else:
                    yield path + (name, i), kind[:-2]
        elif isinstance(value, genpy.Message):
            yield from leaves(value, path + (name,))
        else:
            yield path + (name,), kind


def changed(message, path, value):
    out = copy.deepcopy(message)
    owner = out
    for step in path[:-1]:
        owner = owner[step] if isinstance(step, int) else getattr(owner, step)
    if isinstance(path[-1], int):
        owner[path[-1]] = value
    else:
        setattr(owner, path[-1], value)
    return out


class BadRequests(unittest.TestCase):
    NODES = ('wind_broadcaster', 'forest_animator', 'grass_field', 'canopy_animator', 'agent_crowd',
             'vegetation_scanner')

    @classmethod
    def setUpClass(cls):
        cls.clock = TickClock(START)
        for service in REQUESTS:
            wait_for(lambda: cls.clock.show(START) or serves(service), service)
        cls.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        cls.frames.publish([TransformStamped(
            header=Header(frame_id='map'), child_frame_id='hand',
            transform=Transform(STEM.point, Quaternion(0.0, 0.0, 0.0, 1.0)))])
        # Each service succeeds with its requests; a grab is left for the service that moves it.
        for service, requests in REQUESTS.items():
            for request, *_ in requests:
                wait_for(lambda: cls.call(service, request).success, service)
        cls.clock.show(START + 1)

    @staticmethod
    def call(service, request):
        return rospy.ServiceProxy(service, rosservice.get_service_class_by_name(service))(request)

    def snapshot(self, service):
        node = service.split('/')[1]
        if node == 'vegetation_scanner':
            return None  # It has no state of its own.
        answer = self.call('/%s/save_snapshot' % node, srv.SaveSnapshotRequest(name='probe'))
        self.assertTrue(answer.success, answer.message)
        with open(answer.file, 'rb') as file:
            return file.read()

    BAD_VALUES = {'float64': [float('nan'), float('inf'), float('-inf'), 1e300, -1e300],
                  'time': [rospy.Time(10 ** 9)],
                  'uint8': [255], 'uint16': [2 ** 16 - 1], 'uint32': [2 ** 32 - 1],
                  'int32': [-2 ** 31, 2 ** 31 - 1], 'uint64': [2 ** 64 - 1],
                  'string': ['no such name', 'x' * 100000]}

    BAD_VALUE_CODES = ErrorCode.INVALID_VALUE, ErrorCode.UNKNOWN, ErrorCode.NO_TRANSFORM

    def test_every_service_of_a_request_is_here(self):
        services = {s for s in rosservice.get_service_list()
                    if s.split('/')[1] in self.NODES and
                    rosservice.get_service_type(s).startswith('vegetation_sim/') and
                    not rosservice.get_service_type(s).endswith('Snapshot')}
        self.assertEqual(services - {'/wind_broadcaster/get_field'}, set(REQUESTS))

    def test_bad_values_are_rejected_by_name(self):
        problems, count = [], 0
        for service, requests in REQUESTS.items():
            before = self.snapshot(service)
            for request, *ignored in requests:
                for path, kind in leaves(request):
                    name = '.'.join(map(str, path))
                    field = [step for step in path if isinstance(step, str)][-1]
                    uses = not any((name + '.').startswith(one + '.') for one in ignored)
                    for value in self.BAD_VALUES.get(kind, []):
                        if uses:
                            answer = self.call(service, changed(request, path, value))
                            count += 1
                            if (answer.success or field not in answer.message or
                                    answer.error_code not in self.BAD_VALUE_CODES):
                                problems.append((service, name, value, answer.error_code,
                                                 answer.message))
            if self.snapshot(service) != before:
                problems.append((service, 'has changed the snapshot'))
        print('%d bad values' % count)
        self.assertEqual(problems, [], '\n'.join(map(str, problems)))

    def test_each_reason_has_its_code(self):
        file = pathlib.Path(self.call('/grass_field/save_snapshot',
                                      srv.SaveSnapshotRequest(name='whole')).file)
        torn = file.parent.parent / 'torn' / file.name
        torn.parent.mkdir(exist_ok=True)
        torn.write_bytes(file.read_bytes()[:-1])
        away = Point(9e5, 0.0, 0.0)
        cases = [
            (ErrorCode.NONE, '/grass_field/load_snapshot', srv.LoadSnapshotRequest(name='whole')),
            (ErrorCode.INVALID_VALUE, '/agent_crowd/spawn',
             srv.SpawnAgentsRequest(like=WALKER, count=0)),
            (ErrorCode.UNKNOWN, '/grass_field/load_snapshot', srv.LoadSnapshotRequest(name='none')),
            (ErrorCode.UNKNOWN, '/forest_animator/get_tree', srv.GetTreeRequest(tree=99)),
            (ErrorCode.NO_TRANSFORM, '/grass_field/sample', srv.SampleGrassRequest(
                header=Header(frame_id='nowhere'), points=[PLACE.point])),
            (ErrorCode.INVALID_VALUE, '/vegetation_scanner/sky_view', srv.GetSkyViewRequest()),
            (ErrorCode.INVALID_VALUE, '/vegetation_scanner/sky_view',
             srv.GetSkyViewRequest(points=[PLACE.point] * 64, frames=['hand'])),
            (ErrorCode.NO_TRANSFORM, '/vegetation_scanner/sky_view',
             srv.GetSkyViewRequest(frames=['hand', 'nowhere'])),
            (ErrorCode.NOT_AVAILABLE, '/vegetation_scanner/sky_view', srv.GetSkyViewRequest(
                header=Header(stamp=rospy.Time(1)), points=[PLACE.point])),
            (ErrorCode.NO_ROOM, '/grass_field/tread',
             srv.TreadRequest(points=[Point(-9.0, 0.0, 0.0), Point(9.0, 0.0, 0.0)] * 4000, law=LAW)),
            (ErrorCode.NOT_AVAILABLE, '/grass_field/sample', srv.SampleGrassRequest(
                header=Header(stamp=rospy.Time(1)), points=[PLACE.point])),
            (ErrorCode.NOTHING_FOUND, '/forest_animator/find_branch', srv.FindBranchRequest(
                point=PointStamped(point=away))),
            (ErrorCode.NOTHING_FOUND, '/forest_animator/pick', srv.PickRequest(
                origin=away, direction=Vector3(0.0, 0.0, 1.0), tolerance=0.1)),
            (ErrorCode.FILE_REJECTED, '/grass_field/load_snapshot',
             srv.LoadSnapshotRequest(name='torn'))]
        for code, service, request in cases:
            answer = self.call(service, request)
            self.assertEqual((answer.success, answer.error_code), (code == ErrorCode.NONE, code),
                             (service, answer.message))


if __name__ == '__main__':
    rospy.init_node('bad_requests_test')
    rostest.rosrun('vegetation_sim', 'bad_requests', BadRequests)
