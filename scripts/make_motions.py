#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes config/motions/march_walk.bvh, march_stand.bvh and march_turn.bvh: a person of 1.75 m who
marches, stands at ease and turns left. All angles are sums of a few sine waves.

usage: scripts/make_motions.py FOLDER
"""
import math
import os
import sys

FRAME_TIME = 1.0 / 30.0  # [s]
WALK_FRAMES, STAND_FRAMES, TURN_FRAMES = 76, 90, 30
WALK_CYCLE = 33  # frames; the file has more than two cycles of 1.1 s
TURN_RATE = 40.0  # [deg/s]
ORDERS = {'XYZ': 'Xrotation Yrotation Zrotation', 'ZXY': 'Zrotation Xrotation Yrotation'}

# Name, offset from the parent [cm], children. Axes: x left, y up, z front.
LIMBS = {
    side: [('%sUpLeg' % side, (9.2 * sign, 0, 0), [
        ('%sLeg' % side, (0, -42.9, 0), [
            ('%sFoot' % side, (0, -43.0, 0), [
                ('End', (0, -3.6, 14.9), [])])])])]
    for side, sign in (('Left', 1), ('Right', -1))}
ARMS = {
    side: [('%sArm' % side, (20.1 * sign, 0, 0), [
        ('%sForeArm' % side, (0, -30.1, 0), [
            ('%sHand' % side, (0, -27.5, 0), [
                ('End', (0, -9.0, 0), [])])])])]
    for side, sign in (('Left', 1), ('Right', -1))}
BODY = ('Hips', (0, 0, 0), LIMBS['Left'] + LIMBS['Right'] + [
    ('Spine', (0, 10.0, 0), [
        ('Chest', (0, 40.4, 0), ARMS['Left'] + ARMS['Right'] + [
            ('Neck', (0, 9.1, 0), [
                ('Head', (0, 8.0, 0), [
                    ('End', (0, 14.0, 0), [])])])])])])


def describe_joint(joint, order, depth=0):
    """Yields the lines of a joint and of its children."""
    name, offset, children = joint
    pad = '  ' * depth
    head = 'ROOT ' + name if depth == 0 else 'End Site' if name == 'End' else 'JOINT ' + name
    yield pad + head
    yield pad + '{'
    yield pad + '  OFFSET %g %g %g' % offset
    if name != 'End':
        places = 'Xposition Yposition Zposition ' if depth == 0 else ''
        yield pad + '  CHANNELS %d %s%s' % (6 if depth == 0 else 3, places, ORDERS[order])
    for child in children:
        yield from describe_joint(child, order, depth + 1)
    yield pad + '}'


def names_of(joint):
    """Yields the names of the joints that have channels, in the order of the file."""
    if joint[0] != 'End':
        yield joint[0]
        for child in joint[2]:
            yield from names_of(child)


def wave(phase, mean, *harmonics):
    """Returns a mean plus harmonics, each a pair of amplitude and phase in cycles."""
    return mean + sum(size * math.cos(2.0 * math.pi * (k + 1) * (phase - at))
                      for k, (size, at) in enumerate(harmonics))


def walk(phase):
    """Returns turns about x, y, z by joint [deg]. The left heel strikes at phase 0."""
    out = {'Hips': (0, -7 * math.cos(2 * math.pi * phase), 4 * math.sin(2 * math.pi * phase)),
           'Spine': (2, 8 * math.cos(2 * math.pi * phase), -4 * math.sin(2 * math.pi * phase)),
           'Chest': (0, 8 * math.cos(2 * math.pi * phase), 0)}
    for side, shift, sign in (('Left', 0.0, 1), ('Right', 0.5, -1)):
        p = phase + shift
        out[side + 'UpLeg'] = (-wave(p, 9, (24, 0.0), (3, 0.3)), 0, 0)
        out[side + 'Leg'] = (wave(p, 24, (22, 0.72), (12, 0.21)), 0, 0)
        out[side + 'Foot'] = (-wave(p, -1, (6, 0.3), (5, 0.45)), 0, 0)
        out[side + 'Arm'] = (wave(p, 0, (30, 0.0)), 0, 8 * sign)
        out[side + 'ForeArm'] = (-wave(p, 20, (12, 0.5)), 0, 0)
    return out


def stand(phase):
    """Returns the turns of a person at ease."""
    sway = math.sin(2 * math.pi * phase)
    out = {'Hips': (0, 0, 3 * sway), 'Spine': (1, 0, -3 * sway), 'Head': (0, 12 * sway, 0)}
    for side, sign in (('Left', 1), ('Right', -1)):
        out[side + 'Arm'] = (8, 0, 10 * sign)
        out[side + 'ForeArm'] = (-25, 0, 0)
        out[side + 'UpLeg'] = (0, 0, -3 * sway)
    return out


def turn(phase):
    """Returns the turns of a person who turns left at TURN_RATE."""
    out = {'Hips': (0, TURN_RATE * TURN_FRAMES * FRAME_TIME * phase, 0),
           'Spine': (0, 5, 3), 'Chest': (0, 5, 0)}
    for side, sign in (('Left', 1), ('Right', -1)):
        out[side + 'Arm'] = (0, 0, 10 * sign)
    return out


def write(path, order, frames, cycle, pose):
    """Writes a file in which `pose` gives the turns at a phase."""
    lines = ['HIERARCHY', *describe_joint(BODY, order), 'MOTION', 'Frames: %d' % frames,
             'Frame Time: %.6f' % FRAME_TIME]
    names = list(names_of(BODY))
    for frame in range(frames):
        turns = pose(frame / cycle)
        numbers = [0.0, 93.0, 140.0 * frame / cycle if pose is walk else 0.0]
        for name in names:
            angles = dict(zip('XYZ', turns.get(name, (0, 0, 0))))
            numbers += [angles[axis] for axis in order]
        lines.append(' '.join('%.2f' % number for number in numbers))
    with open(path, 'w', encoding='ascii') as file:
        file.write('\n'.join(lines) + '\n')


def main():
    """Writes the three files."""
    folder = sys.argv[1]
    write(os.path.join(folder, 'march_walk.bvh'), 'ZXY', WALK_FRAMES + 1, WALK_CYCLE, walk)
    write(os.path.join(folder, 'march_stand.bvh'), 'XYZ', STAND_FRAMES + 1, STAND_FRAMES, stand)
    write(os.path.join(folder, 'march_turn.bvh'), 'XYZ', TURN_FRAMES + 1, TURN_FRAMES, turn)


if __name__ == '__main__':
    main()
