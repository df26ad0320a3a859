# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Charts of speed against accuracy. A chart is one file in registry/: arguments of a bench, the
columns of its file, a drawing. The rest finds and runs benches, reads files and keeps one style."""
