# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# catkin reads this file; it is not called by hand.
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=['vegetation_sim'], package_dir={'': 'python'}))
