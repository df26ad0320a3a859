# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The charts: each module here defines one as CHART. A new chart needs only a new file."""
import importlib
import pkgutil


def all_charts():
    """Returns {name: chart}, in order of names."""
    modules = sorted(module.name for module in pkgutil.iter_modules(__path__))
    charts = [importlib.import_module('%s.%s' % (__name__, name)).CHART for name in modules]
    return {chart.name: chart for chart in charts}
