#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The snippets of README.md, docs and the tutorials run: service calls succeed, parameters change,
launch files and nodes accept what they are given. test/python runs those of docs/python.md."""
import contextlib
import glob
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

import genpy
import roslaunch.config
import roslaunch.xmlloader
import roslib.packages
import rospy
import rosservice
import rostest
import yaml
from dynamic_reconfigure.client import Client

PACKAGE = roslib.packages.get_pkg_dir('vegetation_sim')
PAGES = ['README.md'] + [os.path.relpath(path, PACKAGE) for path in sorted(
    glob.glob(PACKAGE + '/docs/*.md') + glob.glob(PACKAGE + '/docs/tutorials/*.md'))]
NODES = ('wind_broadcaster', 'forest_animator', 'grass_field', 'agent_crowd')
TIMEOUT = 60.0  # [s]


def text(page):
    with open(os.path.join(PACKAGE, page)) as file:
        return file.read()


def fenced(page, language):
    return re.findall(r'^```%s\n(.*?)^```' % language, text(page), re.S | re.M)


def commands(first):
    """Yields page and words of each indented command line that starts with these words."""
    for page in PAGES:
        for line in re.findall(r'^    (%s .*)' % first, text(page), re.M):
            yield page, shlex.split(line, comments=True)


class Snippets(unittest.TestCase):
    def setUp(self):
        self.failures = []

    def tearDown(self):
        self.assertEqual(self.failures, [])

    @contextlib.contextmanager
    def attempt(self, **what):
        """Goes on after a failure, so that a test reports all snippets that fail."""
        try:
            yield
        except Exception as error:
            self.failures.append((what, str(error)))

    def test_service_calls_succeed(self):
        count, grab = 0, 1
        for page, (_, _, name, argument, *_) in commands('rosservice call'):
            # Grabs are numbered from 1, as the pages have it, unless another test has grabbed before.
            if name.endswith(('/move_grab', '/release')):
                argument = argument.replace('id: 1', 'id: %d' % grab)
            with self.attempt(page=page, name=name, argument=argument):
                rospy.wait_for_service(name, TIMEOUT)
                service = rosservice.get_service_class_by_name(name)
                request = service._request_class()
                genpy.message.fill_message_args(request, [yaml.safe_load(argument)])
                response = rospy.ServiceProxy(name, service)(request)
                self.assertTrue(response.success, response.message)
                grab = response.id if name.endswith('/grab') else grab
                count += 1
        self.assertGreater(count, 10)

    def test_parameters_change(self):
        for page, (_, _, _, _, node, values) in commands('rosrun dynamic_reconfigure dynparam set'):
            with self.attempt(page=page, node=node):
                wanted = yaml.safe_load(values)
                changed = Client(node, timeout=TIMEOUT).update_configuration(wanted)
                self.assertEqual({name: changed[name] for name in wanted}, wanted)

    def test_nodes_accept_their_parameters(self):
        for page, (_, _, program, *arguments) in commands('rosrun vegetation_sim'):
            if any(a.startswith('_') for a in arguments):
                with self.attempt(page=page, program=program):
                    self.start(program, arguments)

    def test_launch_files_accept_their_arguments(self):
        for page, (_, package, name, *arguments) in commands('roslaunch'):
            with self.attempt(page=page, name=name):
                self.load(roslib.packages.find_resource(package, name)[0], arguments)

    def test_includes_accept_their_arguments(self):
        count = 0
        for page in PAGES:
            for block in fenced(page, 'xml'):
                with self.attempt(page=page, block=block):
                    with tempfile.NamedTemporaryFile('w', suffix='.launch') as file:
                        file.write(block if '<launch>' in block else '<launch>%s</launch>' % block)
                        file.flush()
                        self.load(file.name, [])
                    count += 1
        self.assertGreaterEqual(count, 4)

    def test_python_runs(self):
        for block in fenced('docs/tutorials/4_arm.md', 'python'):
            self.show_gripper()
            with self.attempt(block=block):
                code = re.sub(r'^rospy.init_node.*$', '', block, flags=re.M)
                exec(compile(code, '4_arm.md', 'exec'), {})

    def test_the_first_scene_starts_in_every_node(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(folder + '/scenes')
            shutil.copytree(PACKAGE + '/config/species', folder + '/species')
            scene = folder + '/scenes/my_scene.yaml'
            with open(scene, 'w') as file:
                file.write(fenced('docs/tutorials/1_first_scene.md', 'yaml')[0])
            for node in NODES:
                with self.attempt(node=node):
                    self.start(node, ['_scenario:=' + scene])

    def test_yaml_can_be_read(self):
        for page in PAGES:
            for block in fenced(page, 'yaml'):
                with self.attempt(page=page, block=block):
                    self.assertIsInstance(yaml.safe_load(block), dict)

    @staticmethod
    def show_gripper():
        from geometry_msgs.msg import TransformStamped
        from tf2_msgs.msg import TFMessage
        gripper = TransformStamped(child_frame_id='gripper')
        gripper.header.frame_id = 'map'
        at, gripper.transform.rotation.w = gripper.transform.translation, 1.0
        at.x, at.y, at.z = -0.6, -0.8, 2.8
        Snippets.frames = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
        Snippets.frames.publish([gripper])

    @staticmethod
    def load(file, arguments):
        config = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader().load(file, config, argv=arguments, verbose=False)
        assert config.nodes or config.params, 'sets nothing'

    def start(self, program, arguments):
        """Starts a node beside the others, and waits until it has read its parameters."""
        name = 'snippet_%d_%s' % (os.getpid(), program)
        path = roslib.packages.find_node('vegetation_sim', program)[0]
        with tempfile.TemporaryFile('w+') as log:
            process = subprocess.Popen([path, '__name:=' + name, '__ns:=/snippets'] + arguments,
                                       stdout=log, stderr=log)
            try:
                rospy.wait_for_service('/snippets/%s/tf2_frames' % name, TIMEOUT)
                self.assertIsNone(process.poll())
            except rospy.ROSException:
                log.seek(0)
                self.fail('%s did not start: %s' % (program, log.read()[-2000:]))
            finally:
                process.terminate()
                process.wait(TIMEOUT)


if __name__ == '__main__':
    rospy.init_node('snippets_test')
    rostest.rosrun('vegetation_sim', 'snippets', Snippets)
