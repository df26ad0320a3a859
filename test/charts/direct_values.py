# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Values of charts, computed from their definitions and not by a bench."""
import cmath
import math

DAMPING_RATIO = 0.1  # of the joint in stability_limits
SPEED, TURBULENCE, LENGTH_SCALE = 5.0, 0.3, 40.0  # of the wind in breeze_spectrum
LOWEST_HZ, HIGHEST_HZ = 0.01, 2.0
SHARES = {'along': 1.0, 'across': 0.8, 'up': 0.5}  # of the rms along the wind


def runge_kutta_limit():
    """Returns the largest stable h w of the fourth order for an oscillator, by bisection."""
    root = complex(-DAMPING_RATIO, math.sqrt(1.0 - DAMPING_RATIO ** 2))

    def grows(step):
        z = step * root
        return abs(1 + z + z ** 2 / 2 + z ** 3 / 6 + z ** 4 / 24) > 1.0
    low, high = 1.0, 6.0
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low


def semi_implicit_limit():
    """Returns the largest h w at which no eigenvalue of a step of the rate, then of the angle, is
    outside the unit circle, by bisection."""
    def grows(step):
        trace = 2.0 - 2.0 * DAMPING_RATIO * step - step ** 2
        determinant = 1.0 - 2.0 * DAMPING_RATIO * step
        root = cmath.sqrt(trace ** 2 / 4.0 - determinant)
        return max(abs(trace / 2.0 + root), abs(trace / 2.0 - root)) > 1.0
    low, high = 0.5, 4.0
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low


def step_limits():
    """Returns {method: largest stable step times the frequency of the joint}."""
    return {'explicit Euler': 2.0 * DAMPING_RATIO, 'semi-implicit Euler': semi_implicit_limit(),
            'Runge-Kutta 4': runge_kutta_limit()}


def density(hertz, component):
    """Returns von Karman's one-sided density [(m/s)^2/Hz] with the whole variance in the band."""
    def shape(f):
        return (1.0 + 70.8 * (f * LENGTH_SCALE / SPEED) ** 2) ** (-5.0 / 6.0)
    parts = 20000
    width = (HIGHEST_HZ - LOWEST_HZ) / parts
    area = width * sum(shape(LOWEST_HZ + (i + 0.5) * width) for i in range(parts))
    return (SHARES[component] * TURBULENCE * SPEED) ** 2 * shape(hertz) / area


def check_step_limits(test, rows):
    """Checks the measured limits of one joint in the rows of stability_limits."""
    limits, seen = step_limits(), set()
    for row in rows:
        if row.map != 'stiffness' or row.method not in limits:
            continue
        seen.add(row.method)
        wanted = limits[row.method] / math.sqrt(row.x)
        test.assertAlmostEqual(row.y / wanted, 1.0, delta=1e-3, msg=str(row))
    test.assertEqual(seen, set(limits))


def check_breeze(test, rows):
    """Checks rms, stated and measured density in the rows of breeze_spectrum."""
    for component, share in SHARES.items():
        rms = [row.measured for row in rows if row.quantity == 'rms_' + component]
        wanted = share * TURBULENCE * SPEED
        test.assertAlmostEqual(sum(rms) / len(rms) / wanted, 1.0, delta=0.05, msg=component)
        bands = [row for row in rows if row.quantity == 'density_' + component and row.stated > 0.0
                 and 0.05 < row.seed_or_hz < 1.0]
        test.assertGreater(len(bands), 8)
        ratios = []
        for row in bands:
            direct = density(row.seed_or_hz, component)
            test.assertAlmostEqual(row.stated / direct, 1.0, delta=2e-3, msg=str(row))
            ratios.append(row.measured / direct)
        test.assertAlmostEqual(sum(ratios) / len(ratios), 1.0, delta=0.1, msg=component)
