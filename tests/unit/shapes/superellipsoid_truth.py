#!/usr/bin/env python3
"""S and M of superellipsoids in 20 digits, for measures_test.cpp.

    python3 tests/unit/shapes/superellipsoid_truth.py        (Debian's python3-mpmath; some minutes)

S is the integral over directions u of r^2 / (n . u), r u the point of the surface and n its normal, by the gradient of
the gauge; M that of the support function, the dual norm, over directions. Both by mpmath's tanh-sinh over an octant: no
cone measure and no density of Dirichlet's, which is how vex computes them, and no code of vex.
"""
from mpmath import mp, mpf, quad, cos, sin, pi, gamma, sqrt

mp.dps = 22


def norm(u, v, p):
    largest, least = max(u, v), min(u, v)
    return largest * (1 + (least / largest) ** p) ** (1 / p)


def measures(a, b, c, across, along):
    a, b, c = mpf(a), mpf(b), mpf(c)
    p, q = 2 * mpf(across), 2 * mpf(along)
    p_dual, q_dual = p / (p - 1), q / (q - 1)

    def direction(theta, phi):
        return sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)

    def height(theta, phi):
        x, y, z = direction(theta, phi)
        return norm(norm(a * x, b * y, p_dual), c * z, q_dual) * sin(theta)

    def area(theta, phi):
        x, y, z = direction(theta, phi)
        plane = norm(x / a, y / b, p)
        gauge = norm(plane, z / c, q)
        of_plane, of_axis = (plane / gauge) ** (q - 1), (z / c / gauge) ** (q - 1)
        gradient = (of_plane * (x / a / plane) ** (p - 1) / a, of_plane * (y / b / plane) ** (p - 1) / b, of_axis / c)
        return sqrt(sum(g * g for g in gradient)) / gauge**3 * sin(theta)

    middle = mp.atan2(a, c)
    over = ([0, middle, pi / 2], [0, mp.atan2(b, a), pi / 2])
    volume = (8 * a * b * c * gamma(1 + 1 / p) ** 2 / gamma(1 + 2 / p) * gamma(1 + 1 / q) * gamma(1 + 2 / q)
              / gamma(1 + 3 / q))
    return volume, 8 * quad(area, *over), 8 * quad(height, *over)


if __name__ == "__main__":
    for sizes in [("1", "1", "1", "0.75", "0.75"), ("1", "1", "1", "1.5", "1.5"), ("1", "1", "1", "4", "4"),
                  ("0.5", "0.75", "1", "1.5", "0.75"), ("1", "1", "5", "3", "1.25"), ("1", "2", "3", "0.625", "6")]:
        print(",".join(sizes), *(mp.nstr(x, 17) for x in measures(*sizes)), flush=True)
