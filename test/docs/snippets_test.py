#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every command line of README.md, docs and the tutorials runs, or is in NOT_RUN with the reason.
blocks_test.py tests the other snippets."""
import contextlib
import os
import re
import shlex
import shutil
import unittest

import genpy
import rosbag
import roslaunch.config
import roslaunch.xmlloader
import roslib.packages
import rospy
import rosservice
import rostest
import yaml
from dynamic_reconfigure.client import Client
from rosgraph_msgs.msg import Clock
from vegetation_sim import Forest

from launch_arguments import unknown_in_command
from pages import PACKAGE, PAGES, command_lines, fenced, text
from running import Shell, publish_frame, start_node
from waiting import DEADLINE, wait_for

NOT_RUN = (
    (r'git clone .*', 'It needs the network.'),
    (r'rosdep install .*', 'It installs packages from the network.'),
    (r'scripts/(install_dependencies|test|lint|fuzz)\.sh .*',
     'It installs packages, or builds and runs all tests.'),
    (r'(\$\(rospack find \w+\)/)?scripts/demo\.sh .*',
     'It builds the package; scripts/test_demo.sh runs it with another scenario.'),
    (r'catkin_make', 'It builds the package; scripts/test_system.sh runs it.'),
    (r'xvfb-run .*', 'It draws for 20 s; scripts/test_demo.sh takes a picture with the same tools.'),
    (r'(rosrun rviz )?rviz -d .*', 'It needs a screen; test/rviz has tests of the displays.'),
    (r'(rosrun vegetation_sim charts|physics_bench|devel/\S+_bench).*',
     'It measures for minutes; charts_test and scripts/test.sh run it with --quick.'),
)
CROWD = '_scenario:=' + PACKAGE + '/test/nodes/scenarios/crowd.yaml'


def is_excused(line):
    return any(re.fullmatch(pattern, line) for pattern, _ in NOT_RUN)


class Snippets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shell, cls.grab = Shell(), 1
        cls.frame = publish_frame('lidar', 0.0, 0.0, 1.0)
        cls.clock = rospy.Publisher('/clock', Clock, queue_size=1, latch=True)
        cls.clock.publish(Clock(rospy.Time.now()))

    @classmethod
    def tearDownClass(cls):
        cls.shell.close()

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

    def check_output(self, line, seconds=DEADLINE):
        code, output = self.shell.run(line, seconds)
        self.assertEqual(code, 0, output)
        return output

    def prepare_folder(self, line):
        self.check_output(line)
        self.shell.folder = self.shell.home + '/my/scenes'
        with open(self.shell.folder + '/my_scene.yaml', 'w') as file:
            file.write(fenced('docs/tutorials/1_first_scene.md', 'yaml')[0])

    def call_service(self, line):
        _, _, name, argument, *_ = shlex.split(line)
        # Grabs are numbered from 1, as the pages have it, unless another test has grabbed before.
        if name.endswith(('/move_grab', '/release')):
            argument = argument.replace('id: 1', 'id: %d' % self.grab)
        rospy.wait_for_service(name, DEADLINE)
        service = rosservice.get_service_class_by_name(name)
        request = service._request_class()
        genpy.message.fill_message_args(request, [yaml.safe_load(argument)])
        response = rospy.ServiceProxy(name, service)(request)
        self.assertTrue(response.success, response.message)
        if name.endswith('/grab'):
            Snippets.grab = response.id

    def set_live_parameters(self, line):
        node, values = shlex.split(line)[4:]
        wanted = yaml.safe_load(values)
        changed = Client(node, timeout=DEADLINE).update_configuration(wanted)
        self.assertEqual({name: changed[name] for name in wanted}, wanted)

    def set_parameter(self, line):
        """A node that starts reads the parameter."""
        name, text_of_value = shlex.split(line)[2:]
        self.check_output(line)
        try:
            value = yaml.safe_load(text_of_value)
            self.assertEqual(rospy.get_param(name), value)
            node, key = os.path.split(name)
            start_node('agent_crowd', [CROWD], **({} if node == '/' else {key: value}))
        finally:
            rospy.delete_param(name)

    def start_own_node(self, line):
        _, _, program, *arguments = shlex.split(line)
        start_node(program, arguments)

    def start_example(self, line):
        name = line.split()[1]
        shutil.copytree('%s/examples/%s' % (PACKAGE, name), '%s/%s' % (self.shell.workspace, name))
        self.shell.start('exec ' + line)

    def load_launch_file(self, line):
        _, package, name, *arguments = shlex.split(line)
        file = roslib.packages.find_resource(package, name)[0]
        self.assertEqual(unknown_in_command(file, arguments), [])
        config = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader().load(file, config, argv=arguments, verbose=False)
        self.assertTrue(config.nodes)

    def export_trees(self, line):
        self.check_output(line)
        self.assertGreater(os.path.getsize(self.shell.folder + '/FOLDER/model.sdf'), 1000)

    def print_something(self, line):
        self.assertTrue(self.check_output(line))

    def filter_topic(self, line):
        """On a busy machine the first message may need more seconds than the page gives."""
        for seconds in ('3', '20'):
            _, output = self.shell.run(re.sub(r'^timeout \d', 'timeout ' + seconds, line))
            if output:
                return
        self.fail('no output')

    def measure_rate(self, line):
        for seconds in (5, 30):
            _, output = self.shell.run(line, seconds)
            if 'average rate' in output:
                return
        self.fail(output)

    def record(self, line):
        """Events that come while the recorder starts are not in its bag; another push makes one."""
        topics = {word for word in shlex.split(line) if word.startswith('/')}
        bag = os.path.join(self.shell.folder, re.search(r'-O (\S+)', line).group(1))

        def is_heard(topic):
            subscribers = dict(rospy.get_master().getSystemState()[2][1])
            return any(node.startswith('/record') for node in subscribers.get(topic, []))

        def records_all():
            recorder = self.shell.start('exec ' + line)
            wait_for(lambda: all(map(is_heard, topics)), 'the recorder')
            for _ in range(10):
                Forest().push((0, 0, -1), 0.1, tree=0, branch=0)
                rospy.wait_for_message('/forest/state', rospy.AnyMsg, DEADLINE)
            self.shell.stop(recorder)
            wait_for(lambda: os.path.exists(bag), bag)  # the program that writes it ends last
            with rosbag.Bag(bag) as file:
                return set(file.get_type_and_topic_info().topics) == topics
        wait_for(records_all, 'a bag with ' + ', '.join(topics))

    RUN = (
        (r'mkdir -p ~/my/scenes && .*', prepare_folder),
        (r'rosservice call /.*', call_service),
        (r'rosrun dynamic_reconfigure dynparam set .*', set_live_parameters),
        (r'rosparam set /.*', set_parameter),
        (r'rosrun vegetation_sim \w+ _.*', start_own_node),
        (r'rosrun vegetation_sim export_forest my_scene.yaml FOLDER .*', export_trees),
        (r'rosrun planner_map .*', start_example),
        (r'roslaunch vegetation_sim .*', load_launch_file),
        (r'(rostopic echo -n 1 /|rossrv show -r )\S+', print_something),
        (r'timeout \d rostopic echo .*', filter_topic),
        (r'rostopic hz /\S+', measure_rate),
        (r'rosbag record -O .*', record),
    )

    def run_line(self, line):
        run = next((run for pattern, run in self.RUN if re.fullmatch(pattern, line)), None)
        self.assertTrue(run or is_excused(line), 'is neither run nor in NOT_RUN')
        if run:
            run(self, line)

    def test_every_command_line_runs_or_has_a_reason_not_to(self):
        for page in PAGES:
            for line in command_lines(text(page)):
                with self.attempt(page=page, line=line):
                    self.run_line(line)

    def test_a_new_command_line_is_reported(self):
        page = 'Do this:\n\n    docker run x   # now\n\nor `rosnode kill x`.\n'
        self.assertEqual(list(command_lines(page)), ['docker run x', 'rosnode kill x'])
        with self.assertRaisesRegex(AssertionError, 'neither run nor in NOT_RUN'):
            self.run_line('docker run x')
        with self.assertRaisesRegex(AssertionError, 'bogus'):
            self.run_line('roslaunch vegetation_sim demo.launch bogus:=1')

    def test_every_reason_has_a_command_line(self):
        lines = [line for page in PAGES for line in command_lines(text(page))]
        for pattern, _ in NOT_RUN + self.RUN:
            self.assertTrue(any(re.fullmatch(pattern, line) for line in lines), pattern)

    def test_the_first_scene_starts_in_every_node(self):
        lines = command_lines(text('docs/tutorials/1_first_scene.md'))
        self.prepare_folder(next(line for line in lines if line.startswith('mkdir')))
        for node in ('wind_broadcaster', 'forest_animator', 'grass_field', 'agent_crowd'):
            with self.attempt(node=node):
                start_node(node, ['_scenario:=%s/my_scene.yaml' % self.shell.folder])


if __name__ == '__main__':
    rospy.init_node('snippets_test')
    rostest.rosrun('vegetation_sim', 'snippets', Snippets)
