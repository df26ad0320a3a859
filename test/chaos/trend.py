# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""The slope of samples over time, and how well they determine it."""
import math
from collections import namedtuple

# Slope, its standard error, and the time from the first to the last sample.
Trend = namedtuple('Trend', 'slope error duration')


def _correlation(residuals):
    """Returns the correlation of each residual with the next one."""
    squares = sum(r * r for r in residuals)
    return sum(a * b for a, b in zip(residuals, residuals[1:])) / squares if squares else 0.0


def trend_of(points):
    """Returns the trend of (time, value) pairs by linear regression. Memory stays where a fault has
    left it, so that samples are not independent: the error counts only as many as would be, after
    the correlation of neighbours (Santer et al. 2000, doi:10.1029/1999JD901105)."""
    count = len(points)
    if count < 3:
        return Trend(0.0, math.inf, 0.0)
    mean_at = sum(at for at, _ in points) / count
    mean = sum(value for _, value in points) / count
    spread = sum((at - mean_at) ** 2 for at, _ in points)
    slope = sum((at - mean_at) * (value - mean) for at, value in points) / spread
    residuals = [value - mean - slope * (at - mean_at) for at, value in points]
    correlation = max(0.0, _correlation(residuals))
    independent = count * (1.0 - correlation) / (1.0 + correlation)
    squares = sum(r * r for r in residuals)
    error = 0.0 if squares == 0.0 else math.inf
    if independent > 2.0:
        error = math.sqrt(squares / (independent - 2.0) / spread)
    return Trend(slope, error, points[-1][0] - points[0][0])
