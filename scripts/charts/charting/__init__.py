# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Charts of speed against accuracy.

A chart is one file in registry/: the arguments of a bench, the columns of its file, and a drawing.
The other modules find and run benches, read files and define the style.
"""
