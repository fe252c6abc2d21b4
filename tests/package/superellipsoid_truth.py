#!/usr/bin/env python3
"""The true <V_ex> of superellipsoids |x/a|^p + |y/b|^p + |z/c|^p <= 1 with themselves, for even p.

    python3 tests/package/superellipsoid_truth.py

V, S and M are integrals over the sphere of directions u: the surface is at r u with r = (sum |u_i/a_i|^p)^(-1/p), its
element is r^3 |grad F| / p for F = sum |x_i/a_i|^p, and its mean curvature follows from F's derivatives. For even p
these are analytic, so Gauss-Legendre's rule over an octant converges until rounding stops it: 64 and 96 points agree to
13 digits, and V with its closed form. Shares nothing with vex, and uses no support mapping.
"""
import math


def gauss_legendre(n):
    points = []
    for k in range(1, n + 1):
        x = math.cos(math.pi * (k - 0.25) / (n + 0.5))
        for _ in range(20):
            p0, p1 = 1.0, x
            for j in range(2, n + 1):
                p0, p1 = p1, ((2 * j - 1) * x * p1 - (j - 1) * p0) / j
            slope = n * (x * p1 - p0) / (x * x - 1)
            x -= p1 / slope
        points.append((x, 2 / ((1 - x * x) * slope * slope)))
    return points


def measures(axes, p, n):
    rule = gauss_legendre(n)
    volume = area = curvature = 0.0
    for x, weight_x in rule:
        z = (x + 1) / 2
        for y, weight_y in rule:
            phi = (y + 1) * math.pi / 4
            u = (math.sqrt(1 - z * z) * math.cos(phi), math.sqrt(1 - z * z) * math.sin(phi), z)
            r = sum((u_i / a) ** p for u_i, a in zip(u, axes)) ** (-1 / p)
            gradient = [p * (r * u_i) ** (p - 1) / a**p for u_i, a in zip(u, axes)]
            hessian = [p * (p - 1) * (r * u_i) ** (p - 2) / a**p for u_i, a in zip(u, axes)]
            norm = math.hypot(*gradient)
            mean_curvature = (
                norm**2 * sum(hessian) - sum(g * g * h for g, h in zip(gradient, hessian))
            ) / (2 * norm**3)
            weight = weight_x * weight_y * math.pi  # eight octants, dz = dx/2, dphi = pi/4 dy
            element = r**3 * norm / p
            volume += weight * r**3 / 3
            area += weight * element
            curvature += weight * element * mean_curvature
    return volume, area, curvature


for axes, p in [((1, 1, 1), 2), ((1, 1, 1), 4), ((1, 0.8, 0.6), 4)]:
    closed_form = 8 * math.prod(axes) * math.gamma(1 + 1 / p) ** 3 / math.gamma(1 + 3 / p)
    for n in (64, 96):
        v, s, m = measures(axes, p, n)
        excluded = 2 * v + 2 * m * s / (4 * math.pi)
        print(f"{axes} p={p} n={n}: V {v:.12f} (closed {closed_form:.12f}) S {s:.12f} M {m:.12f} <V_ex> {excluded:.12f}")
