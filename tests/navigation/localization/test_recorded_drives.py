"""amcl's own test drives, restated without a graph: every scan is used, whatever else the machine does.

Paths, parameters, first guesses, tolerances and times are those of the rostest files in ``amcl/test``; the hall is
ours, as their map and bags are not at hand. Its map has the surfaces of walls, as one made by a laser, and is
unknown inside. ``-s`` prints how far each estimate is off::

    pytest -m long -s tests/navigation/localization/test_recorded_drives.py
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from amcl_drives import DRIVES, WORLD, command, hall, save_hall, seen_hall

import gazelle
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.localization import AmclSettings, Localizer, PlanarScan
from gazelle.stage import stage_of

COMMON = {
    "min_particles": 500, "max_particles": 5000, "kld_err": 0.05, "laser_max_beams": 30, "laser_z_hit": 0.5,
    "laser_z_short": 0.05, "laser_z_rand": 0.5, "update_min_d": 0.2, "update_min_a": 0.5, "resample_interval": 1,
}  # fmt: skip
STILL = {"recovery_alpha_slow": 0.0, "recovery_alpha_fast": 0.0}


def odometry(model, *alphas):
    return {"odom_model_type": model} | {f"odom_alpha{i}": a for i, a in enumerate(alphas, 1)}


OMNI = odometry("omni", 0.2, 0.2, 0.8, 0.2, 0.1) | STILL
TEXAS = odometry("diff", 0.1, 0.3, 0.8, 0.1)
ROUGH = (47.443, 21.421, -1.003)
HALLWAY = (31.872, 31.557, 0.0)
# The file, which drive it plays, what amcl is told of the start, and its parameters.
FILES = {
    "basic_localization_stage": ("basic_localization_stage", ROUGH, OMNI),
    "global_localization_stage": ("global_localization_stage", None, OMNI),
    "rosie_multilaser": ("rosie_multilaser", (42.378, 17.730, 1.583), OMNI),
    "small_loop_prf": ("small_loop_prf", (14.099, 21.063, -0.006), OMNI),
    "small_loop_crazy_driving_prg": ("small_loop_crazy_driving_prg", (14.016, 25.75, -3.0), OMNI),
    "small_loop_crazy_driving_prg_corrected": (
        "small_loop_crazy_driving_prg", (14.016, 25.75, -3.0),
        odometry("omni-corrected", 0.005, 0.005, 0.01, 0.005, 0.003) | STILL,
    ),
    "texas_greenroom_loop": ("texas_greenroom_loop", (14.049, 24.234, -1.517), TEXAS),
    "texas_greenroom_loop_corrected": (
        "texas_greenroom_loop", (14.049, 24.234, -1.517), odometry("diff", 0.04, 0.6, 0.3, 0.04),
    ),
    "texas_willow_hallway_loop": ("texas_willow_hallway_loop", HALLWAY, TEXAS),
    "texas_willow_hallway_loop_corrected": (
        "texas_willow_hallway_loop", HALLWAY, odometry("diff-corrected", 0.04, 0.6, 0.3, 0.04),
    ),
}  # fmt: skip


def as_seen():
    """Return the hall's map as a laser makes one."""
    return OccupancyMap(seen_hall(), 0.1, gazelle.Pose(0.0, 0.0))


def as_built():
    """Return the same map with solid walls."""
    data = np.where(hall(), 100, 0).astype(np.int8)
    return OccupancyMap(data, 0.1, gazelle.Pose(0.0, 0.0))


VARIANCES = np.diag([0.25, 0.25, (math.pi / 12.0) ** 2])
ANGLES = np.linspace(-math.radians(135.0), math.radians(135.0), 541)


def follow(folder, drive, guess, settings, grid):
    """Return the estimate's errors along x and y [m] and in heading [rad]."""
    save_hall(folder)
    path = folder / "drive.world"
    path.write_text(WORLD % (*drive.start[:2], math.degrees(drive.start[2])))
    localizer = Localizer(AmclSettings.read(COMMON | settings), grid, seed=0)
    if guess is None:
        localizer.begin_anywhere()
    else:
        localizer.begin(guess, VARIANCES)
    left = [*drive.via, drive.end[:2]]
    with gazelle.Simulation(path, engine="planar", seed=3) as sim:
        while sim.time < drive.skips + drive.seconds:
            pose = stage_of(sim).poses[0, 0]
            while left and math.dist(pose[:2], left[0]) < 0.1:
                left.pop(0)
            forward, turn = command(pose, left[0] if left else pose, None if left else drive.end[2])
            moves = sim.time > drive.waits
            stage_of(sim).commands[0, 0] = (forward * moves, 0.0, turn * moves)
            sim.step()
            if sim.time < drive.skips:
                continue
            ranges = np.asarray(stage_of(sim).scan_of("r0"), np.float64).ravel()
            scan = PlanarScan(ranges, ANGLES, 30.0, 0.05, (0.25, 0.0, 0.0))
            odom = tuple(stage_of(sim).odometry[0, 0].tolist())
            localizer.update(odom, scan)
        x, y, turned = localizer.map_to_odom
        cos, sin = math.cos(turned), math.sin(turned)
        found = x + cos * odom[0] - sin * odom[1], y + sin * odom[0] + cos * odom[1]
        off = max(abs(a - b) for a, b in zip(found, drive.end[:2], strict=True))
        return off, abs(math.remainder(turned + odom[2] - drive.end[2], 2.0 * math.pi))


@pytest.mark.long
@pytest.mark.parametrize("name", sorted(FILES))
def test_an_estimate_is_as_near_as_the_original_asks(tmp_path, name):
    drive, guess, settings = FILES[name]
    drive = DRIVES[drive]
    off, turned = follow(tmp_path, drive, guess, settings, as_seen())
    print(f"{name}: {off:.2f} m, {turned:.3f} rad")
    assert off < drive.tolerances[0]
    assert turned < drive.tolerances[1]


@pytest.mark.long
def test_solid_walls_draw_an_estimate_ahead_unless_only_their_surfaces_count(tmp_path):
    drive, guess, settings = FILES["rosie_multilaser"]
    ahead, _ = follow(tmp_path, DRIVES[drive], guess, settings, as_built())
    surfaces = settings | {"laser_surfaces_only": True}
    right, _ = follow(tmp_path, DRIVES[drive], guess, surfaces, as_built())
    print(f"solid walls: {ahead:.2f} m, their surfaces only: {right:.2f} m")
    assert 0.1 < ahead < 0.4
    assert right < 0.08
