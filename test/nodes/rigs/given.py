# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The optional numbers of messages."""


def given(**numbers):
    """Returns the numbers and their flags as keyword arguments of a message."""
    return dict(numbers, **{'has_' + name: True for name in numbers})
