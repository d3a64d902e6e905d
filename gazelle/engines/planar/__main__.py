"""Compile all kernels ahead of their first use: ``python -m gazelle.engines.planar``."""

from __future__ import annotations

import numpy as np

from gazelle.engines.planar.astray import AstrayScanner
from gazelle.engines.planar.fans import Fan, Mount, RangeNoise, Scanner
from gazelle.engines.planar.fleet import Body, Drive, Fleet
from gazelle.engines.planar.kernels_odometry import reckon
from gazelle.engines.planar.kernels_wander import wander
from gazelle.engines.planar.pictures import Lens, Painter, Scenery, View, prism
from gazelle.engines.planar.roaming import Roaming
from gazelle.engines.planar.shapes import Part


def compile_ahead() -> None:
    """Use every kernel once, so that it is kept for all later runs on this machine."""
    disc = (Part.circle(0.0, 0.0, 0.1),)
    for threads, count, sweep in ((1, 1, False), (2, 200, False), (1, 1, True), (2, 200, True)):
        bodies = [Body(disc, (0.5 * i, 0.0, 0.0), drive=Drive()) for i in range(count)]
        fleet = Fleet(bodies, threads=threads, sweep=sweep)
        for noise in (None, RangeNoise(0.01)):
            scanner = Scanner(fleet, Fan.spread(1.0, 9, 2.0), [Mount(0)], noise=noise)
            Roaming(fleet, scanner).run(1)
        fleet.close()
    crowd = Fleet([Body(disc)], [Part.circle(1.0 + i, 0.0, 0.3) for i in range(300)])
    for count in (1, 60):  # fans of few beams and scans among many statics have their own
        Scanner(crowd, Fan.spread(1.0, count, 2.0), [Mount(0)]).scan()
    AstrayScanner(crowd, Fan.spread(1.0, 2, 2.0), [Mount(0)], np.full(1, 0.01)).scan()
    faces = prism([(1.0, 0.0), (2.0, 0.0), (1.0, 1.0)], 0.0, 1.0, (255.0, 0.0, 0.0))
    whole, one = np.zeros(1, np.int64), np.ones((1, 3))
    wander(0, 1, np.ones(6), 0, whole, whole, whole, one, one, np.zeros((1, 2), np.int64))
    reckon(0, 1, 1, 1, one, one, one, 0.1, False)
    painter = Painter(crowd, Scenery(faces, [faces]))
    painter.draw(Lens(4, 4, (1.0, 1.0)), [View(0, z=0.5)], np.zeros(1, np.intp))


if __name__ == "__main__":
    compile_ahead()
